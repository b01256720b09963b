/** Where the time of a run went, and what it was fitted with. */

import { signal, useSignal, useSignalEffect } from "@preact/signals";
import { runs } from "../state/studio";
import { duration, shown, words } from "../ui/numbers";
import type { RunDetail, Value } from "../wire/messages";
import { requests } from "../wire/requests";

/** The run that the history looks at. */
export const watched = signal("");

const TOLD = ["samples", "epochs", "refine", "rounds", "facing", "judge", "seed"];

export function RunTimes() {
  const detail = useSignal<RunDetail | null>(null);
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
