/** What the author has set by hand, with the steps that led there, to be undone and done again. */

import { signal } from "@preact/signals";
import type { Values } from "../../wire/messages";

/** null while everything is as found. */
export const edited = signal<Values | null>(null);
export const undone = signal<(Values | null)[]>([]);
export const past = signal<(Values | null)[]>([]);

/** Changes of one parameter that follow one another within this time, in ms, are one step: a slider is dragged. */
const TOGETHER = 800;
let last = { what: "", at: 0 };

/** what: is edited, a parameter or something else. */
export function edit(next: Values | null, what: string): void {
  const now = performance.now();
  if (what !== last.what || now - last.at > TOGETHER) past.value = [...past.value, edited.value];
  last = { what, at: now };
  undone.value = [];
  edited.value = next;
}

export function forgetEdits(): void {
  [past.value, undone.value, edited.value] = [[], [], null];
  last = { what: "", at: 0 };
}

/** Returns whether there was something. */
export const undoEdit = (): boolean => move(past, undone);
export const redoEdit = (): boolean => move(undone, past);

function move(from: typeof past, to: typeof past): boolean {
  const next = from.value.at(-1);
  if (next === undefined) return false;
  to.value = [...to.value, edited.value];
  from.value = from.value.slice(0, -1);
  edited.value = next;
  last = { what: "", at: 0 };
  return true;
}
