/** The procedure's text in the page: what is on disk, what the author has typed, and how the two meet. */

import { computed, effect, signal } from "@preact/signals";
import { complain, tell } from "../state/notices";
import { go } from "../state/route";
import { procedure, ready } from "../state/studio";
import type { Source } from "../wire/messages";
import { RequestError, requests } from "../wire/requests";

/** The text that the edit began from. */
export const base = signal<Source | null>(null);
export const text = signal("");
export const dirty = computed(() => base.value !== null && text.value !== base.value.text);
/** What another program has written meanwhile, while there are edits here. */
export const theirs = signal<Source | null>(null);
/** Where the editor should put its cursor next: a line, counted from 1. */
export const goal = signal<number | null>(null);

let started = false;

/** Read the file now and whenever it changes. */
export function startEditing(): void {
  if (started) return;
  started = true;
  effect(() => {
    const { digest } = procedure.value;
    if (ready.value && digest !== base.peek()?.digest) void read();
  });
}

async function read(): Promise<void> {
  try {
    const source = await requests.source();
    if (source.digest === base.value?.digest) return;
    if (dirty.value && source.text !== text.value) theirs.value = source;
    else take(source);
  } catch (error) {
    complain(error);
  }
}

/** Go on from this text. */
export function take(source: Source): void {
  base.value = source;
  text.value = source.text;
  theirs.value = null;
}

export async function save(over = false): Promise<void> {
  if (!base.value) return;
  const saved = text.value;
  try {
    const { digest } = await requests.saveSource(saved, over ? null : base.value.digest);
    base.value = { ...base.value, text: saved, digest };
    theirs.value = null;
  } catch (error) {
    if (error instanceof RequestError && error.status === 409 && typeof error.body.text === "string") {
      theirs.value = { path: base.value.path, text: error.body.text, digest: String(error.body.digest) };
    } else complain(error);
  }
}

export function openEditorAt(line: number): void {
  goal.value = line;
}

/** Change a parameter's Range in the editor's text; the author saves it, or not. */
export async function proposeRange(name: string, low: string, high: string): Promise<void> {
  startEditing();
  if (!base.value) await read();
  const range = new RegExp(`(^[ \\t]*${name}\\s*:[^\\n]*?\\bRange\\()\\s*[^,()]+,\\s*[^,()]+`, "m");
  if (!range.test(text.value)) {
    return complain(`No Range of ${name} was found in the text; copy the line instead.`);
  }
  text.value = text.value.replace(range, (_, head: string) => `${head}${low}, ${high}`);
  goal.value = text.value.slice(0, text.value.search(range)).split("\n").length;
  go("loop");
  tell(`The Range of ${name} is changed in the editor. Save to use it.`);
}
