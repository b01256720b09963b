/** The references that are selected: what is said is said of all of them. */

import { computed, signal } from "@preact/signals";
import { tiles } from "../state/studio";
import type { Slug } from "../wire/messages";

/** It does not follow the collection: thousands of tiles ask it, and each of them with every change of any tile. */
export const selected = signal<ReadonlySet<Slug>>(new Set());
let last: Slug | null = null;

/** Those that are there. */
export const selection = computed((): Slug[] => [...selected.value].filter((slug) => tiles.value.has(slug)));

export function select(slugs: Iterable<Slug>): void {
  selected.value = new Set(slugs);
}

export function toggle(slug: Slug): void {
  const next = new Set(selected.value);
  if (!next.delete(slug)) next.add(slug);
  last = slug;
  selected.value = next;
}

/** All from the one that was chosen last to this one, in an order. */
export function extend(slug: Slug, order: readonly Slug[]): void {
  const [a, b] = [order.indexOf(last ?? slug), order.indexOf(slug)].sort((x, y) => x - y) as [number, number];
  selected.value = new Set([...selected.value, ...order.slice(Math.max(a, 0), b + 1)]);
  last = slug;
}
