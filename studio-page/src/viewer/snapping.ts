/** What a pointer means on the stage: the nearest corner, edge, or corner of the bounding box; else the surface. */

import { Box3, Vector3 } from "three";
import type { Side, Stage } from "./stage";

export type SnapKind = "vertex" | "edge" | "box" | "surface";
export interface Snap {
  point: Vector3;
  kind: SnapKind;
  side: Side;
}
export type Snapping = Record<"vertex" | "edge" | "box", boolean>;

const REACH = { vertex: 11, box: 11, edge: 7 } as const;
/** How many pixels farther away something may be for standing nearer by the shape's size. */
const DEPTH = 25;
/** What lies this much behind the surface under the pointer is hidden by it. */
const HIDDEN = 0.03;

export function snap(stage: Stage, x: number, y: number, snapping: Snapping): Snap | null {
  const side = stage.sideAt(x);
  const surface = stage.surfaces[side];
  if (!surface.triangles) return null;
  const hit = stage.hit(x, y, side);
  const wall = hit ? hit.distanceTo(stage.camera.position) + HIDDEN : Infinity;
  const nearest = new Nearest(stage, side, x, y);
  const { positions } = surface.triangles;
  if (snapping.vertex) {
    for (let i = 0; i < positions.length; i += 3)
      nearest.point(new Vector3().fromArray(positions, i), REACH.vertex, "vertex", wall);
  }
  if (snapping.box) for (const corner of corners(bounds(positions))) nearest.point(corner, REACH.box, "box", Infinity);
  if (!nearest.found && snapping.edge) {
    const { segments } = surface;
    for (let i = 0; i < segments.length; i += 6) {
      nearest.segment(new Vector3().fromArray(segments, i), new Vector3().fromArray(segments, i + 3), "edge", wall);
    }
  }
  if (!nearest.found && snapping.box && !hit)
    for (const [a, b] of boxEdges(bounds(positions))) nearest.segment(a, b, "box", Infinity);
  return nearest.found ?? (hit && { point: hit, kind: "surface", side });
}

class Nearest {
  found: Snap | null = null;
  private best = Infinity;

  constructor(
    private readonly stage: Stage,
    private readonly side: Side,
    private readonly x: number,
    private readonly y: number,
  ) {}

  point(point: Vector3, reach: number, kind: SnapKind, wall: number): void {
    const seen = this.stage.project(point, this.side);
    if (!seen || seen.depth > wall) return;
    const off = Math.hypot(seen.x - this.x, seen.y - this.y);
    const score = off + DEPTH * seen.depth;
    if (off > reach || score >= this.best) return;
    this.best = score;
    this.found = { point, kind, side: this.side };
  }

  /** The point of a segment that is seen nearest to the pointer. */
  segment(a: Vector3, b: Vector3, kind: SnapKind, wall: number): void {
    const [from, to] = [this.stage.project(a, this.side), this.stage.project(b, this.side)];
    if (!from || !to) return;
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const along = ((this.x - from.x) * dx + (this.y - from.y) * dy) / (dx * dx + dy * dy || 1);
    const t = Math.min(1, Math.max(0, along));
    // Seen halfway is not halfway in space: what is inverse to depth is linear on the screen.
    const [near, far] = [(1 - t) / this.depth(a), t / this.depth(b)];
    this.point(a.clone().lerp(b, far / (near + far)), REACH.edge, kind, wall);
  }

  private depth(point: Vector3): number {
    return -point.clone().applyMatrix4(this.stage.camera.matrixWorldInverse).z;
  }
}

export function bounds(positions: Float32Array): Box3 {
  return new Box3().setFromArray(positions);
}

function corners({ min, max }: Box3): Vector3[] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map(
    (i) => new Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z),
  );
}

export function boxEdges(box: Box3): [Vector3, Vector3][] {
  const at = corners(box);
  const pairs = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((i) =>
    [1, 2, 4].filter((bit) => !(i & bit)).map((bit) => [i, i | bit] as const),
  );
  return pairs.map(([i, j]) => [at[i]!, at[j]!]);
}
