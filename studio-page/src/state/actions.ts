/** What the author can ask for from anywhere on the page. */

import { requests } from "../wire/requests";
import type { ChosenSettings, JobKind, Replaced, Slug } from "../wire/messages";
import { complain, tell } from "./notices";
import { settings } from "./studio";

export function fit(fresh = false): void {
  requests.fit(fresh).catch(complain);
}

export function cancel(kind: JobKind): void {
  requests.cancel(kind).catch(complain);
}

export function explain(): void {
  requests.explain().catch(complain);
}

export async function change(part: Partial<ChosenSettings>): Promise<void> {
  try {
    settings.value = await requests.settings(part);
  } catch (error) {
    complain(error);
    // What was typed is not what holds: show what holds.
    settings.value = settings.value && { ...settings.value };
  }
}

/** Mark a pair as the same or as different; null takes the mark away. */
export function mark(a: Slug, b: Slug, same: boolean | null): void {
  requests.mark({ a, b, same }).catch(complain);
}

/** Say that the procedure, or another file, was written, with the way back beside it. after: that way was gone. */
export function written(what: string, { digest, revision }: Replaced, file = "", after = () => {}): void {
  if (revision === null) return tell(`${file || "The procedure"} has this text already.`);
  const undo = () => requests.undo(revision, digest, file).then(after).catch(complain);
  tell(what, { label: "Undo", run: () => void undo() });
}

export async function copy(text: string, what: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    tell(`Copied ${what}.`);
  } catch {
    complain("The browser does not let this page copy; select the text instead.");
  }
}
