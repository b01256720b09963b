// Made from src/shapewright/studio/wire/changes.py by `python tools/message_types.py`.

import type { Collection, Duplicate, Procedure, Tile } from "./collection";
import type { Job, JobKind, Line, Run, Sweep } from "./work";
import type { Judge, Marking } from "./judgement";
import type { Noted } from "./revisions";
import type { Problem } from "./problems";
import type { Slug } from "./values";

/** Of the author's project: its name, and where its parts are. */
export interface ProjectNames {
  name: string;
  folder: string;
  procedure: string;
  references: string;
  /** whether the page may put files among the references. */
  takes_files: boolean;
}

/** What the author chose. */
export interface ChosenSettings {
  /** a fit follows every save. */
  auto_fit: boolean;
  /** fits do not resume the run before. */
  fresh: boolean;
  scale: "clear" | "paper";
  preset: "fast" | "paper";
  samples: number;
  epochs: number;
  refine: "off" | "quick" | "thorough";
  facing: "given" | "found";
  rounds: number;
  seed: number;
  judge: Judge;
  replicated: number;
  close: number;
  threshold: number;
  vif: number;
  shape_seconds: number;
  drop: string;
  leave_out: string;
}

/** Everything. It is the first message, and replaces all. */
export interface State {
  type: "state";
  version: string;
  project: ProjectNames;
  dimension: 2 | 3;
  /** the process that measures; live evaluation waits until it is ready. */
  bench: "starting" | "ready" | "restarting";
  procedure: Procedure;
  collection: Collection;
  jobs: Record<JobKind, Job>;
  /** null while none runs. */
  sweep: Sweep | null;
  /** the oldest first. */
  runs: Run[];
  settings: ChosenSettings;
  marking: Marking;
  /** of the references of which something is noted. */
  noted: Record<Slug, Noted>;
  /** known so far. */
  duplicates: Duplicate[];
  /** the run that is shown has one. */
  explanation: boolean;
  /** what was printed last, the oldest first. */
  console: Line[];
  /** of the whole project, the worst first; empty when all is well. */
  problems: Problem[];
}

/** Replaces ``State.procedure``. */
export interface ProcedureChanged {
  type: "procedure";
  procedure: Procedure;
}

/** Replaces the tiles with these slugs; one whose slug is not known is new. */
export interface TilesChanged {
  type: "tiles";
  tiles: Tile[];
}

/** Replaces ``State.collection``. */
export interface CollectionChanged {
  type: "collection";
  collection: Collection;
}

/** Replaces the job of this kind. */
export interface JobChanged {
  type: "job";
  job: Job;
}

/** Replaces ``State.sweep``. */
export interface SweepChanged {
  type: "sweep";
  sweep: Sweep | null;
}

/** Replaces ``State.runs``. */
export interface RunsChanged {
  type: "runs";
  runs: Run[];
}

/** Replaces ``State.marking``. */
export interface MarksChanged {
  type: "marks";
  marking: Marking;
}

/** Replaces ``State.noted``. */
export interface NotedChanged {
  type: "noted";
  noted: Record<Slug, Noted>;
}

/** Replaces ``State.duplicates``. */
export interface DuplicatesChanged {
  type: "duplicates";
  duplicates: Duplicate[];
}

/** Replaces ``State.settings``. */
export interface SettingsChanged {
  type: "settings";
  settings: ChosenSettings;
}

/** Lines that follow those of ``State.console``. */
export interface LinesPrinted {
  type: "printed";
  lines: Line[];
}

/** Replaces ``State.problems``. */
export interface ProblemsChanged {
  type: "problems";
  problems: Problem[];
}

/** Replaces ``State.explanation``. */
export interface ExplanationChanged {
  type: "explanation";
  explanation: boolean;
}

/** Answers a message of the page that makes no sense. */
export interface WrongMessage {
  type: "wrong";
  error: string;
}

export type Change = State | ProcedureChanged | TilesChanged | CollectionChanged | JobChanged | SweepChanged | RunsChanged | MarksChanged | NotedChanged | DuplicatesChanged | SettingsChanged | LinesPrinted | ProblemsChanged | ExplanationChanged | WrongMessage;
