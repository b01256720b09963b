/** The colours of grades: by a scale that everybody can read, or as in the paper. */

import { effect } from "@preact/signals";
import { ofDistance, ofGrade } from "./tints";
import type { Grade } from "../wire/messages";
import { collection, settings } from "./studio";

/** Thresholds from which on the server's own scale says far, too. */
const FAR = 2.5;

interface Coloured {
  grade: Grade;
  distance: number | null;
  /** As in the paper; null for what is not measured. */
  colour: string | null;
}

/** The tint of a replica; null for what is not measured. */
export function tintOf(one: Coloured | undefined): string | null {
  if (!one || one.colour === null || settings.value?.scale === "paper") return one?.colour ?? null;
  const { judge, threshold } = collection.value;
  return judge === "paper" && one.distance !== null ? ofDistance(one.distance, threshold, FAR) : ofGrade(one.grade);
}

const PAPER: Record<Grade, string> = { replicated: "var(--good)", close: "var(--warn)", different: "var(--bad)" };

/** The colour of a grade, where it stands for a replica on a map or a line. */
export const colourOfGrade = (grade: Grade): string =>
  settings.value?.scale === "paper" ? PAPER[grade] : ofGrade(grade);

effect(() => {
  document.documentElement.dataset.scale = settings.value?.scale ?? "clear";
});
