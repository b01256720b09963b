/** The lines that were printed last. */

import { computed, signal } from "@preact/signals";
import type { Line } from "../wire/messages";

const MOST = 1000;
const all = signal<readonly Line[]>([]);
/** The number of the last line that the author has cleared away. */
const cleared = signal(0);

export const printed = computed(() => all.value.filter(({ number }) => number > cleared.value));

/** Those that are there already are passed over; another start of the studio counts from one again. */
export function take(lines: readonly Line[], fresh: boolean): void {
  if (fresh && (lines.at(-1)?.number ?? 0) < cleared.value) cleared.value = 0;
  const known = fresh ? [] : all.value;
  const last = known.at(-1)?.number ?? 0;
  all.value = [...known, ...lines.filter(({ number }) => number > last)].slice(-MOST);
}

export function emptyConsole(): void {
  cleared.value = all.value.at(-1)?.number ?? 0;
}
