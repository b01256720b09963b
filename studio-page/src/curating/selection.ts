/** The references that are selected: what is said is said of all of them. */

import { computed, signal } from "@preact/signals";
import { tiles } from "../state/studio";
import type { Slug } from "../wire/messages";

const chosen = signal<ReadonlySet<Slug>>(new Set());
let last: Slug | null = null;

/** Those of the chosen ones that are there. */
export const selected = computed((): ReadonlySet<Slug> => {
  const there = [...chosen.value].filter((slug) => tiles.value.has(slug));
  return there.length === chosen.value.size ? chosen.value : new Set(there);
});

export function select(slugs: Iterable<Slug>): void {
  chosen.value = new Set(slugs);
}

export function toggle(slug: Slug): void {
  const next = new Set(selected.value);
  if (!next.delete(slug)) next.add(slug);
  last = slug;
  chosen.value = next;
}

/** All from the one that was chosen last to this one, in an order. */
export function extend(slug: Slug, order: readonly Slug[]): void {
  const [a, b] = [order.indexOf(last ?? slug), order.indexOf(slug)].sort((x, y) => x - y) as [number, number];
  chosen.value = new Set([...selected.value, ...order.slice(Math.max(a, 0), b + 1)]);
  last = slug;
}
