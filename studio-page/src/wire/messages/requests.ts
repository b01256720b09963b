// Made from src/shapewright/studio/wire/requests.py by `python tools/message_types.py`.

import type { JobKind } from "./work";
import type { Slug, Values } from "./values";
import type { Told } from "./detail";

export type Turn = "around" | "tip" | "over";

export type Part = "replicas" | "samples" | "report" | "parameters";

export type Frame = "procedure" | "reference";

export type ExportFormat = "glb" | "ply" | "obj" | "stl" | "off";

/** Build a replica and measure it. */
export interface Evaluate {
  type: "evaluate";
  /** rises from one to the next; the answers carry it. */
  id: number;
  /** null for a shape alone, measured against nothing. */
  slug: Slug | null;
  /** those left out are as found, or without a slug at their defaults. */
  parameters: Values | null;
  /** names of numbers that may lie outside their Range; all others take the nearest value in it. */
  beyond: string[];
  /** whether to send the two surfaces with their distances. */
  residuals: boolean;
}

/** Build, draw and examine many shapes without references, at random or along parameters. */
export interface Explore {
  type: "explore";
  /** rises from one to the next; the answers carry it. */
  id: number;
  /** the same one gives the same random shapes. */
  seed: number;
  /** of random shapes. */
  count: number;
  /** values that all shapes have. */
  locked: Values;
  /** names of parameters to go along, in place of random shapes. */
  vary: string[];
  /** what does not vary then; what is left out is at its default. */
  base: Values | null;
}

/** Other tiles are on the screen; their pictures and measures are to come first. */
export interface Visible {
  type: "visible";
  slugs: Slug[];
}

export type PageMessage = Evaluate | Explore | Visible;

/** Of what replica a picture is asked for. */
export interface Given {
  /** null for those that are shown. */
  parameters?: Values | null;
  /** as in Evaluate. */
  beyond?: string[];
}

/** A new text of the procedure. */
export interface SourceEdit {
  text: string;
  /** of the text that the edit began from; null to write over any. */
  digest?: string | null;
}

/** A text to be put into a new file beside the procedure. */
export interface CopyOrder {
  text: string;
}

/** Fit. */
export interface FitOrder {
  /** learn anew, and do not resume the run before. */
  fresh?: boolean;
}

/** What to pack. */
export interface ExportOrder {
  what: Part[];
  /** of meshes; drawings are SVG. */
  format?: ExportFormat;
  /** of replicas that are meshes. */
  frame?: Frame;
  /** of random samples. */
  count?: number;
  /** of random samples. */
  seed?: number;
}

/** Say something of references, in place of what was told of them before. */
export interface TellOrder {
  slugs: Slug[];
  told: Told;
}

/** Note something of references; what it does not name stays. */
export interface NoteOrder {
  slugs: Slug[];
  /** tags. */
  add?: string[];
  /** tags. */
  remove?: string[];
  /** empty for none. */
  note?: string | null;
  not_mine?: boolean | null;
}

/** Turn references by right angles, from how they stand now. */
export interface TurnOrder {
  slugs: Slug[];
  turn: Turn;
}

/** Say the unit of the lengths in the files of references. */
export interface UnitOrder {
  slugs: Slug[];
  /** null: what the file says. */
  unit: "mm" | "cm" | "m" | "in" | "ft" | null;
}

/** Mark a pair of references, or where ``a`` is ``b`` a reference and its own replica. */
export interface MarkOrder {
  a: Slug;
  b: Slug;
  /** null takes the mark away. */
  same: boolean | null;
}

/** End a job. */
export interface CancelOrder {
  kind: JobKind;
}

/** Put a run's procedure back, or the text before a write. */
export interface RestoreOrder {
  /** as in SourceEdit. */
  digest?: string | null;
}

/** Write a suggestion's procedure: beside the procedure, or in its place. */
export interface ApplyOrder {
  to: "copy" | "procedure";
  /** as in SourceEdit. */
  digest?: string | null;
  /** numbers of the parts that are accepted, of the text with this digest; null for all. */
  hunks?: number[] | null;
}

/** A text of the procedure. */
export interface Source {
  path: string;
  text: string;
  /** of the text. */
  digest: string;
  /** why there is no text, as of a file that was deleted; text and digest are empty then. */
  unreadable: string | null;
}

/** The procedure was written. */
export interface Replaced {
  /** of the new text. */
  digest: string;
  /** number of the write, which can be undone; null where the text was this one already. */
  revision: number | null;
}

/** A new file was written. */
export interface Copied {
  path: string;
  text: string;
}

/** A file of a reference was put into the project. */
export interface Arrived {
  /** its name in the folder of references. */
  path: string;
  bytes: number;
  /** the same file was there already, and stays. */
  there: boolean;
}
