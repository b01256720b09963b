/** How long jobs run: the server says so with every event, and time goes on between them. */

import { computed, effect, signal } from "@preact/signals";
import type { Job, JobKind } from "../wire/messages";
import { jobs } from "./studio";

const KINDS = Object.keys(jobs) as JobKind[];
const TICK = 500;

const now = signal(performance.now());
/** When the server was heard of each job. */
const heard: Record<JobKind, number> = { fit: 0, explain: 0, export: 0 };
const runs = ({ state }: Job) => state === "running" || state === "cancelling";
const anyRuns = computed(() => KINDS.some((kind) => runs(jobs[kind].value)));

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

/** Seconds that a job is likely to take still; null where nobody knows. */
export function left(kind: JobKind): number | null {
  const told = jobs[kind].value.left;
  return told === null ? null : Math.max(0, told - silent(kind));
}
