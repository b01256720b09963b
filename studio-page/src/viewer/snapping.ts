/** What a pointer means on the stage: the nearest corner, edge, or corner of the bounding box; else the surface. */

import { Vector3 } from "three";
import { bounds, boxEdges, corners } from "./boxes";
import { isShown, linesIn, verticesIn } from "./picking";
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

/** null where nothing is near, and while a large shape is indexed. */
export function snap(stage: Stage, x: number, y: number, snapping: Snapping): Snap | null {
  const side = stage.sideAt(x);
  const body = stage.surfaces[side].solid?.body;
  if (!body) return null;
  const hit = stage.hit(x, y, side);
  const wall = hit ? stage.eye.depth(hit) + HIDDEN : Infinity;
  const nearest = new Nearest(stage, side, x, y);
  const { positions } = body;
  if (snapping.vertex) {
    for (const vertex of verticesIn(body, stage.reach(x, y, REACH.vertex, side)))
      nearest.point(new Vector3().fromArray(positions, 3 * vertex), REACH.vertex, "vertex", wall);
  }
  const box = snapping.box ? bounds(body.faces) : null;
  if (box) for (const corner of corners(box)) nearest.point(corner, REACH.box, "box", Infinity);
  if (!nearest.found && snapping.edge) {
    const { segments } = body;
    for (const line of linesIn(body, stage.reach(x, y, REACH.edge, side))) {
      const [a, b] = [new Vector3().fromArray(segments, 6 * line), new Vector3().fromArray(segments, 6 * line + 3)];
      nearest.segment(a, b, "edge", wall);
    }
  }
  if (!nearest.found && box && !hit) for (const [a, b] of boxEdges(box)) nearest.segment(a, b, "box", Infinity);
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
    if (kind !== "box" && !isShown(point, this.stage.shown)) return;
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
    // Seen halfway is not halfway in space: in perspective what is inverse to depth is linear on the screen.
    const [near, far] = [(1 - t) / this.stage.eye.shrinking(a), t / this.stage.eye.shrinking(b)];
    this.point(a.clone().lerp(b, far / (near + far)), REACH.edge, kind, wall);
  }
}
