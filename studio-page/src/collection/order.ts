/** Which tiles are shown, and in what order. */

import { computed, signal } from "@preact/signals";
import { selected } from "../curating/selection";
import { gain, valueOf } from "../state/grades";
import { collection, duplicateOf, duplicates, leftOut, noted, tiles } from "../state/studio";
import type { Grade, Slug, Tile } from "../wire/messages";
import { at } from "./focus";

export type Filter = "all" | Grade | "turned" | "longer" | "failed" | "duplicates" | "noted" | "selected";
export type Sort = "groups" | "worst" | "best" | "name" | "worse" | "better" | "alike";

export const filter = signal<Filter>("all");
export const sort = signal<Sort>("groups");
export const search = signal("");
/** Only references with this tag; empty for all. */
export const tag = signal("");
/** How much others differ from one reference: by that they are sorted. */
export const likeness = signal<{ slug: Slug; apart: Record<Slug, number> } | null>(null);
export const openGroups = signal<ReadonlySet<Slug>>(new Set());
export const replicatedOpen = signal(false);
export const leftOutOpen = signal(false);

export interface Section {
  kind: "group" | "loose" | "replicated" | "all" | "left out";
  /** Representative first, in a group. */
  tiles: Tile[];
}

const FAR = Number.MAX_VALUE;
const value = (tile: Tile): number | null => valueOf(collection.value.judge, tile);
/** Less is better; what is not measured stands with the worst. */
const badness = (tile: Tile): number => {
  const known = value(tile);
  return known === null ? FAR : collection.value.judge === "fidelity" ? -known : known;
};
/** How much better than in the run before; what cannot be said stands last. */
const change = (tile: Tile): number | null => gain(collection.value.judge, tile.previous, value(tile));
/** The reference itself comes first, and what was not looked at last. */
const apart = ({ slug }: Tile): number => (slug === likeness.value?.slug ? -1 : (likeness.value?.apart[slug] ?? FAR));
/** One for all: to make one for each comparison is what takes the time. */
const NAMES = new Intl.Collator(undefined, { numeric: true });
const byName = (a: Tile, b: Tile): number => NAMES.compare(a.name, b.name);

const ORDERS: Record<Exclude<Sort, "groups">, (a: Tile, b: Tile) => number> = {
  worst: (a, b) => badness(b) - badness(a) || byName(a, b),
  best: (a, b) => badness(a) - badness(b) || byName(a, b),
  name: byName,
  worse: (a, b) => (change(a) ?? FAR) - (change(b) ?? FAR) || byName(a, b),
  alike: (a, b) => apart(a) - apart(b) || byName(a, b),
  better: (a, b) => (change(b) ?? -FAR) - (change(a) ?? -FAR) || byName(a, b),
};

const originals = computed(() => new Set(duplicates.value.map(({ of }) => of)));

const PASSES: Record<Filter, (tile: Tile) => boolean> = {
  all: () => true,
  replicated: (tile) => tile.grade === "replicated",
  close: (tile) => tile.grade === "close",
  different: (tile) => tile.grade === "different",
  turned: (tile) => tile.pose !== null,
  longer: (tile) => tile.longer.length > 0,
  failed: (tile) => tile.problem !== null,
  duplicates: ({ slug }) => duplicateOf.value.has(slug) || originals.value.has(slug),
  noted: ({ slug }) => noted.value[slug] !== undefined,
  selected: ({ slug }) => selected.value.has(slug),
};

export const counts = computed(() => {
  const all = collection.value.tiles.filter(({ slug }) => !leftOut.value.has(slug));
  return Object.fromEntries(
    Object.entries(PASSES).map(([name, passes]) => [name, all.filter(passes).length]),
  ) as Record<Filter, number>;
});

const shown = computed(() => {
  const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
  const told = ({ slug }: Tile) => [...(noted.value[slug]?.tags ?? []), noted.value[slug]?.note ?? ""].join(" ");
  const found = (tile: Tile) => words.every((word) => `${tile.name} ${told(tile)}`.toLowerCase().includes(word));
  const tagged = ({ slug }: Tile) => !tag.value || (noted.value[slug]?.tags.includes(tag.value) ?? false);
  return collection.value.tiles.filter((tile) => PASSES[filter.value](tile) && tagged(tile) && found(tile));
});
/** Those of them that count. */
export const shownTiles = computed(() => shown.value.filter(({ slug }) => !leftOut.value.has(slug)));
const aside = computed((): Section[] => {
  const out = shown.value.filter(({ slug }) => leftOut.value.has(slug)).sort(byName);
  return out.length ? [{ kind: "left out", tiles: out }] : [];
});

/** A group keeps its members while a fit runs; one that another cut makes replicated leaves it. */
const leaves = (tile: Tile): boolean => tile.stage === "trained" && tile.grade === "replicated";

/** Of these one wants to see each, and not groups that stand for several. */
const WHOLE: ReadonlySet<Filter> = new Set(["duplicates", "noted", "selected"]);

/** Groups of misfits, then the loose ones, then the replicated; or one section in another order. */
export const sections = computed((): Section[] => {
  if (sort.value !== "groups" || WHOLE.has(filter.value) || tag.value) {
    const order = sort.value === "groups" ? byName : ORDERS[sort.value];
    const tiles = [...shownTiles.value].sort(order);
    return [...(tiles.length ? [{ kind: "all" as const, tiles }] : []), ...aside.value];
  }
  const left = new Map(shownTiles.value.map((tile) => [tile.slug, tile]));
  const take = (slugs: Slug[]): Tile[] =>
    slugs.flatMap((slug) => {
      const tile = left.get(slug);
      if (!tile || leaves(tile)) return [];
      left.delete(slug);
      return [tile];
    });
  const groups = collection.value.groups.map(({ representative, members }): Section => {
    return { kind: "group", tiles: take(representative === null ? members : [representative, ...members]) };
  });
  const rest = [...left.values()];
  const replicated = rest.filter((tile) => tile.grade === "replicated").sort(ORDERS.best);
  // Before the first run there is nothing to tell apart.
  const loose = rest.filter((tile) => tile.grade !== "replicated").sort(collection.value.run ? ORDERS.worst : byName);
  return [
    ...groups,
    { kind: "loose" as const, tiles: loose },
    { kind: "replicated" as const, tiles: replicated },
    ...aside.value,
  ].filter((section) => section.tiles.length > 0);
});

/** All shown tiles in order, those that are folded away too: what one leafs through in the inspector. */
export const leafed = computed(() => sections.value.flatMap((section) => section.tiles.map((tile) => tile.slug)));

/** The one tile that Tab leads to. */
export const entry = computed(() =>
  at.value && leafed.value.includes(at.value) ? at.value : (leafed.value[0] ?? null),
);

export const searching = computed(() => search.value.trim() !== "");

export function toggleGroup(representative: Slug): void {
  const next = new Set(openGroups.value);
  if (!next.delete(representative)) next.add(representative);
  openGroups.value = next;
}

/** The slug so many places on from another, around the ends. */
export function neighbour(slug: Slug, step: number): Slug | null {
  const order = leafed.value.includes(slug) ? leafed.value : [...tiles.value.keys()];
  const at = order.indexOf(slug);
  return at < 0 ? null : (order[(at + step + order.length) % order.length] ?? null);
}
