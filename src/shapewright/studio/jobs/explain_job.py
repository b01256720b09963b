"""The program of an explanation, beside the server: the command ``shapewright explain``, with its progress told."""

from __future__ import annotations

from pathlib import Path
from typing import Any, BinaryIO

from shapewright.progress import Progress
from shapewright.studio.jobs.fit_job import collection, fail, streams, tell
from shapewright.studio.project.listing import Origin


def explain(run: Path, origin: Origin, events: BinaryIO) -> None:
    """Explain a run and put that into its folder. origin: of the references."""
    from shapewright.feedback.explanation import explain as explain_iteration
    from shapewright.feedback.record import record_of, write
    from shapewright.runs.folder import previous_run
    from shapewright.runs.inputs import procedure_of
    from shapewright.runs.iteration import Iteration
    from shapewright.storage import cache_folder

    def listen(progress: Progress) -> None:
        told: dict[str, Any] = {name: getattr(progress, name) for name in ("stage", "done", "total", "remark")}
        tell(events, event="progress", **told)

    iteration = Iteration.load(run)
    procedure = procedure_of(run, iteration)
    found = explain_iteration(iteration, procedure, collection(origin), listen, cache_folder())
    write(run, record_of(found), previous_run(run, set(iteration.names)))


def main() -> None:
    from shapewright.procedures import ProcedureError
    from shapewright.references import CollectionError
    from shapewright.runs.folder import RunError

    request, events = streams()
    run = Path(request["run"])
    try:
        explain(run, Origin(**request["origin"]), events)
    except (ProcedureError, CollectionError, RunError, KeyError, ValueError, OSError) as error:
        fail(events, error, "explain", request["root"])
    tell(events, event="done", result={"run": run.name})


if __name__ == "__main__":
    main()
