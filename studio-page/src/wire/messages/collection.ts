// Made from src/shapewright/studio/wire/collection.py by `python tools/message_types.py`.

import type { Address, Axis, Slug, Value } from "./values";
import type { Counts, Grade, Judge, Pose } from "./judgement";
import type { Problem } from "./problems";

export type Stage = "none" | "carried" | "early" | "predicted" | "trained";

/** Which axes of a file point up and to the front, where these are to be found. */
export interface Axes {
  up: Axis;
  front: Axis;
  /** who says so; found: it was turned to stand so. */
  by: "author" | "format" | "floor" | "default" | "found";
}

/** One reference and its replica. */
export interface Tile {
  /** 0 to 1; null until it is measured, and in runs of before this judge. */
  fidelity: number | null;
  /** the paper's; null until it is measured, which may be a moment after the replica is shown. */
  distance: number | null;
  /** by the collection's judge; different without a replica. */
  grade: Grade;
  /** by the paper's measure. */
  compatible: boolean;
  /** of the grade; by the paper's judge of the distance: green at 0, yellow at the threshold, red. */
  colour: string | null;
  slug: Slug;
  /** what people read. */
  name: string;
  /** its picture, square on transparent; null until it is drawn. */
  reference: Address | null;
  /** picture of the replica; null until there is one. */
  replica: Address | null;
  /** null until they are known, and where nobody looks for them. */
  axes: Axes | null;
  /** index into the collection's groups; while a fit runs, these are those of the run before. */
  group: number | null;
  stage: Stage;
  /** the replica is of an older version of the procedure. */
  stale: boolean;
  /** fidelity in the run before; by the paper's judge its distance. */
  previous: number | null;
  /** parameters whose longer Range would bring it nearer; empty before an explanation. */
  longer: string[];
  /** null where the reference stands as its replica, or is not explained. */
  pose: Pose | null;
  problem: Problem | null;
}

/** References that are not replicated and look alike. */
export interface Group {
  /** the nearest to the group's centre; null when none of its members is there any more. */
  representative: Slug | null;
  /** the nearest to the centre first. */
  members: Slug[];
}

/** A file that could not be read. */
export interface Skipped {
  path: string;
  reason: string;
}

/** A reference that is like one before it. */
export interface Duplicate {
  slug: Slug;
  /** the one before it, which is no duplicate itself. */
  of: Slug;
  /** it is the same shape but for size, place and format; else it only looks nearly the same. */
  equal: boolean;
  /** quarter turns about the up axis that bring it into the pose of the other. */
  quarters: number;
}

/** All references. */
export interface Collection {
  /** the run that is shown; null before the first. */
  run: string | null;
  /** that gives the grades. */
  judge: Judge;
  /** the least fidelity of a replicated reference. */
  replicated: number;
  /** the least fidelity of a close one. */
  close: number;
  /** the largest distance of a compatible one. */
  threshold: number;
  /** what distances are. */
  measure: string;
  /** when a replica is compatible, in words. */
  criterion: string;
  /** of all references but those that are left out. */
  count: number;
  /** of these. */
  counts: Counts;
  /** the author says that they are not his. */
  left_out: Slug[];
  /** in natural order of names. */
  tiles: Tile[];
  /** the largest first. */
  groups: Group[];
  skipped: Skipped[];
}

/** One parameter of the procedure. */
export interface Parameter {
  name: string;
  kind: "scalar" | "integer" | "choice" | "binary";
  /** of a scalar or an integer. */
  low: number | null;
  /** of a scalar or an integer. */
  high: number | null;
  /** of a scalar: how many values, or which, it is sampled at; it may lie between. */
  steps: number | number[] | null;
  /** of a choice. */
  options: Value[] | null;
  default: Value;
  /** what the author says of it in words. */
  meaning: string;
  /** it has a ``when``; every evaluation says which parameters are active. */
  conditional: boolean;
}

/** The procedure on disk. */
export interface Procedure {
  /** when broken, the parameters are those of the last good version. */
  state: "loading" | "good" | "broken";
  /** another version than the file on disk made the run that is shown. */
  stale: boolean;
  name: string;
  /** of the text on disk. */
  digest: string;
  /** digest of the version that the newest fit used. */
  fitted: string | null;
  parameters: Parameter[];
}
