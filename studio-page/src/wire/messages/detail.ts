// Made from src/shapewright/studio/wire/detail.py by `python tools/message_types.py`.

import type { Address, Axis, Slug, Values, Vector } from "./values";
import type { Grade, Measures, Piece, Pose } from "./judgement";
import type { Problem } from "./problems";
import type { Stage } from "./collection";

/** The way back from the normalised frame: own = axes^T @ (normalised / scale + centre). In 2D, vectors of two. */
export interface Units {
  centre: number[];
  scale: number;
  /** unit vectors. */
  axes: number[][];
  /** extents in own units, along the file's axes. */
  size: number[];
}

/** What only somebody who has read its file knows of a reference. */
export interface About {
  /** null of a drawing. */
  triangles: number | null;
  notes: string[];
  units: Units;
}

/** What the author says of one file alone; null: what holds for all. */
export interface Told {
  /** that points up in it. */
  up: Axis | null;
  /** that points to the front. */
  front: Axis | null;
  /** of its lengths. */
  unit: "mm" | "cm" | "m" | "in" | "ft" | null;
  /** which objects in it the next fit takes as references. */
  split: "off" | "apart" | "names" | null;
}

/** Where the replica stood when the two were compared: (normalised - centre) * scale. */
export interface Placement {
  centre: Vector;
  scale: number;
}

/** A box around what one surface has and the other has not, in the normalised frame. */
export interface Region {
  /** unexplained ones are of the reference, surplus ones of the replica. */
  side: "unexplained" | "surplus";
  centre: Vector;
  size: Vector;
  /** unit vectors. */
  axes: [Vector, Vector, Vector];
  share: number | null;
  distance: number | null;
  label: string | null;
  rule: string | null;
}

/** Why a replica differs. */
export interface Cause {
  kind: string;
  text: string;
  evidence: unknown;
  /** PNG in base64, where words are not enough. */
  picture?: string;
}

/** Why one reference is not replicated; explanations of earlier versions have no placement. */
export interface ReferenceExplanation {
  causes: Cause[];
  /** what still differs in a replica that is good enough. */
  remark?: Cause | null;
  regions: Region[];
  placement?: Placement;
}

/** References that share a cause. */
export interface SharedCause {
  kind: string;
  text: string;
  references: Slug[];
  representative?: Slug | null;
}

/** A line of a procedure and its changed version. */
export interface ChangedLine {
  kind: "same" | "added" | "removed";
  /** its number in the older one, from 1. */
  before: number | null;
  /** its number in the newer one. */
  after: number | null;
  text: string;
}

/** A change of the procedure. */
export interface Suggestion {
  kind: string;
  title: string;
  text: string;
  snippet: string | null;
  /** the procedure with the change; null where there is nothing to apply. */
  source: string | null;
  picture: Address | null;
  /** those that it would help. */
  references: Slug[];
  gain: number | null;
  tried: unknown;
  /** lines that it changes, and those around them. */
  diff?: ChangedLine[];
}

/** A change of the procedure that was tried, whether or not it is suggested. */
export interface Tried {
  title: string;
  kind: string;
  /** misfits that it brought nearer. */
  nearer: number;
  /** of these, how far the nearest is apart then: at most 1 is replicated. */
  best: number | null;
  seconds: number;
}

/** References that stand for all. */
export interface ExplainedSample {
  explained: number;
  of: number;
  text: string;
}

/** The explanation of the run that is shown. */
export interface Explanation {
  references: Record<Slug, ReferenceExplanation>;
  summary: SharedCause[];
  suggestions: Suggestion[];
  /** why none are sought. */
  unsuggested?: string | null;
  /** where only some were looked at. */
  sample?: ExplainedSample;
  tried?: Tried[];
  /** by stage. */
  seconds?: Record<string, number>;
}

/** The change of the procedure that brought most of those that were tried. */
export interface BestChange {
  title: string;
  /** references that become replicated. */
  gain: number;
  /** misfits that come nearer, these included. */
  nearer: number;
  /** its place among the suggestions; null for one that is not suggested. */
  suggestion: number | null;
}

/** What a run leaves to do. */
export interface NextStep {
  /** representative of the largest group that is not replicated. */
  group: Slug | null;
  /** of that group. */
  members: number;
  /** longest piece that the representative's replica lacks, as a share of the shape. */
  lacks: number | null;
  /** the reference with the longest region that its replica does not explain. */
  longest: Slug | null;
  /** of that region, as a share of the shape. */
  length: number | null;
  /** null before an explanation, and where none brought anything. */
  best: BestChange | null;
}

/** The parameters of one replica. */
export interface ParameterRow {
  slug: Slug;
  parameters: Values;
  /** names of those that matter. */
  active: string[];
}

/** The parameters of all replicas that are shown. */
export interface ParameterTable {
  /** the run that is shown. */
  run: string | null;
  rows: ParameterRow[];
  /** how well each parameter is predicted, on held-out samples. */
  validation: Record<string, Record<string, number | string | null>>;
  /** from which the network of this run learned. */
  samples: number | null;
}

/** A reference on the map. */
export interface MappedReference {
  slug: Slug;
  /** -1 to 1. */
  x: number;
  y: number;
}

/** A random shape of the procedure on the map. */
export interface MappedSample {
  parameters: Values;
  x: number;
  y: number;
}

/** References and random shapes of the procedure; alike ones are near each other. */
export interface CollectionMap {
  references: MappedReference[];
  samples: MappedSample[];
  /** references that are not looked at yet. */
  left: number;
}

/** One reference in one run. */
export interface Step {
  run: string;
  /** date and time, ISO 8601. */
  created: string;
  /** digest of its text. */
  procedure: string;
  replica: Address | null;
  fidelity: number | null;
  distance: number | null;
  /** by the run's own judge and cuts. */
  grade: Grade;
  colour: string | null;
  parameters: Values | null;
  active: string[];
  error: string | null;
}

/** One reference in full. */
export interface Reference {
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
  name: string;
  /** of its file, relative to the project where it lies inside. */
  path: string | null;
  /** null of a drawing, and while the bench starts. */
  triangles: number | null;
  notes: string[];
  /** null while the bench starts. */
  units: Units | null;
  /** of the replica that is shown. */
  parameters: Values | null;
  active: string[];
  at_limit: string[];
  /** as in Tile. */
  longer: string[];
  /** empty while the replica is not measured whole. */
  measures: Measures;
  /** of the reference; the largest first. */
  missing: Piece[];
  /** of the replica; the largest first. */
  surplus: Piece[];
  /** as in Tile. */
  pose: Pose | null;
  told: Told;
  group: number | null;
  stage: Stage;
  problem: Problem | null;
  /** what the network said, before the search. */
  predicted: Values | null;
  /** of scalars, about the size of the error to expect, in the parameter's own units. */
  spread: Record<string, number> | null;
  /** of the values of other parameters; those that are no text as JSON. */
  likelihood: Record<string, Record<string, number>> | null;
  explanation: ReferenceExplanation | null;
}
