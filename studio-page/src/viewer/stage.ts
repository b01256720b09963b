/**
 * The canvas on which reference and replica stand: one renderer and one camera, drawn twice into the halves of the canvas,
 * or once over each other. It draws only when something has changed.
 */

import {
  DirectionalLight,
  HemisphereLight,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { began, ended } from "./diagnostics";
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

export const VIEWS = {
  "three-quarter": [35, 25],
  front: [0, 0],
  side: [90, 0],
  top: [0, 89.9],
} as const;
export type View = keyof typeof VIEWS;

// Seen as in the thumbnails, so that a shape does not turn when it is opened; a little nearer.
const FIELD_OF_VIEW = 27.5;
const DISTANCE = 3.25;

export class Stage {
  readonly canvas = document.createElement("canvas");
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.05, 50);
  readonly surfaces: Record<Side, Surface> = { reference: new Surface(), replica: new Surface() };
  layout: Layout = "beside";
  /** Called after every drawing. */
  onDraw: () => void = () => undefined;
  private readonly renderer: WebGLRenderer;
  private readonly scenes: Record<Side, Scene> = { reference: new Scene(), replica: new Scene() };
  private readonly controls: OrbitControls;
  private readonly caster = new Raycaster();
  private readonly watcher = new ResizeObserver(() => this.resize());
  private readonly lamps: DirectionalLight[] = [];
  private frame = 0;

  /** Raises an error when the browser has no WebGL. */
  constructor(private readonly container: HTMLElement) {
    const context = this.canvas.getContext("webgl2", { antialias: true, alpha: true });
    if (!context) throw new Error("This browser has no WebGL.");
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context });
    began(this);
    this.renderer.autoClear = false;
    container.append(this.canvas);
    for (const side of SIDES) {
      const lamp = new DirectionalLight(0xffffff, 2.1);
      this.lamps.push(lamp);
      this.scenes[side].add(this.surfaces[side].group, new HemisphereLight(0xffffff, 0x8d8d96, 1.5), lamp, lamp.target);
    }
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = false;
    this.controls.minDistance = 0.3;
    this.controls.maxDistance = 12;
    this.controls.addEventListener("change", () => this.invalidate());
    this.look("three-quarter");
    this.watcher.observe(container);
    this.resize();
  }

  /** Ask for a drawing with the next frame of the screen. */
  invalidate(): void {
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0;
      this.draw();
    });
  }

  arrange(layout: Layout): void {
    this.layout = layout;
    this.resize();
  }

  look(view: View): void {
    const [azimuth, elevation] = VIEWS[view].map((degrees) => (degrees * Math.PI) / 180) as [number, number];
    const level = Math.cos(elevation);
    this.controls.target.set(0, 0, 0);
    this.camera.position
      .set(level * Math.sin(azimuth), Math.sin(elevation), level * Math.cos(azimuth))
      .multiplyScalar(DISTANCE);
    this.controls.update();
    this.invalidate();
  }

  /** Turn by the keyboard: angles in degrees to the right and upwards, and a factor of the distance. */
  turn(right: number, up: number, closer = 1): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const distance = offset.length() / closer;
    const azimuth = Math.atan2(offset.x, offset.z) + (right * Math.PI) / 180;
    const limit = Math.PI / 2 - 0.001;
    const elevation = Math.asin(offset.y / offset.length()) + (up * Math.PI) / 180;
    const held = Math.min(limit, Math.max(-limit, elevation));
    offset.set(Math.cos(held) * Math.sin(azimuth), Math.sin(held), Math.cos(held) * Math.cos(azimuth));
    this.camera.position.copy(this.controls.target).addScaledVector(offset, distance);
    this.controls.update();
    this.invalidate();
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
    const seen = point.clone().project(this.camera);
    if (seen.z > 1) return null;
    return {
      x: pane.x + ((seen.x + 1) / 2) * pane.width,
      y: pane.y + ((1 - seen.y) / 2) * pane.height,
      depth: point.distanceTo(this.camera.position),
    };
  }

  /** The half that a pixel of the canvas lies in. */
  sideAt(x: number): Side {
    if (this.layout === "over") return this.surfaces.reference.group.visible ? "reference" : "replica";
    return x < this.container.clientWidth / 2 ? "reference" : "replica";
  }

  /** The nearest point of a surface under a pixel of the canvas. */
  hit(x: number, y: number, side: Side): Vector3 | null {
    const pane = this.pane(side);
    const at = new Vector2(((x - pane.x) / pane.width) * 2 - 1, 1 - ((y - pane.y) / pane.height) * 2);
    this.caster.setFromCamera(at, this.camera);
    const mesh = this.surfaces[side].mesh;
    return this.surfaces[side].group.visible ? (this.caster.intersectObject(mesh, false)[0]?.point ?? null) : null;
  }

  /** Objects that live on the graphics card. */
  get objects(): { geometries: number; textures: number; programs: number } {
    const { memory, programs } = this.renderer.info;
    return { geometries: memory.geometries, textures: memory.textures, programs: programs?.length ?? 0 };
  }

  private draw(): void {
    this.lamps.forEach((lamp) => {
      // Over the viewer's left shoulder, so that faces towards all three axes differ.
      lamp.position.copy(this.camera.position).add(new Vector3(-1.2, 1.8, 0.6).applyQuaternion(this.camera.quaternion));
    });
    this.renderer.setScissorTest(false);
    this.renderer.clear();
    this.renderer.setScissorTest(true);
    for (const side of SIDES) {
      const pane = this.pane(side);
      this.renderer.setViewport(pane.x, 0, pane.width, pane.height);
      this.renderer.setScissor(pane.x, 0, pane.width, pane.height);
      this.renderer.render(this.scenes[side], this.camera);
    }
    this.onDraw();
  }

  /** Give back everything on the graphics card, and the context itself. */
  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.watcher.disconnect();
    this.controls.dispose();
    for (const side of SIDES) this.surfaces[side].dispose();
    for (const lamp of this.lamps) lamp.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.canvas.remove();
    ended(this);
  }

  set controllable(on: boolean) {
    this.controls.enabled = on;
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.container;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    const pane = this.pane("reference");
    this.camera.aspect = pane.width / pane.height;
    // The whole of a shape fits into a half that is narrower than high.
    const vertical = Math.tan((FIELD_OF_VIEW * Math.PI) / 360) / Math.min(1, this.camera.aspect);
    this.camera.fov = (Math.atan(vertical) * 360) / Math.PI;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
