/** How the stage is seen: in perspective, or without it from the same place and at the same size. */

import { type Box3, type OrthographicCamera, type PerspectiveCamera, Vector3 } from "three";
import { corners } from "./boxes";

export type Projection = "perspective" | "parallel";

/** Degrees, as in the thumbnails, so that a shape does not turn when it is opened. */
const FIELD_OF_VIEW = 27.5;
/** Of a pane's narrower side that a shape takes when it is fitted. */
const FILLED = 0.92;

/** The half of the angle of view from top to bottom, in radians: a pane that is narrower than high shows as much. */
export function halfAngle(aspect: number): number {
  return Math.atan(Math.tan((FIELD_OF_VIEW * Math.PI) / 360) / Math.min(1, aspect));
}

/** Let a camera without perspective see what one with it sees around a point. */
export function follow(parallel: OrthographicCamera, camera: PerspectiveCamera, target: Vector3): void {
  const half = camera.position.distanceTo(target) * Math.tan((camera.fov * Math.PI) / 360);
  parallel.position.copy(camera.position);
  parallel.quaternion.copy(camera.quaternion);
  [parallel.top, parallel.bottom] = [half, -half];
  [parallel.right, parallel.left] = [half * camera.aspect, -half * camera.aspect];
  // What lies behind the place of the camera is seen as well: nearness means nothing without perspective.
  [parallel.near, parallel.far] = [-camera.far, camera.far];
  parallel.updateProjectionMatrix();
  parallel.updateMatrixWorld();
}

/** How far from the middle of a box a camera fills its pane with it, seen from the same side. */
export function fittingDistance(box: Box3, camera: PerspectiveCamera, projection: Projection): number {
  const middle = box.getCenter(new Vector3());
  const axes = [0, 1, 2].map((i) => new Vector3().setFromMatrixColumn(camera.matrixWorld, i)) as [Vector3, Vector3, Vector3]; // prettier-ignore
  const vertical = Math.tan((camera.fov * Math.PI) / 360);
  let distance = 1e-3;
  for (const corner of corners(box)) {
    corner.sub(middle);
    const [x, y, nearer] = axes.map((axis) => corner.dot(axis)) as [number, number, number];
    const needed = Math.max(Math.abs(x) / camera.aspect, Math.abs(y)) / vertical / FILLED;
    distance = Math.max(distance, needed + (projection === "perspective" ? nearer : 0));
  }
  return distance;
}
