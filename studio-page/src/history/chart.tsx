/** References by grade and iteration, as bars that choose what is compared. */

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
              title={`${said(run)} Shift and click to compare from here.`}
              aria-pressed={role !== ""}
              onClick={(event) => props.onPick(run.run, event.shiftKey)}
            >
              <span class="count">{run.counts.replicated}</span>
              <i class="all" style={{ height: `${(run.references / most) * HEIGHT}px` }}>
                <i class="close" style={{ height: share(run, run.counts.close) }} />
                <i class="replicated" style={{ height: share(run, run.counts.replicated) }} />
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

const share = ({ references }: Run, count: number): string => `${(100 * count) / Math.max(1, references)}%`;

/** All counts of a run, in words. */
export function said({ created, references, groups, judge, counts }: Run): string {
  const { replicated, close, different, compatible } = counts;
  const all =
    judge === "fidelity"
      ? `${replicated} replicated, ${close} close, ${different} different; paper's measure: ${compatible} of ${references}`
      : `${replicated} of ${references} replicated by the paper's measure`;
  return `${moment(created)}: ${all}; ${plural(groups, "group")}.`;
}
