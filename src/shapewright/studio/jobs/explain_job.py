"""The program of an explanation, beside the server: as the command ``shapewright explain``, with reports."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from shapewright.studio.jobs import events
from shapewright.studio.jobs.fit_job import collection
from shapewright.studio.project.listing import Origin
from shapewright.studio.wire.work import JobResult


def explain(request: Mapping[str, Any], reporter: events.Reporter) -> JobResult:
    """Explain a run and put that into its folder."""
    reporter.opens(0, 2, "reads the run")
    from shapewright.feedback.explanation import explain as explain_iteration
    from shapewright.feedback.record import record_of, write
    from shapewright.runs.folder import previous_run
    from shapewright.runs.inputs import procedure_of
    from shapewright.runs.iteration import Iteration
    from shapewright.storage import cache_folder

    run, origin = Path(request["run"]), Origin(**request["origin"])
    iteration = Iteration.load(run)
    procedure = procedure_of(run, iteration)
    reporter.opens(1, 2, "reads the references")
    explanation = explain_iteration(iteration, procedure, collection(origin), reporter.progress, cache_folder())
    write(run, record_of(explanation), previous_run(run, set(iteration.names)))
    return JobResult(run=run.name)


if __name__ == "__main__":
    events.run("explain", explain, (*events.ERRORS, KeyError))
