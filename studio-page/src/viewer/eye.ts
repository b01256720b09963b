/** Where the author looks from, and what is seen from there: a camera that turns around a point. */

import { type Box3, type Camera, OrthographicCamera, PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { fittingDistance, follow, halfAngle } from "./lens";
import type { Projection } from "./lens";

export const VIEWS = {
  "three-quarter": [35, 25],
  front: [0, 0],
  side: [90, 0],
  top: [0, 89.9],
} as const;
export type View = keyof typeof VIEWS;

/** From where a shape is seen as in the thumbnails, a little nearer. */
const DISTANCE = 3.25;

export class Eye {
  readonly camera = new PerspectiveCamera(27.5, 1, 0.05, 50);
  /** Fitted, and so to stay when the pane changes, until the author comes nearer or goes away. */
  fitted = false;
  private projection: Projection = "perspective";
  private readonly parallel = new OrthographicCamera();
  private readonly controls: OrbitControls;

  /** onChange: called whenever something else is seen. */
  constructor(
    canvas: HTMLCanvasElement,
    private readonly onChange: () => void,
  ) {
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.minDistance = 0.3;
    this.controls.maxDistance = 12;
    this.controls.addEventListener("change", onChange);
    this.controls.addEventListener("start", () => (this.fitted = false));
    this.look("three-quarter");
  }

  seeIn(projection: Projection): void {
    this.projection = projection;
    this.onChange();
  }

  look(view: View): void {
    const [azimuth, elevation] = VIEWS[view].map((degrees) => (degrees * Math.PI) / 180) as [number, number];
    this.controls.target.set(0, 0, 0);
    this.place(azimuth, elevation, DISTANCE);
    this.fitted = false;
  }

  /** Turn by the keyboard: angles in degrees to the right and upwards, and a factor of the distance. */
  turn(right: number, up: number, closer = 1): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const azimuth = Math.atan2(offset.x, offset.z) + (right * Math.PI) / 180;
    const limit = Math.PI / 2 - 0.001;
    const elevation = Math.asin(offset.y / offset.length()) + (up * Math.PI) / 180;
    this.place(azimuth, Math.min(limit, Math.max(-limit, elevation)), offset.length() / closer);
    if (closer !== 1) this.fitted = false;
  }

  /** See a box as large as the pane holds it, from the same side. */
  fit(box: Box3): void {
    if (box.isEmpty()) return;
    this.camera.updateMatrixWorld();
    const offset = this.camera.position.clone().sub(this.controls.target);
    const distance = fittingDistance(box, this.camera, this.projection);
    box.getCenter(this.controls.target);
    this.camera.position.copy(this.controls.target).addScaledVector(offset.normalize(), distance);
    this.controls.update();
    this.fitted = true;
    this.onChange();
  }

  /** aspect: of the pane, its width in units of its height. */
  resized(aspect: number): void {
    this.camera.aspect = aspect;
    this.camera.fov = (halfAngle(aspect) * 360) / Math.PI;
    this.camera.updateProjectionMatrix();
  }

  /** The camera that draws. */
  get lens(): Camera {
    if (this.projection === "perspective") return this.camera;
    this.camera.updateMatrixWorld();
    follow(this.parallel, this.camera, this.controls.target);
    return this.parallel;
  }

  /** How far before the eye something is seen still: without perspective what lies behind it is seen as well. */
  get behind(): number {
    return this.projection === "perspective" ? 0 : this.camera.far;
  }

  /** How far a point is from the eye, without perspective from the plane of the eye. */
  depth(point: Vector3): number {
    return this.projection === "perspective" ? point.distanceTo(this.camera.position) : this.along(point);
  }

  /** By how much things are smaller at a point than at another one: the distance, without perspective the same for all. */
  shrinking(point: Vector3): number {
    return this.projection === "perspective" ? this.along(point) : 1;
  }

  dispose(): void {
    this.controls.dispose();
  }

  private along(point: Vector3): number {
    return -point.clone().applyMatrix4(this.camera.matrixWorldInverse).z;
  }

  private place(azimuth: number, elevation: number, distance: number): void {
    const level = Math.cos(elevation);
    this.camera.position
      .set(level * Math.sin(azimuth), Math.sin(elevation), level * Math.cos(azimuth))
      .multiplyScalar(distance)
      .add(this.controls.target);
    this.controls.update();
    this.onChange();
  }
}
