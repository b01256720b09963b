/** What page and server say to each other: src/shapewright/studio/wire/PROTOCOL.md, as types. */

export type Value = number | string | boolean;
export type Values = Record<string, Value>;
export type Slug = string;

export interface State {
  version: string;
  project: { name: string; folder: string; procedure: string; references: string };
  dimension: 2 | 3;
  bench: "starting" | "ready" | "restarting";
  procedure: Procedure;
  collection: Collection;
  jobs: Record<JobKind, Job>;
  runs: Run[];
  settings: Settings;
  marks: Mark[];
  explanation: boolean;
  problems: Problem[];
}

export interface Problem {
  kind: string;
  message: string;
  file: string | null;
  line: number | null;
  text: string | null;
  count: number | null;
  slugs: Slug[];
  parameters: Values | null;
}

export interface Procedure {
  state: "loading" | "good" | "broken";
  stale: boolean;
  name: string;
  digest: string;
  fitted: string | null;
  parameters: Parameter[];
}

export interface Parameter {
  name: string;
  kind: "scalar" | "integer" | "choice" | "binary";
  low: number | null;
  high: number | null;
  steps: number | number[] | null;
  options: Value[] | null;
  default: Value;
  conditional: boolean;
}

export interface Collection {
  run: string | null;
  threshold: number;
  measure: string;
  /** When a replica is compatible, in words. */
  criterion?: string;
  count: number;
  compatible: number;
  tiles: Tile[];
  groups: Group[];
  skipped: { path: string; reason: string }[];
}

export interface Group {
  representative: Slug;
  members: Slug[];
}

export type Answer = "none" | "carried" | "early" | "predicted" | "trained";

export interface Tile {
  slug: Slug;
  name: string;
  reference: string | null;
  replica: string | null;
  distance: number | null;
  colour: string | null;
  compatible: boolean;
  group: number | null;
  stage: Answer;
  stale: boolean;
  previous: number | null;
  at_limit: string[];
  problem: Problem | null;
}

export interface Run {
  run: string;
  created: string;
  references: number;
  compatible: number;
  groups: number;
  digest: string;
  procedure: string;
  seconds: number;
  explained: boolean;
  current: boolean;
}

export type JobKind = "fit" | "explain" | "export";

export interface Job {
  kind: JobKind;
  state: "idle" | "running" | "cancelling" | "done" | "cancelled" | "failed";
  stages: JobStage[];
  curve: Epoch[];
  answer: string | null;
  seconds: number;
  problem: Problem | null;
  result: { run?: string; url?: string; bytes?: number } | null;
}

export interface JobStage {
  name: string;
  done: number;
  total: number;
  remark: string;
  seconds: number;
}

export interface Epoch {
  epoch: number;
  train: number;
  validation: number | null;
}

export interface Settings {
  auto_fit: boolean;
  preset: string;
  samples: number;
  epochs: number;
  refine: string;
  rounds: number;
  seed: number;
  threshold: number;
  shape_seconds: number;
  fresh: boolean;
}

/** a and b the same: the reference and its own replica. */
export interface Mark {
  a: Slug;
  b: Slug;
  same: boolean;
}

export type Triple = [number, number, number];

export interface Reference {
  slug: Slug;
  name: string;
  path: string | null;
  triangles: number | null;
  notes: string[];
  units: { centre: number[]; scale: number; axes: number[][]; size: number[] };
  parameters: Values | null;
  active: string[];
  at_limit: string[];
  distance: number | null;
  iou: number | null;
  chamfer: number | null;
  colour: string | null;
  compatible: boolean;
  group: number | null;
  stage: Answer;
  problem: Problem | null;
  predicted: Values | null;
  spread: Record<string, number> | null;
  likelihood: Record<string, Record<string, number>> | null;
  explanation: ReferenceExplanation | null;
}

export interface ReferenceExplanation {
  causes: { kind: string; text: string; evidence: unknown }[];
  regions: Region[];
  /** Where the replica stood when they were compared: (normalised - centre) * scale. */
  placement?: { centre: Triple; scale: number };
}

export interface Region {
  /** Of the reference, or of the replica. */
  side: "unexplained" | "surplus";
  centre: Triple;
  size: Triple;
  axes: [Triple, Triple, Triple];
  share: number | null;
  distance: number | null;
  label: string | null;
  rule: string | null;
}

export interface Suggestion {
  kind: string;
  title: string;
  text: string;
  snippet: string;
  source: string | null;
  picture: string | null;
  references: Slug[];
  gain: number | null;
  tried: unknown;
}

/** References that share a cause. */
export interface SharedCause {
  kind: string;
  text: string;
  references: Slug[];
}

export interface Explanation {
  references: Record<Slug, ReferenceExplanation>;
  summary?: SharedCause[];
  suggestions: Suggestion[];
}

export interface RunDetail {
  run: Run;
  collection: Collection;
  source: string;
  parameters: Parameter[];
  settings: Record<string, unknown>;
  seconds: Record<string, number>;
  curve: Epoch[];
  validation: Record<string, Record<string, number | string>>;
}

export interface Move {
  name: string;
  slug: Slug;
  before: number | null;
  after: number | null;
  colour_before: string | null;
  colour_after: string | null;
  reference: string | null;
  replica_before: string | null;
  replica_after: string | null;
}

export interface DiffLine {
  kind: "same" | "added" | "removed";
  before: number | null;
  after: number | null;
  text: string;
}

export interface Comparison {
  before: Run;
  after: Run;
  gained: Move[];
  lost: Move[];
  closer: Move[];
  further: Move[];
  same: number;
  added: string[];
  removed: string[];
  diff: DiffLine[];
}

/** What an evaluation says of the replica besides its geometry. */
export interface Outcome {
  parameters: Values;
  active: string[];
  at_limit: string[];
  units: { size: number[] };
  milliseconds: number;
}

export interface MeshHead extends Partial<Outcome> {
  type: "mesh";
  id: number;
  slug: Slug | null;
  shape: "replica" | "reference";
  label_names: string[];
}

export interface ResidualsHead {
  type: "residuals";
  id: number;
  slug: Slug;
  shape: "replica" | "reference";
  signed: boolean;
  limit: number;
}

export interface MeshMessage extends MeshHead {
  positions: Float32Array;
  indices: Uint32Array;
  labels: Int32Array | null;
}

export interface ResidualsMessage extends ResidualsHead {
  positions: Float32Array;
  indices: Uint32Array;
  colours: Float32Array;
  distances: Float32Array;
}

export interface DrawingMessage extends Partial<Outcome> {
  type: "drawing";
  id: number;
  slug: Slug | null;
  shape: "replica" | "reference";
  path: string;
  missing: string | null;
  excess: string | null;
}

export interface DistanceMessage {
  type: "distance";
  id: number;
  slug: Slug;
  distance: number | null;
  iou: number | null;
  chamfer: number | null;
  colour: string | null;
  compatible: boolean;
}

export interface FailedMessage {
  type: "failed";
  id: number;
  slug: Slug | null;
  problem: Problem;
  active: string[] | null;
}

export type Evaluated = MeshMessage | DrawingMessage | DistanceMessage | ResidualsMessage | FailedMessage;

/** Changes of the state, by the part that they replace. */
export type Change =
  | ({ type: "state" } & State)
  | { type: "procedure"; procedure: Procedure }
  | { type: "tiles"; tiles: Tile[] }
  | { type: "collection"; collection: Collection }
  | { type: "job"; job: Job }
  | { type: "runs"; runs: Run[] }
  | { type: "marks"; marks: Mark[] }
  | { type: "settings"; settings: Settings }
  | { type: "problems"; problems: Problem[] }
  | { type: "explanation"; explanation: boolean }
  | { type: "wrong"; error: string };
