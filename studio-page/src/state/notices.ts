/** Short messages at the foot of the page, which go away by themselves. */

import { signal } from "@preact/signals";

export interface Notice {
  id: number;
  text: string;
  bad: boolean;
  action: { label: string; run: () => void } | null;
}

export const notices = signal<Notice[]>([]);
let last = 0;

export function tell(text: string, action: Notice["action"] = null): void {
  show({ id: ++last, text, bad: false, action }, action ? 12_000 : 4000);
}

/** Show an error of a request, or of anything else. */
export function complain(error: unknown): void {
  show({ id: ++last, text: error instanceof Error ? error.message : String(error), bad: true, action: null }, 10_000);
}

export function dismiss(id: number): void {
  notices.value = notices.value.filter((notice) => notice.id !== id);
}

function show(notice: Notice, milliseconds: number): void {
  notices.value = [...notices.value.filter(({ text }) => text !== notice.text), notice].slice(-4);
  setTimeout(() => dismiss(notice.id), milliseconds);
}
