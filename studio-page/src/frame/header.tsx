/** The bar at the top: where one is, how the loop stands, and what can be done from anywhere. */

import { dirty } from "../loop/editing";
import { cancel, fit } from "../state/actions";
import { work } from "../state/clock";
import { MODIFIER } from "../state/keys";
import { go, route, VIEWS } from "../state/route";
import { bench, collection, connected, fitting, jobs, lost, procedure, project } from "../state/studio";
import { switchTheme, theme } from "../state/theme";
import { Button } from "../ui/controls";
import { duration } from "../ui/numbers";
import { ExportMenu } from "./exporting";
import { asking } from "../palette/palette";
import { helping } from "./help";
import { Working } from "./progress";

const LABELS = { collection: "Collection", loop: "Loop", history: "History", feedback: "Feedback", explore: "Explore", parameters: "Parameters" } as const; // prettier-ignore
export function Header() {
  return (
    <header class="header">
      <h1 title={project.value.folder}>
        <Mark />
        <span>{project.value.name}</span>
      </h1>
      <nav aria-label="Views">
        {VIEWS.map((view, i) => (
          <a
            key={view}
            href={`#${view}`}
            aria-current={route.value.view === view ? "page" : undefined}
            title={`${LABELS[view]} (${i + 1})`}
            onClick={() => go(view)}
          >
            {LABELS[view]}
            {view === "loop" && dirty.value && <i class="unsaved" title="There is text that is not saved" />}
          </a>
        ))}
      </nav>
      <Status />
      <FitButton />
      <ExportMenu />
      <Button
        kind="quiet"
        icon={theme.value === "dark" ? "sun" : "moon"}
        title={`Switch to ${theme.value === "dark" ? "light" : "dark"} colours`}
        onClick={switchTheme}
      />
      <Button kind="quiet" icon="search" title={`Commands (${MODIFIER}K)`} onClick={() => (asking.value = true)} />
      <Button kind="quiet" icon="help" title="Keys (?)" onClick={() => (helping.value = true)} />
    </header>
  );
}

function Mark() {
  return (
    <svg class="mark" viewBox="0 0 32 32" aria-label="shapewright">
      <path d="M6 11.5 16 6.500l10 5-10 5z" />
      <path d="M9 14v9.500M16 17.500V27M23 14v9.5" />
    </svg>
  );
}

/** One line on what is going on. */
export function Status() {
  const job = jobs.fit.value;
  if (!connected.value) {
    return (
      <p class="status bad" title={lost.value}>
        {lost.value}
      </p>
    );
  }
  if (work.value.length) return <Working />;
  if (bench.value !== "ready") {
    return <p class="status busy">{bench.value === "starting" ? "Starting…" : "The bench restarts…"}</p>;
  }
  if (procedure.value.state === "broken") return <p class="status bad">procedure broken</p>;
  if (procedure.value.stale) return <p class="status warn">not fitted since the last edit</p>;
  if (job.state === "failed") return <p class="status bad">fit failed</p>;
  const { run } = collection.value;
  if (job.state === "done" && job.result?.run === run)
    return <p class="status soft">fitted in {duration(job.seconds)}</p>;
  // What was cancelled is over; what is shown counts.
  return <p class="status soft">{run === null ? "" : `run ${run}`}</p>;
}

function FitButton() {
  if (fitting.value) {
    const cancelling = jobs.fit.value.state === "cancelling";
    return (
      <Button icon="stop" class="fit" disabled={cancelling} title="Stop this fit" onClick={() => cancel("fit")}>
        Cancel
      </Button>
    );
  }
  return (
    <Button
      icon="play"
      kind="primary"
      class="fit"
      disabled={procedure.value.state === "broken" || collection.value.count === 0}
      title={
        procedure.value.state === "broken"
          ? "The procedure is broken"
          : `Find parameters for every reference (${MODIFIER}Enter)`
      }
      onClick={() => fit()}
    >
      Fit
    </Button>
  );
}
