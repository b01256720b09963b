// Made from src/shapewright/studio/wire/answers.py by `python tools/message_types.py`.

import type { Address, Slug, Value, Values } from "./values";
import type { Grade, Measures, Piece } from "./judgement";
import type { Problem } from "./problems";

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
  /** of the evaluation that it answers; 0 where it answers a request of HTTP. */
  id: number;
  slug: Slug | null;
  shape: Side;
  /** what the values that were asked for became. */
  parameters?: Values;
  /** parameters that matter there. */
  active?: string[];
  /** parameters at an end of their Range. */
  at_limit?: string[];
  units?: Extent;
  /** what the procedure took. */
  milliseconds?: number;
  vertices: number;
  triangles: number;
  /** triangles stand for points: their edges are none of the shape. */
  discs: boolean;
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
  /** of the evaluation that it answers; 0 where it answers a request of HTTP. */
  id: number;
  slug: Slug | null;
  shape: Side;
  /** what the values that were asked for became. */
  parameters?: Values;
  /** parameters that matter there. */
  active?: string[];
  /** parameters at an end of their Range. */
  at_limit?: string[];
  units?: Extent;
  /** what the procedure took. */
  milliseconds?: number;
  path: string;
  /** what the reference covers and the replica does not. */
  missing: string | null;
  /** what the replica covers and the reference does not. */
  excess: string | null;
}

/** What the judge says of a replica, as ``Judged`` has it. */
export interface VerdictMessage {
  type: "verdict";
  id: number;
  slug: Slug | null;
  /** null where it cannot be measured. */
  fidelity: number | null;
  /** null where it cannot be measured. */
  distance: number | null;
  measures: Measures;
  /** of the reference; the largest first. */
  missing: Piece[];
  /** of the replica; the largest first. */
  surplus: Piece[];
  grade: Grade;
  compatible: boolean;
  colour: string | null;
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

/** Whether a mesh is clean. */
export interface Soundness {
  sound: boolean;
  /** every edge has a face on either side. */
  closed: boolean;
  manifold: boolean;
  /** wound outwards. */
  oriented: boolean;
  /** pairs of faces that cross or overlap. */
  self_intersections: number;
  /** faces without height. */
  slivers: number;
  components: number;
  triangles: number;
}

/** A parameter that shapes go along. */
export interface Along {
  name: string;
  values: Value[];
}

/** Shapes without references are on their way. */
export interface ExploringMessage {
  type: "exploring";
  /** of the request that it answers. */
  id: number;
  /** parameters of each. */
  shapes: Values[];
  /** the shapes go along these, the last one fastest; empty where they are random. */
  along: Along[];
  /** why there are none. */
  problem: Problem | null;
}

/** One of these shapes was built, or why not. */
export interface ExploredMessage {
  type: "explored";
  id: number;
  index: number;
  parameters: Values;
  /** names of parameters that matter there. */
  active: string[];
  picture: Address | null;
  /** null of a drawing, of what is too large to be examined, and without a shape. */
  soundness: Soundness | null;
  problem: Problem | null;
  /** none of the others comes: too many exceeded the time limit. */
  given_up: boolean;
}
