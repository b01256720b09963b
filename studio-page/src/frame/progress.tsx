/** What is under way, how far it is, and how long it takes still: one line and one bar, in every view. */

import { work } from "../state/clock";
import type { Work } from "../state/clock";
import { notifying, switchNotifying } from "../state/notifying";
import { jobs } from "../state/studio";
import { Button } from "../ui/controls";
import { duration } from "../ui/numbers";
import type { Answer } from "../wire/messages";

const WHAT: Record<Work["what"], string> = {
  fit: "fit",
  explain: "explain",
  export: "export",
  sweep: "new replicas",
};
const ANSWERS: Record<Answer, string> = {
  "carried over": "parameters carried over",
  "most similar samples": "first guesses shown",
  predicted: "predictions shown",
};

/** Null while nothing runs. */
export function Working() {
  const [first, ...others] = work.value;
  if (!first) return null;
  const { what, stage, steps, remark, cancelling, elapsed, left } = first;
  const answer = what === "fit" ? jobs.fit.value.answer : null;
  return (
    <div class="status busy" data-working={what}>
      <p>
        <span class="soft">{WHAT[what]}: </span>
        <span role="status">
          <b>{cancelling ? "cancelling" : stage}</b>
        </span>
        {steps && ` ${steps.done}/${steps.total}`}
        <span aria-hidden="true">
          {!cancelling && left !== null && <span data-left> · {leftSaid(left)}</span>}
          <span class="soft" title="Since it began">
            {" "}
            · {duration(elapsed)}
          </span>
        </span>
        {stage === "open" && remark && <span class="soft"> · {remark}</span>}
        {answer && <span class="soft"> · {ANSWERS[answer] ?? answer}</span>}
        {others.length > 0 && <span class="soft"> · also {others.map(({ what }) => WHAT[what]).join(", ")}</span>}
      </p>
      <Button
        kind="quiet"
        icon={notifying.value ? "bell" : "bell-off"}
        pressed={notifying.value}
        title="A note of the browser when it is done"
        onClick={() => void switchNotifying(!notifying.value)}
      />
    </div>
  );
}

/** In steps that one can read: it is an estimate. */
function leftSaid(left: number): string {
  if (left < 2) return "nearly done";
  if (left < 10) return `about ${Math.ceil(left)} s left`;
  if (left < 90) return `about ${5 * Math.ceil(left / 5)} s left`;
  return `about ${Math.ceil(left / 60)} min left`;
}

/** How far all of it is, as a line under the header. */
export function ProgressLine() {
  const first = work.value[0];
  if (!first) return <div class="progress-line" />;
  const percent = Math.min(100, 100 * first.share);
  return (
    <section class="progress-line" aria-label="Progress">
      <div
        role="progressbar"
        aria-label={WHAT[first.what]}
        aria-valuemin={0}
        aria-valuemax={100}
        aria-valuenow={Math.round(percent)}
      >
        <i style={{ width: `${percent.toFixed(1)}%` }} />
      </div>
    </section>
  );
}
