/** Which tiles are shown, and in what order. */

import { computed, signal } from "@preact/signals";
import { collection, tiles } from "../state/studio";
import type { Slug, Tile } from "../wire/messages";
import { at } from "./focus";

export type Filter = "all" | "incompatible" | "compatible" | "limit" | "failed";
export type Sort = "groups" | "farthest" | "nearest" | "name" | "worse" | "better";

export const filter = signal<Filter>("all");
export const sort = signal<Sort>("groups");
export const search = signal("");
export const openGroups = signal<ReadonlySet<Slug>>(new Set());
export const compatibleOpen = signal(false);

export interface Section {
  kind: "group" | "loose" | "compatible" | "all";
  /** Representative first, in a group. */
  tiles: Tile[];
}

const FAR = Number.MAX_VALUE;
const far = (tile: Tile): number => tile.distance ?? FAR;
/** How much farther than in the run before; what cannot be said stands last. */
const change = (tile: Tile): number | null =>
  tile.previous === null || tile.distance === null ? null : tile.distance - tile.previous;
const byName = (a: Tile, b: Tile): number => a.name.localeCompare(b.name, undefined, { numeric: true });

const ORDERS: Record<Exclude<Sort, "groups">, (a: Tile, b: Tile) => number> = {
  farthest: (a, b) => far(b) - far(a) || byName(a, b),
  nearest: (a, b) => far(a) - far(b) || byName(a, b),
  name: byName,
  worse: (a, b) => (change(b) ?? -FAR) - (change(a) ?? -FAR) || byName(a, b),
  better: (a, b) => (change(a) ?? FAR) - (change(b) ?? FAR) || byName(a, b),
};

const PASSES: Record<Filter, (tile: Tile) => boolean> = {
  all: () => true,
  incompatible: (tile) => !tile.compatible,
  compatible: (tile) => tile.compatible,
  limit: (tile) => tile.at_limit.length > 0,
  failed: (tile) => tile.problem !== null,
};

export const counts = computed(() => {
  const all = collection.value.tiles;
  return Object.fromEntries(
    Object.entries(PASSES).map(([name, passes]) => [name, all.filter(passes).length]),
  ) as Record<Filter, number>;
});

const shown = computed(() => {
  const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
  const found = (tile: Tile) => words.every((word) => tile.name.toLowerCase().includes(word));
  return collection.value.tiles.filter((tile) => PASSES[filter.value](tile) && found(tile));
});

/** Groups of what is incompatible, then the loose ones, then the compatible; or one section in another order. */
export const sections = computed((): Section[] => {
  if (sort.value !== "groups") return [{ kind: "all", tiles: [...shown.value].sort(ORDERS[sort.value]) }];
  const left = new Map(shown.value.map((tile) => [tile.slug, tile]));
  const take = (slugs: Slug[]): Tile[] =>
    slugs.flatMap((slug) => {
      const tile = left.get(slug);
      left.delete(slug);
      return tile ? [tile] : [];
    });
  const groups = collection.value.groups.map(({ representative, members }): Section => {
    return { kind: "group", tiles: take(representative === null ? members : [representative, ...members]) };
  });
  const rest = [...left.values()];
  const compatible = rest.filter((tile) => tile.compatible).sort(ORDERS.nearest);
  // Before the first run there is nothing to tell apart.
  const loose = rest.filter((tile) => !tile.compatible).sort(collection.value.run ? ORDERS.farthest : byName);
  return [
    ...groups,
    { kind: "loose" as const, tiles: loose },
    { kind: "compatible" as const, tiles: compatible },
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
