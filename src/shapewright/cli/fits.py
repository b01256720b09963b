"""The command ``shapewright fit``, and how a command fits and saves one run."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.markup import escape

from shapewright.cli.bars import interruptible
from shapewright.cli.console import err, iteration_record, print_iteration, print_json
from shapewright.cli.options import ClusterOption, Front, Json, Keep, PresetOption, ProcedureArgument, Up, with_settings
from shapewright.cli.runs import explain_saved, judged_by_marks
from shapewright.procedures import load_procedure
from shapewright.runs.folder import (
    RunError,
    check_free,
    check_writable,
    next_run,
    previous_run,
    suggested_parameters,
)
from shapewright.settings import Settings
from shapewright.storage import cache_folder

if TYPE_CHECKING:
    from shapewright.building import Executor
    from shapewright.procedures import Procedure
    from shapewright.references import Collection
    from shapewright.runs.iteration import Iteration

_NOTHING = "nothing of this run was written; earlier runs are as they were"
_GOES_ON = "nothing of this run was written; the same command goes on with it, and earlier runs are as they were"
_NAMED = 4  # names of references in a line
_SIDES = 4  # that look like the front of a shape that has none


@with_settings(
    *("seed", "samples", "within", "epochs", "cameras", "views", "augment", "refine", "rounds", "device"),
    *(
        "drop",
        "split",
        "duplicates",
        "leave_out",
        "judge",
        "threshold",
        "vif",
        "align",
        "facing",
        "shape_seconds",
        "shape_memory_mb",
        "workers",
        "verbose",
    ),
)
def fit(
    procedure: ProcedureArgument,
    references: Annotated[
        str, typer.Argument(help="A folder, a glob in quotes, a CSV manifest, a file, a URL, or @list.txt.")
    ],
    chosen: Mapping[str, Any],
    out_dir: Annotated[
        Path | None, typer.Option("--out", help="Folder of this run.  [dim]default: the next free runs/NNN[/]")
    ] = None,
    preset: PresetOption = "fast",
    previous: Annotated[
        Path | None,
        typer.Option("--from", help="A run of an earlier version to resume: quicker, and it keeps what was found."),
    ] = None,
    marks: Annotated[
        bool, typer.Option("--marks", help="Judge as the project's marks say: see [bold]shapewright mark[/].")
    ] = False,
    up: Up = "y",
    front: Front = None,
    keep: Keep = None,
    explain: Annotated[bool, typer.Option("--explain", help="Say why, and what to write next.")] = False,
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Begin anew, where the same command was stopped before its end.")
    ] = False,
    chunk: Annotated[
        int, typer.Option(min=1, help="References that are searched for at the same time; fewer take less memory.")
    ] = 256,
    cluster: ClusterOption = None,
    json: Json = False,
) -> None:
    """Find the parameters of every reference, build replicas, and report what the procedure cannot make yet."""
    from shapewright.building.clusters import where
    from shapewright.fitting.pacing.opening import Opening
    from shapewright.references import Collection

    folder = (out_dir or next_run(Path("runs"))).absolute()
    check_free(folder)
    settings, author = Settings.preset(preset, **chosen), load_procedure(procedure)
    # torch takes seconds to load: before it the first shapes are begun, and what is wrong with the files is said.
    with (
        where(cluster) as there,
        interruptible(_GOES_ON) as listen,
        Opening(author, settings, listen, previous is not None, there) as opening,
    ):
        loaded = Collection.load(references, up=up, front=front, keep=keep or ())
        check_writable(folder)
        opening.wait()
        if marks:
            settings = Settings.preset(preset, **{**judged_by_marks(folder, settings.judge), **chosen})
        from shapewright.fitting.fit import fit as iterate
        from shapewright.fitting.keeping.unfinished import UNFINISHED, Unfinished
        from shapewright.fitting.pictures import suited
        from shapewright.fitting.standing import stand
        from shapewright.runs.iteration import Iteration

        earlier = Iteration.load(previous) if previous else None
        opening.builds()
        loaded = suited(loaded, opening.crew)
        if explain:
            from shapewright.feedback.explanation import check_explainable

            check_explainable(loaded)
        known = suggested_parameters(previous, author.space.names) if previous else None
        loaded = stand(author, loaded, settings, listen, earlier)
        print_axes(loaded)
        unfinished = Unfinished(folder.parent / UNFINISHED, fresh)
        iteration = iterate(
            author, loaded, settings, listen, cache_folder(), earlier, known, opening, None, unfinished, chunk
        )
    _save(iteration, folder)
    if explain:
        with where(cluster) as there:
            _explain(iteration, author, loaded, folder, there)
    unfinished.remove()
    if json:
        print_json(iteration_record(iteration, folder))
    else:
        print_iteration(iteration, folder)


def fit_and_save(procedure: Procedure, references: Collection, settings: Settings, folder: Path) -> Iteration:
    """Run and save one iteration with its report."""
    from shapewright.fitting.fit import fit as iterate

    with interruptible(_NOTHING) as listen:
        iteration = iterate(procedure, references, settings, listen, cache_folder())
    _save(iteration, folder)
    return iteration


def _save(iteration: Iteration, folder: Path) -> None:
    """Save a run with its report; where its folder cannot be written, elsewhere, and RunError says where."""
    from shapewright.report import write_report

    previous = previous_run(folder, set(iteration.names))
    try:
        iteration.save(folder, lambda partial: write_report(partial, previous))
    except RunError as error:
        refuge = next_run(Path(tempfile.gettempdir()) / "shapewright-runs")
        err.print(f"[red]{escape(str(error))}[/]\nsaving to {escape(str(refuge))} instead", highlight=False)
        iteration.save(refuge, lambda partial: write_report(partial, None))
        raise RunError(f"{error}\nThe run is whole in {refuge}; free some space and move it") from error


def _explain(
    iteration: Iteration, procedure: Procedure, references: Collection, folder: Path, executor: Executor | None
) -> None:
    """Explain a run that is saved; whatever goes wrong, the run stays whole, and the message says so."""
    remains = f"the run is whole in {folder}; explain it with: shapewright explain {folder}"
    try:
        with interruptible(remains) as listen:
            explain_saved(iteration, procedure, references, folder, listen, executor=executor)
    except typer.Exit:
        raise
    except Exception as error:
        raise RunError(f"the run could not be explained: {error}\nBut {remains}") from error


def print_axes(references: Collection) -> None:
    """Which axes of the files point up and to the front, where these were looked for; on standard error."""
    found = [(reference, reference.finding) for reference in references if reference.finding]
    ways: dict[tuple[str, str, str], list[str]] = {}
    for each, _ in found:
        how = "turned" if each.axes_by == "found" else "as it is given"
        ways.setdefault((each.orientation.up, each.orientation.front, how), []).append(each.name)
    for (up, front, how), names in sorted(ways.items(), key=lambda way: -len(way[1])):
        err.print(f"up {up}, front {front}, {how}: {_counted(names)}", highlight=False, soft_wrap=True)
    for what, names in (
        ("no up is to be seen", [each.name for each, finding in found if not finding.has_up]),
        ("no front is to be seen", [each.name for each, finding in found if finding.fronts == _SIDES]),
    ):
        if names:
            err.print(f"[dim]{what}: {_counted(names)}[/]", highlight=False, soft_wrap=True)


def _counted(names: Sequence[str]) -> str:
    more = ", ..." if len(names) > _NAMED else ""
    return f"{len(names)} ({escape(', '.join(names[:_NAMED]))}{more})"
