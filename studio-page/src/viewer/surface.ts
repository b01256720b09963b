/** One mesh on the stage: its faces, flat shaded and seen from both sides, its creases, and the edges of its triangles. */

import {
  BufferAttribute,
  BufferGeometry,
  type Color,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  type Plane,
} from "three";
import type { Solid, Triangles } from "./solids/solid";

/** Writes a colour (linear light) for each corner of each face (F, 3, 3). */
export type Paint = (colours: Float32Array, indices: Uint32Array) => void;

/** How strongly the edges of triangles show, beside creases. */
const WIRE = 0.45;

export class Surface {
  readonly group = new Group();
  solid: Solid | null = null;
  private readonly faces = new BufferGeometry();
  private readonly lines = new BufferGeometry();
  private readonly wires = new BufferGeometry();
  private readonly skin = new MeshLambertMaterial({
    flatShading: true,
    side: DoubleSide,
    vertexColors: true,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  private readonly ink = new LineBasicMaterial({ transparent: true });
  private readonly thread = new LineBasicMaterial({ transparent: true });
  private readonly net = new LineSegments(this.wires, this.thread);

  constructor() {
    this.group.add(new Mesh(this.faces, this.skin), new LineSegments(this.lines, this.ink), this.net);
    this.group.visible = this.net.visible = false;
  }

  /** Show another shape: its creases; its faces once they are painted. */
  show(solid: Solid | null): void {
    const drawn = this.solid?.sight;
    this.solid = solid;
    this.group.visible = solid !== null && solid.sight.indices.length > 0;
    if (!solid || solid.sight === drawn) return;
    fill(this.lines, "position", solid.sight.segments.length).set(solid.sight.segments);
    if (this.net.visible) this.knit();
  }

  /** Faces of the shape, perhaps cut finer than those that its creases come from. Buffers are filled in place. */
  cover({ positions, indices }: Triangles, paint: Paint): void {
    const corners = fill(this.faces, "position", indices.length * 3);
    const colours = fill(this.faces, "color", indices.length * 3);
    for (let i = 0; i < indices.length; i++) {
      const v = 3 * indices[i]!;
      for (let k = 0; k < 3; k++) corners[3 * i + k] = positions[v + k]!;
    }
    paint(colours, indices);
  }

  /** Opacity of the faces, and colour and strength of the creases. */
  dress(opacity: number, ink: Color, strength: number): void {
    this.skin.transparent = opacity < 1;
    this.skin.opacity = opacity;
    this.skin.depthWrite = opacity >= 1;
    this.skin.needsUpdate = true;
    this.ink.color.copy(ink);
    this.thread.color.copy(ink);
    this.ink.opacity = strength;
    this.thread.opacity = strength * WIRE;
  }

  /** Whether the edges of all triangles are drawn. */
  wire(on: boolean): void {
    if (on && !this.net.visible) this.knit();
    this.net.visible = on;
  }

  /** Leave away what lies behind these planes. */
  cut(planes: Plane[]): void {
    for (const material of [this.skin, this.ink, this.thread]) material.clippingPlanes = planes;
  }

  dispose(): void {
    for (const owned of [this.faces, this.lines, this.wires, this.skin, this.ink, this.thread]) owned.dispose();
  }

  private knit(): void {
    if (!this.solid) return;
    const { positions, indices } = this.solid.sight;
    const ends = fill(this.wires, "position", indices.length * 6);
    for (let corner = 0; corner < indices.length; corner++) {
      const next = corner % 3 === 2 ? corner - 2 : corner + 1;
      for (let k = 0; k < 3; k++) {
        ends[6 * corner + k] = positions[3 * indices[corner]! + k]!;
        ends[6 * corner + 3 + k] = positions[3 * indices[next]! + k]!;
      }
    }
  }
}

/** The first `length` numbers of an attribute, which is made anew only when it is too small. */
function fill(geometry: BufferGeometry, name: string, length: number): Float32Array {
  let attribute = geometry.getAttribute(name) as BufferAttribute | undefined;
  if (!attribute || attribute.array.length < length) {
    // Buffers of the graphics card are freed only with their geometry.
    geometry.dispose();
    attribute = new BufferAttribute(new Float32Array(Math.ceil((length * 1.25) / 9) * 9), 3);
    attribute.setUsage(DynamicDrawUsage);
    geometry.setAttribute(name, attribute);
  }
  attribute.needsUpdate = true;
  geometry.setDrawRange(0, length / 3);
  if (name === "position") {
    geometry.boundingBox = null;
    geometry.boundingSphere = null;
  }
  return attribute.array as Float32Array;
}
