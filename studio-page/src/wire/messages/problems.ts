// Made from src/shapewright/studio/wire/problems.py by `python tools/message_types.py`.

import type { Slug, Values } from "./values";

export type ProblemKind = "infeasible" | "raised" | "no shape" | "time" | "memory" | "crash" | "syntax" | "load" | "references" | "fit" | "explain" | "export" | "project";

/** An error that the author can mend. */
export interface Problem {
  kind: ProblemKind;
  message: string;
  /** the author's, relative to the project. */
  file: string | null;
  /** in this file, from 1. */
  line: number | null;
  /** that line. */
  text: string | null;
  /** the shapes that it befell. */
  slugs: Slug[];
  /** of one of these shapes. */
  parameters: Values | null;
  /** how many shapes it befell. */
  count: number | null;
}
