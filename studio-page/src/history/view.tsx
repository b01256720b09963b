/** History: how many references each iteration replicated, and any two of them side by side. */

import { useComputed, useSignal, useSignalEffect } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { ToldChanges } from "../curating/told";
import { written } from "../state/actions";
import { complain } from "../state/notices";
import { route } from "../state/route";
import { procedure, project, runs } from "../state/studio";
import { Button, Empty, Select } from "../ui/controls";
import { duration } from "../ui/numbers";
import type { Comparison, Run } from "../wire/messages";
import { requests } from "../wire/requests";
import { Chart, said } from "./chart";
import { Diff } from "./diff";
import { Moves } from "./moves";
import { OldRun } from "./old-run";
import { Revisions } from "./revisions";
import { RunSource, RunTimes, watched } from "./times";

export function HistoryView() {
  const { rest } = route.value;
  if (rest !== null) return <OldRun rest={rest} />;
  return (
    <div class="history">
      {runs.value.length ? (
        <div class="main">
          <Iterations />
        </div>
      ) : (
        <Empty title="No iteration yet">
          <p>
            Every fit is kept here, with its procedure: how many references it replicates, and what it gained and lost.
          </p>
        </Empty>
      )}
      <aside>
        <RunTimes />
        <Revisions />
        <ToldChanges />
      </aside>
    </div>
  );
}

function Iterations() {
  const picked = useSignal<{ before: string | null; after: string | null }>({ before: null, after: null });
  const pair = useComputed(() => chosen(runs.value, picked.value));
  const comparison = useSignal<Comparison | null>(null);
  useSignalEffect(() => {
    const now = pair.value;
    comparison.value = null;
    if (!now || now.before === now.after) return;
    requests
      .compare(now.before, now.after)
      .then((found) => {
        if (pair.value === now) comparison.value = found;
      })
      .catch(complain);
  });
  const { before, after } = pair.value!;
  useEffect(() => {
    watched.value = after;
  }, [after]);
  const pick = (run: string, asBefore: boolean) => {
    picked.value = asBefore ? { before: run, after } : { before: picked.value.before, after: run };
  };
  const options = runs.value.map(({ run, counts }) => ({ value: run, label: `${run} (${counts.replicated})` }));
  return (
    <>
      <section class="overview" data-overview>
        <Chart runs={runs.value} before={before} after={after} onPick={pick} />
        <div class="choice">
          <Select label="Compare" options={options} value={before} onChange={(run) => pick(run, true)} />
          <Select label="with" options={options} value={after} onChange={(run) => pick(run, false)} />
          <RunFacts run={runs.value.find(({ run }) => run === after)!} />
        </div>
      </section>
      {before === after ? (
        <>
          <p class="soft">
            {runs.value.length === 1
              ? "With the next iteration, the two can be compared here."
              : "Choose two iterations to compare."}
          </p>
          <RunSource />
        </>
      ) : comparison.value ? (
        <div class="compared">
          <Moves comparison={comparison.value} />
          <Diff lines={comparison.value.diff} />
        </div>
      ) : (
        <p class="soft">Comparing…</p>
      )}
    </>
  );
}

/** The two that were picked; by default the newest and the one before it. */
function chosen(all: Run[], picked: { before: string | null; after: string | null }) {
  const names = all.map(({ run }) => run);
  const after = picked.after && names.includes(picked.after) ? picked.after : names.at(-1);
  if (after === undefined) return null;
  const at = names.indexOf(after);
  const before = picked.before && names.includes(picked.before) ? picked.before : names[Math.max(0, at - 1)]!;
  return { before, after };
}

function RunFacts({ run }: { run: Run }) {
  const restore = async () => {
    try {
      written(
        `The procedure is that of run ${run.run} again.`,
        await requests.restore(run.run, procedure.value.digest),
      );
    } catch (error) {
      complain(error);
    }
  };
  const here = run.digest === procedure.value.digest;
  return (
    <div class="run-facts">
      <p>
        <b>Run {run.run}</b> · {duration(run.seconds)} · {said(run)}
      </p>
      <div class="row">
        <Button
          icon="reset"
          disabled={here}
          title={here ? "The procedure is this one" : `Put this run's procedure back as ${project.value.procedure}`}
          onClick={() => void restore()}
        >
          Go back to its procedure
        </Button>
        <a class="link" href={`#history/${encodeURIComponent(run.run)}`} title="All its replicas, as they were then">
          Open
        </a>
        <a class="link" href={`/api/runs/${run.run}/report.html`} target="_blank" rel="noopener">
          Report
        </a>
        <a class="link" href={`/api/runs/${run.run}/parameters.csv`} download>
          Parameters
        </a>
      </div>
    </div>
  );
}
