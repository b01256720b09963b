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

/** A part of a suggestion, to be accepted alone. */
export interface Hunk {
  /** from 0. */
  number: number;
  /** that it changes in the file as it is now, and those around them. */
  lines: DiffLine[];
  /** the file has it already. */
  there: boolean;
  /** why it does not fit what was written since; null where it does. */
  refused: string | null;
}

/** A suggestion in the file as it is now. */
export interface Merging {
  /** of the file's text, which its parts are of. */
  digest: string;
  /** in the order of the file; empty where the file has all of it. */
  hunks: Hunk[];
  /** why it does not fit as a whole; null where it does. */
  refused: string | null;
}

/** What the author notes of one reference. */
export interface Noted {
  tags: string[];
  note: string;
  /** no part of the collection: it leaves the count, and the next fit does without it. */
  not_mine: boolean;
}

export type ToldKind = "tags" | "note" | "not mine" | "file";

/** One change of what is told of references. */
export interface ToldChange {
  /** from 1, the oldest. */
  number: number;
  /** date and time, ISO 8601, UTC. */
  written: string;
  kind: ToldKind;
  /** names. */
  references: string[];
  /** tags. */
  added: string[];
  /** tags. */
  removed: string[];
  /** number of the change that this one took back. */
  undoes: number | null;
  /** a later one took it back. */
  undone: boolean;
}

/** Something was told of references. */
export interface ToldAnswer {
  /** of the change, which can be undone; null where nothing changed. */
  number: number | null;
}
