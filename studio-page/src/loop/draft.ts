/** What is typed and not saved, kept in the browser, so that it survives a reload, a crash and a closed tab. */

import { project } from "../state/studio";
import type { Source } from "../wire/messages";

export interface Draft {
  /** The text that the edit began from. */
  base: Source;
  text: string;
}

const place = () => `shapewright.draft ${project.peek().folder}/${project.peek().procedure}`;

export function keptDraft(): Draft | null {
  try {
    return JSON.parse(localStorage.getItem(place()) ?? "null") as Draft | null;
  } catch {
    return null;
  }
}

/** Whether it could be kept. */
export function keepDraft(draft: Draft): boolean {
  try {
    localStorage.setItem(place(), JSON.stringify(draft));
    return true;
  } catch {
    return false;
  }
}

export function dropDraft(): void {
  localStorage.removeItem(place());
}
