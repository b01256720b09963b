/** How long jobs run: the server says so with every event, and time goes on between them. */

import { computed, effect, signal } from "@preact/signals";
import type { Job, JobKind } from "../wire/messages";
import { jobs, sweep } from "./studio";

const KINDS = Object.keys(jobs) as JobKind[];
const TICK = 500;

const now = signal(performance.now());
/** When the server was heard of each job. */
const heard: Record<JobKind, number> = { fit: 0, explain: 0, export: 0 };
const runs = ({ state }: Job) => state === "running" || state === "cancelling";
const anyRuns = computed(() => sweep.value !== null || KINDS.some((kind) => runs(jobs[kind].value)));

for (const kind of KINDS) {
  effect(() => {
    heard[kind] = jobs[kind].value && performance.now();
    now.value = heard[kind];
  });
}

effect(() => {
  if (!anyRuns.value) return;
  const timer = setInterval(() => (now.value = performance.now()), TICK);
  return () => clearInterval(timer);
});

/** Seconds since the server was heard of a job that runs; 0 of another. */
function silent(kind: JobKind): number {
  return runs(jobs[kind].value) ? Math.max(0, now.value - heard[kind]) / 1000 : 0;
}

/** Seconds that a job has run, or that it took. */
export const elapsed = (kind: JobKind): number => jobs[kind].value.seconds + silent(kind);

/** Seconds that the stage of a job has run that is under way. */
export const elapsedInStage = (kind: JobKind): number => (jobs[kind].value.stages.at(-1)?.seconds ?? 0) + silent(kind);

let sweepHeard = 0;
effect(() => {
  if (sweep.value) sweepHeard = performance.now();
});

export interface Work {
  what: JobKind | "sweep";
  stage: string;
  /** Of the stage, where it has several steps. */
  steps: { done: number; total: number } | null;
  remark: string;
  cancelling: boolean;
  elapsed: number;
  /** Seconds that it is likely to take still; null where nobody knows. */
  left: number | null;
  /** Of all the work, 0 to 1. */
  share: number;
}

/** What is under way: what the author waits for most comes first. */
export const work = computed((): Work[] => [...KINDS.flatMap(ofJob), ...ofSweep()]);

function ofJob(kind: JobKind): Work[] {
  const job = jobs[kind].value;
  if (!runs(job)) return [];
  const stage = job.stages.at(-1);
  const [spent, rest] = [elapsed(kind), left(kind)];
  const ofStage = stage && stage.total > 0 ? stage.done / stage.total : 0;
  return [
    {
      what: kind,
      stage: stage?.name ?? "open",
      steps: stage && stage.total > 1 ? stage : null,
      remark: stage?.remark ?? "",
      cancelling: job.state === "cancelling",
      elapsed: spent,
      left: rest,
      share: rest === null ? ofStage : spent / Math.max(spent + rest, 0.01),
    },
  ];
}

function ofSweep(): Work[] {
  if (!sweep.value) return [];
  const { done, total, seconds } = sweep.value;
  const since = Math.max(0, now.value - sweepHeard) / 1000;
  const rest = sweep.value.left === null ? null : Math.max(0, sweep.value.left - since);
  const told = { stage: done < total / 2 ? "build" : "measure", steps: { done, total }, remark: "", cancelling: false };
  return [{ what: "sweep", ...told, elapsed: seconds + since, left: rest, share: done / Math.max(1, total) }];
}

/** Seconds that a job is likely to take still; null where nobody knows. */
export function left(kind: JobKind): number | null {
  const told = jobs[kind].value.left;
  return told === null ? null : Math.max(0, told - silent(kind));
}
