/** The loop: the procedure's text on one side, the fit on the other. */

import { ConsolePanel } from "../console/panel";
import { cancel, fit } from "../state/actions";
import { elapsed } from "../state/clock";
import { collection, fitting, jobs, procedure, settings } from "../state/studio";
import { Button } from "../ui/controls";
import { duration, plural } from "../ui/numbers";
import { ProblemLine } from "../frame/problems";
import { Curve } from "./curve";
import { EditorPane } from "./editor";
import { Settings } from "./settings";
import { Stages } from "./stages";

export function LoopView() {
  const job = jobs.fit.value;
  return (
    <div class="loop">
      <EditorPane />
      <div class="fit-pane">
        <section>
          <header>
            <h2>Fit</h2>
            <p class="soft grow">{summary()}</p>
            {fitting.value ? (
              <Button icon="stop" disabled={job.state === "cancelling"} onClick={() => cancel("fit")}>
                Cancel the fit
              </Button>
            ) : (
              <Button
                disabled={procedure.value.state === "broken"}
                title="Learn anew, going on from nothing"
                onClick={() => fit(true)}
              >
                Fit afresh
              </Button>
            )}
          </header>
          {job.problem && <ProblemLine problem={job.problem} />}
          <Stages />
        </section>
        <section>
          <h2>Training</h2>
          <Curve curve={job.curve} epochs={settings.value?.epochs ?? 0} />
        </section>
        <ConsolePanel />
        <section>
          <h2>Settings</h2>
          <Settings />
        </section>
      </div>
    </div>
  );
}

function summary(): string {
  const job = jobs.fit.value;
  const { run, counts, count } = collection.value;
  switch (job.state) {
    case "running":
      return `running for ${duration(elapsed("fit"))}`;
    case "cancelling":
      return "being cancelled";
    case "cancelled":
      return `cancelled after ${duration(job.seconds)}; the results before it stay`;
    case "failed":
      return "failed; the results before it stay";
    default:
      return run === null
        ? "not run yet"
        : `run ${run}: ${counts.replicated} of ${plural(count, "reference")} replicated`;
  }
}
