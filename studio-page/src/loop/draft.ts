/** What is typed and not saved, kept in the browser, so that it survives a reload, a crash and a closed tab. */

import { project } from "../state/studio";
import type { Source } from "../wire/messages";

export interface Draft {
  /** The text that the edit began from. */
  base: Source;
  text: string;
}

const place = (file: string) => `shapewright.draft ${project.peek().folder}/${file || project.peek().procedure}`;

export function keptDraft(file: string): Draft | null {
  try {
    return JSON.parse(localStorage.getItem(place(file)) ?? "null") as Draft | null;
  } catch {
    return null;
  }
}

/** Whether it could be kept. */
export function keepDraft(file: string, draft: Draft): boolean {
  try {
    localStorage.setItem(place(file), JSON.stringify(draft));
    return true;
  } catch {
    return false;
  }
}

export function dropDraft(file: string): void {
  localStorage.removeItem(place(file));
}
