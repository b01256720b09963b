/** What the page knows: one signal for each part of the server's state, and what is derived from several. */

import { computed, signal } from "@preact/signals";
import type {
  Change,
  ChosenSettings,
  Collection,
  Duplicate,
  Job,
  JobKind,
  Mark,
  Marking,
  Noted,
  Problem,
  Procedure,
  Run,
  Slug,
  State,
  Sweep,
  Tile,
} from "../wire/messages";
import { take } from "./printed";
import { connect } from "../wire/live";
import { counted } from "./grades";
import { complain, tell } from "./notices";

const idle = (kind: JobKind): Job => ({
  kind,
  state: "idle",
  stages: [],
  curve: [],
  answer: null,
  seconds: 0,
  left: null,
  problem: null,
  result: null,
});

export const ready = signal(false);
export const connected = signal(true);
/** Why there is no connection, and what to do. */
export const lost = signal("");
/** Whether a studio is there that does not know this page. */
export const startedAnew = signal(false);
export const version = signal("");
export const project = signal<State["project"]>({
  name: "",
  folder: "",
  procedure: "procedure.py",
  references: "",
  takes_files: false,
});
export const dimension = signal<2 | 3>(3);
export const bench = signal<State["bench"]>("starting");
export const procedure = signal<Procedure>({
  state: "loading",
  stale: false,
  name: "",
  digest: "",
  fitted: null,
  parameters: [],
});
export const collection = signal<Collection>({
  run: null,
  judge: "fidelity",
  replicated: 0.5,
  close: 0.2,
  threshold: 0.18,
  measure: "",
  criterion: "",
  count: 0,
  counts: { replicated: 0, close: 0, different: 0, compatible: 0 },
  left_out: [],
  tiles: [],
  groups: [],
  skipped: [],
});
export const jobs = {
  fit: signal(idle("fit")),
  explain: signal(idle("explain")),
  export: signal(idle("export")),
};
/** New replicas that are being built and measured; null while there are none. */
export const sweep = signal<Sweep | null>(null);
export const runs = signal<Run[]>([]);
export const settings = signal<ChosenSettings | null>(null);
export const marking = signal<Marking>({ marks: [], learned: null, asked: [] });
export const marks = computed((): Mark[] => marking.value.marks);
/** What the author notes of references. */
export const noted = signal<Record<Slug, Noted>>({});
export const duplicates = signal<Duplicate[]>([]);
export const duplicateOf = computed(() => new Map(duplicates.value.map((one) => [one.slug, one])));
/** All tags, the commonest first, with how many references have each. */
export const tags = computed(() => {
  const counts = new Map<string, number>();
  for (const one of Object.values(noted.value)) for (const tag of one.tags) counts.set(tag, (counts.get(tag) ?? 0) + 1);
  return new Map([...counts].sort(([a, i], [b, j]) => j - i || a.localeCompare(b)));
});
export const leftOut = computed((): ReadonlySet<Slug> => new Set(collection.value.left_out));
export const explained = signal(false);
export const problems = signal<Problem[]>([]);

export const tiles = computed(() => new Map(collection.value.tiles.map((tile) => [tile.slug, tile])));
export const fitting = computed(() => ["running", "cancelling"].includes(jobs.fit.value.state));

/** How many replicas another text of the procedure made, and how many are not measured yet. */
export const unsure = computed(() => {
  const shown = collection.value.tiles.filter(({ replica, slug }) => replica !== null && !leftOut.value.has(slug));
  return {
    stale: shown.filter(({ stale }) => stale).length,
    unmeasured: shown.filter(({ stale, distance, problem }) => !stale && distance === null && problem === null).length,
  };
});

export const tileOf = (slug: Slug): Tile | undefined => tiles.value.get(slug);

export function start(): void {
  connect({
    changed: apply,
    connected: (why, anew) => {
      connected.value = why === null;
      startedAnew.value = anew;
      lost.value = why ?? "";
    },
  });
}

function apply(change: Change): void {
  switch (change.type) {
    case "state":
      return replace(change);
    case "procedure":
      procedure.value = change.procedure;
      return;
    case "tiles":
      return replaceTiles(change.tiles);
    case "collection":
      collection.value = change.collection;
      return;
    case "job":
      jobs[change.job.kind].value = change.job;
      return;
    case "sweep":
      sweep.value = change.sweep;
      return;
    case "runs":
      tellOfOthers(change.runs);
      runs.value = change.runs;
      return;
    case "marks":
      marking.value = change.marking;
      return;
    case "noted":
      noted.value = change.noted;
      return;
    case "duplicates":
      duplicates.value = change.duplicates;
      return;
    case "settings":
      settings.value = change.settings;
      return;
    case "printed":
      take(change.lines, false);
      return;
    case "problems":
      problems.value = change.problems;
      return;
    case "explanation":
      explained.value = change.explanation;
      return;
    case "wrong":
      complain(change.error);
  }
}

function replace(state: State): void {
  version.value = state.version;
  project.value = state.project;
  dimension.value = state.dimension;
  bench.value = state.bench;
  procedure.value = state.procedure;
  collection.value = state.collection;
  for (const kind of ["fit", "explain", "export"] as const) jobs[kind].value = state.jobs[kind];
  sweep.value = state.sweep;
  runs.value = state.runs;
  settings.value = state.settings;
  marking.value = state.marking;
  noted.value = state.noted;
  duplicates.value = state.duplicates;
  explained.value = state.explanation;
  problems.value = state.problems;
  take(state.console, true);
  ready.value = true;
}

/** A run that was made beside this page from another text is not shown, so it is told. */
function tellOfOthers(now: Run[]): void {
  const known = new Set(runs.value.map(({ run }) => run));
  for (const { run, digest } of now) {
    if (!known.has(run) && digest !== procedure.value.digest)
      tell(`Run ${run} is new, of another text of the procedure: see History.`);
  }
}

function replaceTiles(changed: Tile[]): void {
  const bySlug = new Map(changed.map((tile) => [tile.slug, tile]));
  const kept = collection.value.tiles.map((tile) => {
    const next = bySlug.get(tile.slug);
    bySlug.delete(tile.slug);
    return next ? provisional(next, tile) : tile;
  });
  const all = [...kept, ...bySlug.values()];
  const counting = all.filter(({ slug }) => !leftOut.value.has(slug));
  collection.value = { ...collection.value, tiles: all, count: counting.length, counts: counted(counting) };
}

/** A replica that is not measured yet keeps the grade of before, so that tiles do not jump there and back. */
function provisional(next: Tile, before: Tile): Tile {
  const waits = next.distance === null && next.replica !== null && next.problem === null;
  return waits ? { ...next, grade: before.grade, compatible: before.compatible } : next;
}
