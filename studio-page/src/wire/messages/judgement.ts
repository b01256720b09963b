// Made from src/shapewright/studio/wire/judgement.py by `python tools/message_types.py`.

import type { Slug, Vector } from "./values";

export type Grade = "replicated" | "close" | "different";

export type Judge = "fidelity" | "paper";

export type Measures = Record<string, number | null>;

/** A connected piece of one shape that the other does not explain, in a box. */
export interface Piece {
  /** longest side of the box, as a share of the shape's largest extent. */
  size: number;
  /** corner of the box, in the frame of the normalised reference. */
  low: Vector;
  /** the opposite corner. */
  high: Vector;
  /** of the visible surface or of the area. */
  share: number;
}

/** How many references have each grade, and how many are compatible. */
export interface Counts {
  replicated: number;
  close: number;
  different: number;
  /** by the paper's measure. */
  compatible: number;
}

/** How a reference stands, where an explanation finds that it stands another way than the replicas. */
export interface Pose {
  /** degrees about the up axis. */
  turned: number;
  on_its_head: boolean;
  mirrored: boolean;
  /** what it is, and what to do. */
  text: string;
}

/** Whether a person finds two references the same; where ``a`` is ``b``, the reference and its own replica. */
export interface Mark {
  a: Slug;
  b: Slug;
  same: boolean;
}

/** Which cut the marks ask for: of the fidelity, or by the paper's judge of the distance. */
export interface Learned {
  judge: Judge;
  /** marks whose measure is known. */
  count: number;
  cut: number;
  /** marks that it judges as the author. */
  agrees: number;
  /** the cut without marks. */
  usual: number;
  /** marks that this one judges as the author. */
  usual_agrees: number;
}

/** The marked pairs, what they say, and what to mark next. */
export interface Marking {
  marks: Mark[];
  /** null while no mark counts. */
  learned: Learned | null;
  /** references of the shown run whose marks would decide most, the most first. */
  asked: Slug[];
}
