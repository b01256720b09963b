// Made from src/shapewright/studio/wire/answers.py by `python tools/message_types.py`.

import type { Problem } from "./problems";
import type { Slug, Values } from "./values";

export type Side = "replica" | "reference";

export type BufferKind = "f32" | "u32" | "i32";

export type Buffer = [string, BufferKind, number];

/** How large a replica is. */
export interface Extent {
  /** extents in the procedure's own units. */
  size: number[];
}

/** Of a binary message: positions (f32, 3 a vertex), indices (u32, 3 a triangle), labels (i32, 1 a triangle). */
export interface MeshHead {
  type: "mesh";
  id: number;
  slug: Slug | null;
  shape: Side;
  parameters?: Values;
  active?: string[];
  at_limit?: string[];
  units?: Extent;
  milliseconds?: number;
  vertices: number;
  triangles: number;
  /** ``labels`` are indices into it, -1 without a label; no buffer when nothing is labelled. */
  label_names: string[];
  buffers: Buffer[];
}

/** Of a binary message: positions, indices, colours (f32, 3 a vertex, linear light), distances (f32, 1 a vertex). */
export interface ResidualsHead {
  type: "residuals";
  id: number;
  slug: Slug | null;
  shape: Side;
  vertices: number;
  triangles: number;
  /** distances are negative inside the other shape. */
  signed: boolean;
  /** distance at the end of the colour scale. */
  limit: number;
  buffers: Buffer[];
}

/** A drawing as SVG path data, y up, to be filled by the even-odd rule. */
export interface DrawingMessage {
  type: "drawing";
  id: number;
  slug: Slug | null;
  shape: Side;
  parameters?: Values;
  active?: string[];
  at_limit?: string[];
  units?: Extent;
  milliseconds?: number;
  path: string;
  /** what the reference covers and the replica does not. */
  missing: string | null;
  /** what the replica covers and the reference does not. */
  excess: string | null;
}

/** How far a replica is from its reference; null where that cannot be measured. */
export interface DistanceMessage {
  type: "distance";
  id: number;
  slug: Slug | null;
  distance: number | null;
  iou: number | null;
  chamfer: number | null;
  colour: string | null;
  compatible: boolean;
}

/** There is no replica at these parameters. */
export interface FailedMessage {
  type: "failed";
  id: number;
  slug: Slug | null;
  problem: Problem;
  /** null where that is not known. */
  active: string[] | null;
}
