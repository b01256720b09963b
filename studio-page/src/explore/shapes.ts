/** The shapes that are explored: what is asked for, and what came of it. It lasts over a reload of the tab. */

import { computed, effect, signal } from "@preact/signals";
import { bench, connected, procedure } from "../state/studio";
import { explore, onExplored } from "../wire/live";
import type { Along, ExploredMessage, Problem, Soundness, Value, Values } from "../wire/messages";

export const COUNT = 24;
const KEPT = "shapewright.explore";
const SEEDS = 10_000;

interface Asked {
  seed: number;
  locked: Values;
  vary: string[];
  base: Values | null;
}

/** What is asked for. */
export const asked = signal<Asked>({ seed: 1, locked: {}, vary: [], base: null, ...kept() });
/** The seeds before, the newest last. */
export const seeds = signal<number[]>([]);
/** The parameters of each shape, as soon as they are known. */
export const planned = signal<Values[]>([]);
export const along = signal<Along[]>([]);
export const shapes = signal<ReadonlyMap<number, ExploredMessage>>(new Map());
/** Why there are no shapes. */
export const problem = signal<Problem | null>(null);
/** The request that is answered. */
export const answered = signal(0);
let number = 0;

/** Names that the procedure has. */
const known = computed(() => new Set(procedure.value.parameters.map(({ name }) => name)));
export const locked = computed(() => only(asked.value.locked));
export const vary = computed(() => asked.value.vary.filter((name) => known.value.has(name)));

const only = (values: Values): Values =>
  Object.fromEntries(Object.entries(values).filter(([name]) => known.value.has(name)));

export function change(part: Partial<Asked>): void {
  asked.value = { ...asked.value, ...part };
  sessionStorage.setItem(KEPT, JSON.stringify(asked.value));
}

export function reroll(): void {
  seeds.value = [...seeds.value, asked.value.seed].slice(-50);
  change({ seed: Math.floor(Math.random() * SEEDS), vary: [] });
}

export function rollBack(): void {
  const before = seeds.value.at(-1);
  if (before === undefined) return;
  seeds.value = seeds.value.slice(0, -1);
  change({ seed: before });
}

export function lock(name: string, value: Value | null): void {
  const { [name]: _, ...others } = asked.value.locked;
  change({
    locked: value === null ? others : { ...others, [name]: value },
    vary: asked.value.vary.filter((one) => value === null || one !== name),
  });
}

/** Two at most: a third one takes the place of the first. */
export function switchVary(name: string): void {
  const others = vary.value.filter((one) => one !== name);
  const { [name]: _, ...still } = asked.value.locked;
  change({ vary: vary.value.includes(name) ? others : [...others, name].slice(-2), locked: still });
}

/** Ask for the shapes, and again whenever something changes, until the returned function is called. */
export function startExploring(): () => void {
  const deaf = onExplored((message) => {
    if (message.id !== number) return;
    if (message.type === "exploring") {
      [planned.value, along.value, problem.value] = [message.shapes, message.along, message.problem];
      shapes.value = new Map();
      answered.value = message.id;
    } else {
      shapes.value = new Map(shapes.value).set(message.index, message);
      if (message.given_up) problem.value = message.problem;
    }
  });
  const quiet = effect(() => {
    const { digest, state } = procedure.value;
    if (!connected.value || bench.value !== "ready" || state !== "good" || !digest) return;
    const { seed, base } = asked.value;
    number = explore({ seed, count: COUNT, locked: locked.value, vary: vary.value, base });
  });
  return () => {
    deaf();
    quiet();
  };
}

/** What is wrong with a mesh, in words; empty where nothing is. */
export function faults(one: Soundness): string[] {
  const counted = (count: number, what: string) => (count ? [`${count} ${what}${count === 1 ? "" : "s"}`] : []);
  return [
    ...(one.closed ? [] : ["not watertight"]),
    ...(one.manifold ? [] : ["not manifold"]),
    ...(one.oriented ? [] : ["faces wound the wrong way"]),
    ...counted(one.self_intersections, "self-intersection"),
    ...counted(one.slivers, "sliver"),
  ];
}

function kept(): Partial<Asked> {
  try {
    return JSON.parse(sessionStorage.getItem(KEPT) ?? "{}") as Partial<Asked>;
  } catch {
    return {};
  }
}
