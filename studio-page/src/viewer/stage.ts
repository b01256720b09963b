/**
 * The canvas on which reference and replica stand: one renderer and one camera, drawn twice into the halves of the canvas,
 * or once over each other. It draws only when something has changed.
 */

import {
  Box3,
  Color,
  DirectionalLight,
  HemisphereLight,
  Plane,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { bounds } from "./boxes";
import { began, ended } from "./diagnostics";
import { Eye } from "./eye";
import { Furniture } from "./furniture";
import { reach, struck } from "./picking";
import type { Reach } from "./picking";
import { Surface } from "./surface";

export type Side = "reference" | "replica";
export type Layout = "beside" | "over";
export const SIDES: readonly Side[] = ["reference", "replica"];

/** Where on the page a half of the stage lies, in pixels from the canvas's upper left corner. */
export interface Pane {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** A plane through both shapes; what lies beyond it along its axis is cut away, or what lies before it. */
export interface Section {
  axis: "x" | "y" | "z";
  at: number;
  flipped: boolean;
}

export class Stage {
  readonly canvas = document.createElement("canvas");
  readonly eye: Eye;
  readonly surfaces: Record<Side, Surface> = { reference: new Surface(), replica: new Surface() };
  layout: Layout = "beside";
  /** Half-spaces that are shown, all of space where there is none. */
  shown: readonly Plane[] = [];
  /** Called after every drawing. */
  onDraw: () => void = () => undefined;
  private readonly renderer: WebGLRenderer;
  private readonly scenes: Record<Side, Scene> = { reference: new Scene(), replica: new Scene() };
  private readonly furniture: Record<Side, Furniture> = { reference: new Furniture(), replica: new Furniture() };
  private readonly caster = new Raycaster();
  private readonly watcher = new ResizeObserver(() => this.resize());
  private readonly lamps: DirectionalLight[] = [];
  private frame = 0;

  /** Raises an error when the browser has no WebGL. */
  constructor(private readonly container: HTMLElement) {
    const context = this.canvas.getContext("webgl2", { antialias: true, alpha: true });
    if (!context) throw new Error("This browser has no WebGL.");
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context });
    this.renderer.localClippingEnabled = true;
    began(this);
    this.renderer.autoClear = false;
    container.append(this.canvas);
    for (const side of SIDES) {
      const lamp = new DirectionalLight(0xffffff, 2.1);
      this.lamps.push(lamp);
      const light = new HemisphereLight(0xffffff, 0x8d8d96, 1.5);
      this.scenes[side].add(this.surfaces[side].group, this.furniture[side].group, light, lamp, lamp.target);
    }
    this.eye = new Eye(this.canvas, () => this.invalidate());
    this.watcher.observe(container);
    this.resize();
  }

  /** Ask for a drawing with the next frame of the screen. */
  invalidate(): void {
    this.frame ||= requestAnimationFrame(() => this.draw());
  }

  arrange(layout: Layout): void {
    this.layout = layout;
    this.resize();
  }

  wire(on: boolean): void {
    for (const side of SIDES) this.surfaces[side].wire(on);
    this.invalidate();
  }

  section(section: Section | null): void {
    const planes = [];
    if (section) {
      const normal = new Vector3();
      normal[section.axis] = section.flipped ? 1 : -1;
      planes.push(new Plane(normal, section.flipped ? -section.at : section.at));
    }
    this.shown = planes;
    for (const side of SIDES) this.surfaces[side].cut(planes);
    this.invalidate();
  }

  /** A grid under both shapes, and axes through their middle. */
  furnish(on: boolean, ink: Color): void {
    const box = this.box;
    const floor = box.isEmpty() ? -0.5 : box.min.y;
    for (const side of SIDES) this.furniture[side].place(on, floor, ink);
    this.invalidate();
  }

  /** Show both shapes as large as the pane holds, from the same side; and so until the author comes nearer or goes away. */
  fit(): void {
    this.eye.fit(this.box);
  }

  pane(side: Side): Pane {
    const { clientWidth, clientHeight } = this.container;
    if (this.layout === "over") return { x: 0, y: 0, width: clientWidth, height: clientHeight };
    const width = Math.floor(clientWidth / 2);
    return { x: side === "reference" ? 0 : clientWidth - width, y: 0, width, height: clientHeight };
  }

  /** Place in the pane's pixels of a point in space, and its depth; null behind the camera. */
  project(point: Vector3, side: Side): { x: number; y: number; depth: number } | null {
    const pane = this.pane(side);
    const seen = point.clone().project(this.eye.lens);
    if (seen.z > 1) return null;
    return {
      x: pane.x + ((seen.x + 1) / 2) * pane.width,
      y: pane.y + ((1 - seen.y) / 2) * pane.height,
      depth: this.eye.depth(point),
    };
  }

  /** The half that a pixel of the canvas lies in. */
  sideAt(x: number): Side {
    if (this.layout === "over") return this.surfaces.reference.group.visible ? "reference" : "replica";
    return x < this.container.clientWidth / 2 ? "reference" : "replica";
  }

  /** The nearest point of a surface under a pixel of the canvas. */
  hit(x: number, y: number, side: Side): Vector3 | null {
    const { solid, group } = this.surfaces[side];
    if (!solid?.body || !group.visible) return null;
    this.caster.setFromCamera(this.inPane(x, y, side), this.eye.lens);
    const { ray } = this.caster;
    ray.origin.addScaledVector(ray.direction, -this.eye.behind);
    return struck(solid.body, ray, this.shown);
  }

  /** What lies within so many pixels of a pixel of the canvas. */
  reach(x: number, y: number, pixels: number, side: Side): Reach {
    const [pane, at] = [this.pane(side), this.inPane(x, y, side)];
    return reach(this.eye.lens, at.x, at.y, (2 * pixels) / pane.width, (2 * pixels) / pane.height, this.shown);
  }

  /** Objects that live on the graphics card. */
  get objects(): { geometries: number; textures: number; programs: number } {
    const { memory, programs } = this.renderer.info;
    return { geometries: memory.geometries, textures: memory.textures, programs: programs?.length ?? 0 };
  }

  /** How many triangles are drawn, and are measured. */
  get faces(): Record<Side, { drawn: number; measured: number }> {
    const of = ({ solid }: Surface) => ({
      drawn: (solid?.sight.indices.length ?? 0) / 3,
      measured: (solid?.body?.indices.length ?? 0) / 3,
    });
    return { reference: of(this.surfaces.reference), replica: of(this.surfaces.replica) };
  }

  /** Draw at once, so that the canvas can be copied. */
  draw(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    const { camera, lens } = this.eye;
    this.lamps.forEach((lamp) => {
      // Over the viewer's left shoulder, so that faces towards all three axes differ.
      lamp.position.copy(camera.position).add(new Vector3(-1.2, 1.8, 0.6).applyQuaternion(camera.quaternion));
    });
    this.renderer.setScissorTest(false);
    this.renderer.clear();
    this.renderer.setScissorTest(true);
    for (const side of SIDES) {
      const pane = this.pane(side);
      this.renderer.setViewport(pane.x, 0, pane.width, pane.height);
      this.renderer.setScissor(pane.x, 0, pane.width, pane.height);
      this.renderer.render(this.scenes[side], lens);
    }
    this.onDraw();
  }

  /** Give back everything on the graphics card, and the context itself. */
  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.watcher.disconnect();
    this.eye.dispose();
    for (const side of SIDES) {
      this.surfaces[side].dispose();
      this.furniture[side].dispose();
    }
    for (const lamp of this.lamps) lamp.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.canvas.remove();
    ended(this);
  }

  /** The box around both shapes. */
  private get box(): Box3 {
    const box = new Box3();
    for (const side of SIDES) {
      const { solid, group } = this.surfaces[side];
      if (!solid || !group.visible) continue;
      box.union(solid.body ? bounds(solid.body.faces) : new Box3().setFromArray(solid.sight.positions));
    }
    return box;
  }

  private inPane(x: number, y: number, side: Side): Vector2 {
    const pane = this.pane(side);
    return new Vector2(((x - pane.x) / pane.width) * 2 - 1, 1 - ((y - pane.y) / pane.height) * 2);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.container;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    const pane = this.pane("reference");
    this.eye.resized(pane.width / pane.height);
    if (this.eye.fitted) this.fit();
    this.draw();
  }
}
