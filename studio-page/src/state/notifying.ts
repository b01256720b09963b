/** A note of the browser at the end of long work, where the author wishes it: for who looks elsewhere meanwhile. */

import { effect, signal } from "@preact/signals";
import type { Job, JobKind } from "../wire/messages";
import { complain } from "./notices";
import { collection, jobs, project } from "./studio";

const KEPT = "shapewright.notify";
const there = "Notification" in window;

export const notifying = signal(there && localStorage.getItem(KEPT) === "on" && Notification.permission === "granted");

/** The browser asks once; what it was told holds. */
export async function switchNotifying(on: boolean): Promise<void> {
  if (on && !there) return complain("This browser shows no notes.");
  const granted =
    on && (Notification.permission === "granted" || (await Notification.requestPermission()) === "granted");
  if (on && !granted) complain("The browser does not let this page show notes: its settings for this page say so.");
  notifying.value = granted;
  localStorage.setItem(KEPT, granted ? "on" : "off");
}

const WHAT: Record<JobKind, string> = { fit: "The fit", explain: "The explanation", export: "The export" };
const before: Record<JobKind, Job["state"]> = { fit: "idle", explain: "idle", export: "idle" };

for (const kind of Object.keys(before) as JobKind[]) {
  effect(() => {
    const job = jobs[kind].value;
    const ran = before[kind] === "running";
    before[kind] = job.state;
    if (ran && (job.state === "done" || job.state === "failed") && notifying.peek()) note(kind, job);
  });
}

/** Also where this page is looked at: the author may look at another window. */
function note(kind: JobKind, job: Job): void {
  const { counts, count } = collection.peek();
  const fitted = kind === "fit" ? `${counts.replicated} of ${count} replicated` : "";
  const body = job.state === "failed" ? (job.problem?.message ?? "") : fitted;
  const shown = new Notification(
    `${WHAT[kind]} ${job.state === "done" ? "is done" : "failed"}: ${project.peek().name}`,
    {
      body,
      tag: `shapewright ${kind}`,
    },
  );
  shown.onclick = () => window.focus();
}
