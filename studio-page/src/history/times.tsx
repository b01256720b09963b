/** Where the time of a run went, and what it was fitted with. */

import { signal, useSignalEffect } from "@preact/signals";
import { runs } from "../state/studio";
import { duration, shown, words } from "../ui/numbers";
import type { RunDetail, Value } from "../wire/messages";
import { requests } from "../wire/requests";

/** The run that the history looks at. */
export const watched = signal("");

const TOLD = ["samples", "epochs", "refine", "rounds", "facing", "judge", "seed"];

const detail = signal<RunDetail | null>(null);

/** The procedure of the run: while there is no other to compare it with. */
export function RunSource() {
  const found = detail.value;
  if (!found?.source) return null;
  return (
    <section class="run-source">
      <h2>The procedure of run {found.run.run}</h2>
      <pre tabIndex={0} aria-label={`The procedure of run ${found.run.run}`}>
        <code>{found.source}</code>
      </pre>
    </section>
  );
}

export function RunTimes() {
  useSignalEffect(() => {
    const run = watched.value;
    if (runs.value.some((one) => one.run === run))
      void requests.run(run).then(
        (found) => watched.peek() === run && (detail.value = found),
        () => (detail.value = null),
      );
    else detail.value = null;
  });
  const found = detail.value;
  if (!found) return null;
  const stages = Object.entries(found.seconds);
  const longest = Math.max(...stages.map(([, seconds]) => seconds), 0.01);
  const settings = TOLD.flatMap((name) =>
    found.settings[name] === undefined ? [] : [[name, found.settings[name]] as const],
  );
  return (
    <section class="run-times">
      <h2>Where the time of run {found.run.run} went</h2>
      <ul>
        {stages.map(([stage, seconds]) => (
          <li key={stage}>
            <span>{stage}</span>
            <i style={{ width: `${((100 * seconds) / longest).toFixed(1)}%` }} />
            <span class="soft">{duration(seconds)}</span>
          </li>
        ))}
      </ul>
      <p class="soft">{settings.map(([name, value]) => `${words(name)} ${shown(value as Value)}`).join(" · ")}</p>
    </section>
  );
}
