/** What lies under a pixel of the stage, found by the indexes of a shape. */

import { type Camera, type Plane, type Ray, Vector3 } from "three";
import type { Body } from "./solids/solid";
import { visit } from "./solids/spatial";

/** What a pointer reaches: four planes, their insides in front of them; and the eye and how far it may see. */
export interface Reach {
  /** (4, 4) normal and constant of each plane */
  planes: Float64Array;
  eye: Vector3;
  /** Half-spaces that are shown; what lies behind one of them is cut away. */
  shown: readonly Plane[];
}

/** Around a place in a pane: x and y from -1 to 1, and as much to each side. */
export function reach(camera: Camera, x: number, y: number, right: number, up: number, shown: readonly Plane[]): Reach {
  const corner = (i: number, depth: number) =>
    new Vector3(x + (i === 0 || i === 3 ? -right : right), y + (i < 2 ? -up : up), depth).unproject(camera);
  const inside = new Vector3(x, y, 0.5).unproject(camera);
  const planes = new Float64Array(16);
  for (let i = 0; i < 4; i++) {
    const [a, b, c] = [corner(i, -1), corner((i + 1) % 4, -1), corner(i, 0.9)];
    const normal = b.sub(a).cross(c.sub(a)).normalize();
    const side = Math.sign(normal.dot(inside) - normal.dot(a)) || 1;
    planes.set([...normal.multiplyScalar(side).toArray(), -normal.dot(a)], 4 * i);
  }
  return { planes, eye: new Vector3().setFromMatrixPosition(camera.matrixWorld), shown };
}

/** Whether a box has something within reach. */
function touches({ planes }: Reach, boxes: Float32Array, at: number): boolean {
  for (let i = 0; i < 16; i += 4) {
    let most = planes[i + 3]!;
    for (let k = 0; k < 3; k++) most += planes[i + k]! * boxes[at + k + (planes[i + k]! > 0 ? 3 : 0)]!;
    if (most < 0) return false;
  }
  return true;
}

/** Whether a point is not cut away. */
export const isShown = (point: Vector3, shown: readonly Plane[]): boolean =>
  shown.every((plane) => plane.distanceToPoint(point) >= -1e-6);

/** The vertices that may be within reach, each once. */
export function verticesIn(body: Body, within: Reach): Set<number> {
  const found = new Set<number>();
  visit(
    body.faces,
    (boxes, at) => touches(within, boxes, at),
    (face) => {
      for (let k = 0; k < 3; k++) found.add(body.indices[3 * face + k]!);
    },
  );
  return found;
}

/** The creases that may be within reach. */
export function linesIn(body: Body, within: Reach): number[] {
  const found: number[] = [];
  visit(
    body.lines,
    (boxes, at) => touches(within, boxes, at),
    (line) => found.push(line),
  );
  return found;
}

/** The nearest point of the surface on a ray that is not cut away. */
export function struck(body: Body, ray: Ray, shown: readonly Plane[]): Vector3 | null {
  const { origin, direction } = ray;
  const [o, d] = [origin.toArray(), direction.toArray().map((along) => along || 1e-12)];
  let nearest = Infinity;
  let found: Vector3 | null = null;
  const ahead = (boxes: Float32Array, at: number) => {
    let [enters, leaves] = [-Infinity, nearest];
    for (let k = 0; k < 3; k++) {
      const [a, b] = [(boxes[at + k]! - o[k]!) / d[k]!, (boxes[at + k + 3]! - o[k]!) / d[k]!];
      enters = Math.max(enters, Math.min(a, b));
      leaves = Math.min(leaves, Math.max(a, b));
    }
    return enters <= leaves;
  };
  const [a, b, c, at] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
  visit(body.faces, ahead, (face) => {
    [a, b, c].forEach((corner, k) => corner.fromArray(body.positions, 3 * body.indices[3 * face + k]!));
    if (!ray.intersectTriangle(a, b, c, false, at)) return;
    const distance = at.distanceTo(origin);
    if (distance >= nearest || !isShown(at, shown)) return;
    nearest = distance;
    found = at.clone();
  });
  return found;
}
