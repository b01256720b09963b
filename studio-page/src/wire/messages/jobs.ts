// Made from src/shapewright/studio/wire/jobs.py by `python tools/message_types.py`.

import type { Address } from "./values";
import type { Problem } from "./problems";

export type JobKind = "fit" | "explain" | "export";

export type JobState = "idle" | "running" | "cancelling" | "done" | "cancelled" | "failed";

export type Answer = "carried over" | "most similar samples" | "predicted";

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
  /** in order; the last one is running. A stage may come again. */
  stages: JobStage[];
  /** of a fit. */
  curve: Epoch[];
  /** of a fit: the newest early answer. */
  answer: Answer | null;
  seconds: number;
  problem: Problem | null;
  result: JobResult | null;
}
