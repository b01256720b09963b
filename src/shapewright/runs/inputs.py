"""A run's procedure and references, loaded again from where the run had them."""

from __future__ import annotations

from pathlib import Path

from shapewright.procedures import Procedure, ProcedureError, load_procedure, source_digest, text_of
from shapewright.references import Collection, CollectionError
from shapewright.runs.folder import RunError
from shapewright.runs.helpers import copy_in, not_kept, unchanged, working_in
from shapewright.runs.iteration import Iteration

_SHOWN = 3
_AGAIN = "Fit again with: shapewright fit PROCEDURE REFERENCES --explain"


def procedure_of(run: Path, iteration: Iteration) -> Procedure:
    """The procedure that a run was made with: the author's file while it and what it uses are unchanged.

    After that the run's copy, which uses the files that the run keeps. Raises RunError when neither can be loaded.
    """
    name, path = iteration.procedure["name"], iteration.procedure["path"]
    there = path and Path(path).is_file() and unchanged(iteration.helpers, Path(path))
    if there and source_digest(text_of(Path(path))) == iteration.procedure["digest"]:
        return load_procedure(f"{path}:{name}")
    if lacking := iteration.procedure.get("not_kept"):
        raise RunError(f"{run}: the procedure has changed since this run, and {not_kept(lacking)}.\n{_AGAIN}")
    run = run.absolute()
    try:
        return load_procedure(f"{copy_in(run, path or '')}:{name}", working_in(run))
    except ProcedureError as error:
        raise RunError(
            f"{run}: the procedure has changed since this run, and the run's copy of its text cannot be loaded: "
            f"{error}\n{_AGAIN}"
        ) from error


def references_of(iteration: Iteration, moved_to: str | None = None) -> Collection:
    """The collection that an iteration was made with, before it was prepared.

    moved_to: where it is now, if it was moved.

    Raises RunError when it is not where it was, or lacks references of the iteration.
    """
    record = iteration.collection
    origins = [moved_to] if moved_to else record.get("origins") or [str(record["source"])]
    again = "say where it is now: shapewright explain RUN --references FOLDER"
    if not moved_to and record["source"] == "memory":
        raise RunError(
            "the references of this iteration were made in memory; give them to "
            f"shapewright.explain(iteration, procedure, references), or {again}"
        )
    try:
        kept = {} if record.get("axes") else {"up": record.get("up", "y"), "front": record.get("front")}
        kept["keep"] = record.get("keep", ())
        collection = Collection.load(origins, **kept, pictures=record.get("pictures", "drawings"))
    except CollectionError as error:
        raise RunError(f"the references cannot be loaded: {error}\nIf they were moved, {again}") from error
    lost = [name for name in iteration.names if name not in collection and name.rpartition("/")[0] not in collection]
    if lost:
        names = ", ".join(lost[:_SHOWN]) + (", ..." if len(lost) > _SHOWN else "")
        where = ", ".join(origins)
        raise RunError(
            f"{len(lost)} of its {len(iteration)} references are not in {where} any more ({names}); "
            f"put them back, or {again}"
        )
    return collection
