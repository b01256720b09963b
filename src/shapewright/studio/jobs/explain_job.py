"""The program of an explanation, beside the server: as the command ``shapewright explain``, with reports."""

from __future__ import annotations

from pathlib import Path

from shapewright.studio.jobs.events import Reporter, begin
from shapewright.studio.jobs.fit_job import collection
from shapewright.studio.project.listing import Origin


def explain(run: Path, origin: Origin, reporter: Reporter) -> None:
    """Explain a run and put that into its folder.

    origin: of the references.
    """
    from shapewright.feedback.explanation import explain as explain_iteration
    from shapewright.feedback.record import record_of, write
    from shapewright.runs.folder import previous_run
    from shapewright.runs.inputs import procedure_of
    from shapewright.runs.iteration import Iteration
    from shapewright.storage import cache_folder

    iteration = Iteration.load(run)
    procedure = procedure_of(run, iteration)
    explanation = explain_iteration(iteration, procedure, collection(origin), reporter.progress, cache_folder())
    write(run, record_of(explanation), previous_run(run, set(iteration.names)))


def main() -> None:
    from shapewright.procedures import ProcedureError
    from shapewright.references import CollectionError
    from shapewright.runs.folder import RunError

    request, reporter = begin()
    run = Path(request["run"])
    try:
        explain(run, Origin(**request["origin"]), reporter)
    except (ProcedureError, CollectionError, RunError, KeyError, ValueError, OSError) as error:
        reporter.fail(error, "explain", request["root"])
    reporter.done(run=run.name)


if __name__ == "__main__":
    main()
