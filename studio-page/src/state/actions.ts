/** What the author can ask for from anywhere on the page. */

import { requests } from "../wire/requests";
import type { ChosenSettings, JobKind, Mark, Slug } from "../wire/messages";
import { complain, tell } from "./notices";
import { marking, marks, settings } from "./studio";

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
  const others = marks.value.filter((one) => !((one.a === a && one.b === b) || (one.a === b && one.b === a)));
  const next: Mark[] = same === null ? others : [...others, { a, b, same }];
  requests
    .marks(next)
    .then(() => {
      const asked = marking.value.asked.filter((slug) => same === null || slug !== a);
      marking.value = { ...marking.value, marks: next, asked };
    })
    .catch(complain);
}

export async function copy(text: string, what: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    tell(`Copied ${what}.`);
  } catch {
    complain("The browser does not let this page copy; select the text instead.");
  }
}
