"""The program of an explanation, beside the server: the command ``shapewright explain``, with its progress told."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, TextIO

from shapewright.progress import Progress
from shapewright.studio.fitting import collection, streams, tell
from shapewright.studio.listing import Origin


def explain(run: Path, origin: Origin, events: TextIO) -> None:
    """Explain a run and put that into its folder. origin: of the references."""
    from shapewright.commands import suggestions_of
    from shapewright.feedback.again import procedure_of
    from shapewright.feedback.explanation import explain as explain_iteration
    from shapewright.feedback.record import write
    from shapewright.iteration import Iteration
    from shapewright.workspace import cache_folder, previous_run

    def listen(progress: Progress) -> None:
        told: dict[str, Any] = {name: getattr(progress, name) for name in ("stage", "done", "total", "remark")}
        tell(events, event="progress", **told)

    iteration = Iteration.load(run)
    procedure = procedure_of(run, iteration)
    found = explain_iteration(procedure, collection(origin), iteration, listen, cache_folder(), suggestions_of)
    write(run, found.record, previous_run(run, set(iteration.names)))


def main() -> None:
    from shapewright.procedure import ProcedureError
    from shapewright.references import CollectionError
    from shapewright.workspace import RunError

    request, events = streams()
    run = Path(request["run"])
    try:
        explain(run, Origin(**request["origin"]), events)
    except (ProcedureError, CollectionError, RunError, KeyError, ValueError, OSError) as error:
        tell(events, event="failed", kind="explain", message=str(error))
        sys.exit(1)
    tell(events, event="done", result={"run": run.name})


if __name__ == "__main__":
    main()
