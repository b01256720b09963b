// Made from src/shapewright/studio/wire/requests.py by `python -m shapewright.studio.wire.typescript`.

import type { JobKind } from "./jobs";
import type { Slug, Values } from "./values";

export type Part = "replicas" | "samples" | "report" | "parameters";

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
  /** whether to send the two surfaces with their distances. */
  residuals: boolean;
}

/** Other tiles are on the screen; their pictures and measures are to come first. */
export interface Visible {
  type: "visible";
  slugs: Slug[];
}

export type PageMessage = Evaluate | Visible;

/** A new text of the procedure. digest: of the text that the edit began from; null to write over any. */
export interface SourceEdit {
  text: string;
  digest?: string | null;
}

/** FitOrder */
export interface FitOrder {
  /** learn anew, and do not resume the run before. */
  fresh?: boolean;
}

/** What to pack. count: of random samples. seed: of random samples. */
export interface ExportOrder {
  what: Part[];
  format?: ExportFormat;
  count?: number;
  seed?: number;
}

/** End a job. */
export interface CancelOrder {
  kind: JobKind;
}

/** Put a run's procedure back. digest: as in SourceEdit. */
export interface RestoreOrder {
  digest?: string | null;
}

/** Write a suggestion's procedure: beside the procedure, or in its place. digest: as in SourceEdit. */
export interface ApplyOrder {
  to: "copy" | "procedure";
  digest?: string | null;
}

/** A text of the procedure. digest: of the text. */
export interface Source {
  path: string;
  text: string;
  digest: string;
}

/** The procedure was written. digest: of the new text. */
export interface Written {
  digest: string;
}

/** The procedure was written. digest: of the new text. undo: the text that was there. */
export interface Replaced {
  digest: string;
  undo: string;
}

/** A new file was written. */
export interface Copied {
  path: string;
  text: string;
}
