/** One mesh on the stage: its faces, flat shaded and seen from both sides, and its creases. */

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
} from "three";
import { creases } from "./creases";

export interface Triangles {
  /** (V, 3), normalised */
  positions: Float32Array;
  /** (F, 3) */
  indices: Uint32Array;
  /** whether they stand for points and have no creases */
  discs?: boolean;
}

/** Writes a colour (linear light) for each corner of each face (F, 3, 3). */
export type Paint = (colours: Float32Array, indices: Uint32Array) => void;

export class Surface {
  readonly group = new Group();
  triangles: Triangles | null = null;
  segments: Float32Array = new Float32Array();
  private readonly faces = new BufferGeometry();
  private readonly lines = new BufferGeometry();
  private readonly skin = new MeshLambertMaterial({
    flatShading: true,
    side: DoubleSide,
    vertexColors: true,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  private readonly ink = new LineBasicMaterial({ transparent: true });
  readonly mesh = new Mesh(this.faces, this.skin);

  constructor() {
    this.group.add(this.mesh, new LineSegments(this.lines, this.ink));
    this.group.visible = false;
  }

  /** Show another shape: its creases, and its faces in one colour until they are painted. */
  show(triangles: Triangles | null, paint: Paint): void {
    this.triangles = triangles;
    this.group.visible = triangles !== null && triangles.indices.length > 0;
    if (!triangles) return;
    this.segments = triangles.discs ? new Float32Array() : creases(triangles.positions, triangles.indices);
    fill(this.lines, "position", this.segments.length).set(this.segments);
    this.cover(triangles, paint);
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
    this.ink.opacity = strength;
  }

  dispose(): void {
    for (const owned of [this.faces, this.lines, this.skin, this.ink]) owned.dispose();
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
