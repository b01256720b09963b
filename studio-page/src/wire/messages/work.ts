// Made from src/shapewright/studio/wire/work.py by `python tools/message_types.py`.

import type { Address, Slug, Values } from "./values";
import type { Collection, Parameter } from "./collection";
import type { Counts, Grade, Judge } from "./judgement";
import type { Problem } from "./problems";

export type JobKind = "fit" | "explain" | "export";

export type JobState = "idle" | "running" | "cancelling" | "done" | "cancelled" | "failed";

export type Answer = "carried over" | "most similar samples" | "predicted";

export type Speaker = "procedure" | "fit" | "explain" | "export";

/** A line that was printed. */
export interface Line {
  /** one more than that of the line before. */
  number: number;
  speaker: Speaker;
  /** of the reference whose replica was built, where it is known. */
  slug: Slug | null;
  text: string;
}

/** A stage of a job, and how far it is. */
export interface JobStage {
  name: string;
  done: number;
  total: number;
  remark: string;
  seconds: number;
}

/** Losses of one epoch of training; ``validation`` is null where nothing was held back. */
export interface Epoch {
  epoch: number;
  train: number;
  validation: number | null;
}

/** What a job made. */
export interface JobResult {
  /** name of the run that a fit made or an explanation is of. */
  run?: string;
  /** of the file that an export made. */
  url?: Address;
  /** size of that file. */
  bytes?: number;
}

/** One kind of work, of which at most one runs. */
export interface Job {
  kind: JobKind;
  state: JobState;
  /** in order, "open" first; the last one is running. A stage may come again. */
  stages: JobStage[];
  /** of a fit. */
  curve: Epoch[];
  /** of a fit: the newest early answer. */
  answer: Answer | null;
  seconds: number;
  /** seconds that it is likely to take still; null where nobody knows. */
  left: number | null;
  problem: Problem | null;
  result: JobResult | null;
}

/** New replicas of the collection, of which each is built and then measured. */
export interface Sweep {
  /** steps. */
  done: number;
  /** steps: two for each replica. */
  total: number;
  seconds: number;
  /** seconds that it is likely to take still; null where nobody knows. */
  left: number | null;
}

/** A run in short. */
export interface Run {
  run: string;
  /** date and time, ISO 8601. */
  created: string;
  /** how many there are. */
  references: number;
  /** that gave the grades. */
  judge: Judge;
  counts: Counts;
  /** how many there are. */
  groups: number;
  /** of the procedure's text. */
  digest: string;
  /** its name. */
  procedure: string;
  seconds: number;
  /** it has an explanation. */
  explained: boolean;
  /** it is the one that is shown. */
  current: boolean;
}

/** A whole run. */
export interface RunDetail {
  run: Run;
  collection: Collection;
  /** parameters of its replicas. */
  values: Record<Slug, Values>;
  /** text of its procedure. */
  source: string;
  parameters: Parameter[];
  settings: Record<string, unknown>;
  /** by stage. */
  seconds: Record<string, number>;
  curve: Epoch[];
  /** how well each parameter is predicted. */
  validation: Record<string, Record<string, number | string | null>>;
}

/** A reference whose fidelity, or by the paper's judge whose distance, changed. */
export interface Move {
  name: string;
  /** null for one that is not in the collection any more. */
  slug: Slug | null;
  before: number | null;
  after: number | null;
  grade_before: Grade;
  grade_after: Grade;
  colour_before: string | null;
  colour_after: string | null;
  reference: Address | null;
  replica_before: Address | null;
  replica_after: Address | null;
}

/** A line of two texts. */
export interface DiffLine {
  kind: "same" | "added" | "removed";
  /** its number in the older one, from 1. */
  before: number | null;
  /** its number in the newer one. */
  after: number | null;
  text: string;
}

/** Two runs side by side. */
export interface Comparison {
  before: Run;
  after: Run;
  /** the paper's where the two runs have different ones. */
  judge: Judge;
  gained: Move[];
  lost: Move[];
  closer: Move[];
  further: Move[];
  /** how many references did not move. */
  same: number;
  /** names of references. */
  added: string[];
  /** names of references. */
  removed: string[];
  /** of the procedures, whole. */
  diff: DiffLine[];
}
