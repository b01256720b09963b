/** What the author says of several references; each can be undone at once, and later from the list in History. */

import { signal } from "@preact/signals";
import { complain, tell } from "../state/notices";
import { noted, tileOf } from "../state/studio";
import { plural } from "../ui/numbers";
import type { Noted, NoteOrder, Slug, Told, ToldAnswer, Turn } from "../wire/messages";
import { requests } from "../wire/requests";

/** Raised by each change, so that the list of them is read again. */
export const changes = signal(0);
export const NOTHING: Noted = { tags: [], note: "", not_mine: false };
export const notedOf = (slug: Slug): Noted => noted.value[slug] ?? NOTHING;

export function note(slugs: Slug[], what: Omit<NoteOrder, "slugs">, said: string | null): void {
  void done(requests.note({ slugs, ...what }), said && `${said}: ${named(slugs)}.`);
}

export function turn(slugs: Slug[], how: Turn): void {
  void done(requests.turn(slugs, how), `Turned: ${named(slugs)}. The next fit reads it so.`);
}

export function measureIn(slugs: Slug[], unit: Told["unit"]): void {
  void done(
    requests.unit(slugs, unit),
    `${unit ? `Lengths in ${unit}` : "Lengths as the file says"}: ${named(slugs)}.`,
  );
}

export function undo(number: number): void {
  void done(requests.undoTold(number), "Taken back.");
}

const named = (slugs: Slug[]): string =>
  slugs.length === 1 ? (tileOf(slugs[0]!)?.name ?? slugs[0]!) : plural(slugs.length, "reference");

async function done(asked: Promise<ToldAnswer>, said: string | null): Promise<void> {
  try {
    const { number } = await asked;
    changes.value += 1;
    if (said && number !== null) tell(said, { label: "Undo", run: () => undo(number) });
  } catch (error) {
    complain(error);
  }
}
