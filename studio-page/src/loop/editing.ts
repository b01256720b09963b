/** A text file in the page, mostly the procedure: what is on disk, what the author has typed, and how the two meet. */

import { batch, computed, effect, signal } from "@preact/signals";
import { complain, tell } from "../state/notices";
import { go } from "../state/route";
import { procedure, project, ready } from "../state/studio";
import type { Source } from "../wire/messages";
import { RequestError, requests } from "../wire/requests";
import { dropDraft, keepDraft, keptDraft } from "./draft";

/** The name of the file that is open; empty for the procedure. */
export const file = signal("");
/** Names of all that can be opened, the procedure first. */
export const files = signal<string[]>([]);
/** The text that the edit began from. */
export const base = signal<Source | null>(null);
export const text = signal("");
export const dirty = computed(() => base.value !== null && text.value !== base.value.text);
/** What another program has written meanwhile, while there are edits here. */
export const theirs = signal<Source | null>(null);
/** Why the file cannot be read, as where it was deleted; the text here is then all that there is. */
export const gone = signal("");
/** Where the editor should put its cursor next: a line, counted from 1. */
export const goal = signal<number | null>(null);

let started = false;

/** Read the file now and whenever it changes. */
export function startEditing(): void {
  if (started) return;
  started = true;
  effect(() => {
    const { digest, state } = procedure.value;
    if (!ready.value) return;
    list();
    // Another program may have written any of them.
    if (file.peek() || digest !== base.peek()?.digest || state === "broken" || gone.peek()) void read();
  });
  const kept = new Set<string>();
  effect(() => {
    if (!base.value) return;
    const name = file.peek();
    if (dirty.value || gone.value) {
      if (!keepDraft(name, { base: base.value, text: text.value }) && !kept.has(name))
        complain("The browser keeps no unsaved text: save before you close this page.");
      kept.add(name);
      // Only who kept it drops it: another tab may have typed it.
    } else if (kept.delete(name)) dropDraft(name);
  });
}

function list(): void {
  requests.texts().then((found) => (files.value = found), complain);
}

/** Open another file; what was typed into the one before is kept, and is there when one comes back. */
export async function openFile(name: string): Promise<void> {
  const next = name === project.peek().procedure ? "" : name;
  if (next === file.peek()) return;
  batch(() => {
    file.value = next;
    [base.value, theirs.value, text.value, gone.value] = [null, null, "", ""];
  });
  await read();
}

/** Look at the file as it is now. */
export async function read(): Promise<void> {
  const name = file.peek();
  try {
    const source = await requests.source(name);
    if (name !== file.peek()) return;
    gone.value = source.unreadable ?? "";
    if (!base.value) restore(source);
    if (source.unreadable !== null || source.digest === base.value?.digest) return;
    if (dirty.value && source.text !== text.value) theirs.value = source;
    else take(source);
  } catch (error) {
    complain(error);
  }
}

/** Go on from what was typed before this page was loaded, where there is something. */
function restore(source: Source): void {
  const draft = keptDraft(file.peek());
  if (draft && (source.unreadable !== null || draft.text !== source.text)) {
    take(draft.base, draft.text);
    tell("What you typed and did not save is in the editor.", { label: "Open", run: () => go("loop") });
  } else if (source.unreadable === null) take(source);
}

/** Go on from this text. typed: what was made of it already. */
export function take(source: Source, typed = source.text): void {
  batch(() => {
    base.value = source;
    text.value = typed;
    theirs.value = null;
  });
}

/** Give up what was typed for another text; it can be had back. */
export function giveUp(source: Source): void {
  const [was, typed] = [base.value ?? source, text.value];
  take(source);
  tell("What you typed is given up.", {
    label: "Undo",
    run: () => {
      take(was, typed);
      if (source.digest !== was.digest) theirs.value = source;
    },
  });
}

/** Put what was typed into a new file beside the procedure. */
export async function saveAsNew(): Promise<void> {
  try {
    const { path } = await requests.saveCopy(text.value);
    tell(`Written to ${path}.`);
    if (theirs.value) take(theirs.value);
  } catch (error) {
    complain(error);
  }
}

export async function save(over = false): Promise<void> {
  if (!base.value) return;
  const [name, saved] = [file.value, text.value];
  try {
    const { digest } = await requests.saveSource(name, saved, over ? null : base.value.digest);
    if (name !== file.value) return;
    take({ ...base.value, text: saved, digest }, text.value);
    list();
    gone.value = "";
  } catch (error) {
    if (error instanceof RequestError && error.status === 409 && typeof error.body.text === "string") {
      theirs.value = { ...base.value, text: error.body.text, digest: String(error.body.digest) };
    } else if (error instanceof RequestError && error.status === 409) gone.value = error.message;
    else complain(error);
  }
}

/** name: of the file, where it is one that can be opened. */
export function openEditorAt(line: number, name: string): void {
  void openFile(files.value.includes(name) ? name : "").then(() => (goal.value = line));
}

/** Change a parameter's Range in the editor's text; the author saves it, or not. */
export async function proposeRange(name: string, low: string, high: string): Promise<void> {
  startEditing();
  await openFile("");
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
