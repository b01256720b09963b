// Made from src/shapewright/studio/wire/revisions.py by `python tools/message_types.py`.

import type { DiffLine } from "./work";

export type Writer = "editor" | "suggestion" | "run" | "undo" | "another program";

/** One write of the procedure. */
export interface Revision {
  /** from 1, the oldest. */
  number: number;
  /** date and time, ISO 8601, UTC. */
  written: string;
  writer: Writer;
  /** title of the suggestion, name of the run, number of the write that was undone; else empty. */
  of: string;
  /** lines. */
  added: number;
  /** lines. */
  removed: number;
  /** digest of the text that was there. */
  before: string;
  /** digest of the text that came. */
  after: string;
}

/** One write of the procedure, and what it changed. */
export interface RevisionDetail {
  revision: Revision;
  /** whole. */
  diff: DiffLine[];
}
