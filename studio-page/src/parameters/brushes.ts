/** Bins of parameters, and those that are brushed: references in all of them are selected in the collection. */

import { computed, effect, signal } from "@preact/signals";
import { select } from "../curating/selection";
import { procedure } from "../state/studio";
import { significant } from "../ui/numbers";
import type { Parameter, ParameterRow, Slug, Value } from "../wire/messages";
import { table } from "./table";

const BINS = 20;
/** Share of its Range within which a number rests on an end, as in the inspector. */
const RESTS = 0.02;

export interface Bin {
  label: string;
  holds: (value: Value) => boolean;
}

export interface Spread {
  parameter: Parameter;
  bins: Bin[];
  /** References in each bin where the parameter matters; where it does not; at the lower and at the upper end. */
  members: Slug[][];
  idle: number;
  pressed: [number, number];
}

export const spreads = computed(() => procedure.value.parameters.map((one) => spread(one, table.value.rows)));

/** By name of the parameter, the numbers of bins. */
export const brushes = signal<Record<string, readonly number[]>>({});
export const brushing = computed(() => Object.values(brushes.value).some((bins) => bins.length > 0));

export const brushed = computed((): ReadonlySet<Slug> => {
  let left: Slug[] | null = null;
  for (const { parameter, members } of spreads.value) {
    const bins = brushes.value[parameter.name];
    if (!bins?.length) continue;
    const here: Set<Slug> = new Set(bins.flatMap((bin) => members[bin] ?? []));
    left = left === null ? [...here] : left.filter((slug) => here.has(slug));
  }
  return new Set(left ?? []);
});

let followed = false;
/** What is brushed is selected, as long as the view is open. */
export function followBrushes(): () => void {
  return effect(() => {
    if (brushing.value) select(brushed.value);
    else if (followed) select([]);
    followed = brushing.value;
  });
}

export function brush(name: string, bins: readonly number[]): void {
  brushes.value = { ...brushes.value, [name]: bins };
}

export function toggleBin(name: string, bin: number): void {
  const now = brushes.value[name] ?? [];
  brush(name, now.includes(bin) ? now.filter((one) => one !== bin) : [...now, bin]);
}

/** Where a value lies between the ends of its parameter, 0 to 1. */
export function share({ kind, low, high, options }: Parameter, value: Value): number {
  if (kind === "binary") return value ? 1 : 0;
  if (kind === "choice") return (options ?? []).indexOf(value) / Math.max(1, (options?.length ?? 1) - 1);
  return (Number(value) - (low ?? 0)) / ((high ?? 1) - (low ?? 0) || 1);
}

function spread(parameter: Parameter, rows: ParameterRow[]): Spread {
  const bins = binsOf(parameter);
  const members: Slug[][] = bins.map(() => []);
  let idle = 0;
  const pressed: [number, number] = [0, 0];
  for (const { slug, parameters, active } of rows) {
    const value = parameters[parameter.name];
    if (value === undefined) continue;
    if (!active.includes(parameter.name)) {
      idle += 1;
      continue;
    }
    members[bins.findIndex(({ holds }) => holds(value))]?.push(slug);
    if (parameter.kind === "scalar") {
      const at = share(parameter, value);
      if (at <= RESTS) pressed[0] += 1;
      else if (at >= 1 - RESTS) pressed[1] += 1;
    }
  }
  return { parameter, bins, members, idle, pressed };
}

function binsOf(parameter: Parameter): Bin[] {
  const { kind, options } = parameter;
  const [low, high] = [parameter.low ?? 0, parameter.high ?? 1];
  if (kind === "binary" || kind === "choice") {
    const values: Value[] = kind === "binary" ? [false, true] : (options ?? []);
    return values.map((one) => ({ label: kind === "binary" ? (one ? "yes" : "no") : String(one), holds: (value) => value === one })); // prettier-ignore
  }
  if (kind === "integer" && high - low < BINS) {
    return Array.from({ length: high - low + 1 }, (_, i) => ({ label: `${low + i}`, holds: (value) => value === low + i })); // prettier-ignore
  }
  return Array.from({ length: BINS }, (_, i) => {
    const [from, to] = [i, i + 1].map((at) => low + (at / BINS) * (high - low)) as [number, number];
    const [first, last] = [i === 0, i === BINS - 1];
    return {
      label: `${significant(from, 3)} to ${significant(to, 3)}`,
      holds: (value: Value) => (first || Number(value) >= from) && (last || Number(value) < to),
    };
  });
}
