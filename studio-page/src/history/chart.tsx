/** Compatible references by iteration, as bars that choose what is compared. */

import { moment, plural } from "../ui/numbers";
import type { Run } from "../wire/messages";

const HEIGHT = 132;

export function Chart(props: {
  runs: Run[];
  before: string;
  after: string;
  onPick: (run: string, before: boolean) => void;
}) {
  const most = Math.max(1, ...props.runs.map(({ references }) => references));
  return (
    <ol class="chart">
      {props.runs.map((run) => {
        const role = run.run === props.after ? "after" : run.run === props.before ? "before" : "";
        return (
          <li key={run.run} class={role}>
            <button
              type="button"
              title={`${moment(run.created)}: ${run.compatible} of ${plural(run.references, "reference")}, ${plural(run.groups, "group")}. Shift and click to compare from here.`}
              aria-pressed={role !== ""}
              onClick={(event) => props.onPick(run.run, event.shiftKey)}
            >
              <span class="count">{run.compatible}</span>
              <i class="all" style={{ height: `${(run.references / most) * HEIGHT}px` }}>
                <i class="compatible" style={{ height: `${(100 * run.compatible) / Math.max(1, run.references)}%` }} />
              </i>
              <span class="run">{run.run}</span>
              <small>{role || (run.current ? "shown" : "\u00a0")}</small>
            </button>
          </li>
        );
      })}
    </ol>
  );
}
