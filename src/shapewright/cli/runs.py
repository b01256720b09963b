"""Commands about runs that are there: explain one, mark its pairs, write its report anew, compare two."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer
from rich.markup import escape

from shapewright.cli.bars import interruptible
from shapewright.cli.console import (
    out,
    print_calibration,
    print_comparison,
    print_explanation,
    print_json,
)
from shapewright.cli.options import ClusterOption, Json, Workers
from shapewright.procedures.forms import Form
from shapewright.runs.folder import RunError, previous_run
from shapewright.runs.marks import marks_path
from shapewright.settings import JudgeName, Settings
from shapewright.storage import cache_folder

if TYPE_CHECKING:
    from shapewright.building import Executor
    from shapewright.judging.calibration import Calibration
    from shapewright.procedures import Procedure
    from shapewright.progress import Listener
    from shapewright.references import Collection
    from shapewright.runs.iteration import Iteration

Run = Annotated[Path, typer.Argument(help="Folder of a run.")]


def explain(
    run: Run,
    references: Annotated[
        str | None, typer.Option(help="Where the collection is now.  [dim]default: where it was[/]")
    ] = None,
    suggestions: Annotated[bool, typer.Option(help="Try what to write next; takes longer.")] = True,
    cluster: ClusterOption = None,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Say where and why replicas differ from their references, and what to write next; renews the run's report."""
    from shapewright.building.clusters import where
    from shapewright.runs.inputs import procedure_of, references_of
    from shapewright.runs.iteration import Iteration

    run = run.absolute()
    iteration = Iteration.load(run)
    procedure, collection = procedure_of(run, iteration), references_of(iteration, references)
    with where(cluster) as there, interruptible("the run is as it was") as listen:
        record = explain_saved(iteration, procedure, collection, run, listen, suggestions, workers, there)
    if json:
        print_json({"run": str(run), "report": str(run / "report.html"), **record})
    else:
        print_explanation(record, run)


def mark(
    run: Run,
    name: Annotated[str, typer.Argument(help="A reference of the run.")],
    judgement: Annotated[
        Literal["same", "different"], typer.Argument(help="What it and its replica are, to your eye.")
    ],
    json: Json = False,
) -> None:
    """Mark a reference and its replica as the same or as different; the marks say what the cut should be."""
    from shapewright.runs.marks import mark as write_mark

    path = write_mark(run, name, judgement == "same")
    calibration = _calibration(run)
    if json:
        print_json({"path": str(path), **asdict(calibration)})
    else:
        print_calibration(path, calibration)


def report(
    run: Run,
    previous: Annotated[
        Path | None, typer.Option(help="Run to compare with.  [dim]default: the one before it in the same folder[/]")
    ] = None,
    json: Json = False,
) -> None:
    """Write a run's report anew and print its path."""
    from shapewright.report import write_report

    path = write_report(run.absolute(), previous or previous_run(run.absolute()))
    if json:
        print_json({"report": str(path)})
    else:
        out.print(escape(str(path)), soft_wrap=True, highlight=False)


def parameters(
    run: Run,
    names: Annotated[list[str] | None, typer.Argument(help="References of the run.  [dim]default: all[/]")] = None,
    form: Annotated[
        Form,
        typer.Option(
            help="A call in Python, arguments of openscad, a script for Blender, parameter sets as JSON, or a table."
        ),
    ] = "csv",
    json: Json = False,
) -> None:
    """Print the parameters that a run found, in a form that the procedure's own program reads."""
    from shapewright.procedures.forms import written
    from shapewright.runs.inputs import procedure_of
    from shapewright.runs.iteration import Iteration

    iteration = Iteration.load(run.absolute())
    procedure = procedure_of(run.absolute(), iteration)
    if missing := [name for name in names or () if name not in iteration.names]:
        raise RunError(f"{run}: there is no reference {missing[0]!r}; there are {', '.join(iteration.names)}")
    found = {result.name: result.parameters for result in iteration if result.name in (names or iteration.names)}
    defaults = procedure.space.defaults
    sets = {name: {key: values.get(key, defaults[key]) for key in defaults} for name, values in found.items() if values}
    if json:
        print_json({"form": form, "parameters": sets, "text": written(procedure, sets, form)})
    else:
        typer.echo(written(procedure, sets, form), nl=False)


def compare(
    before: Annotated[Path, typer.Argument(help="Folder of the earlier run.")],
    after: Annotated[Path, typer.Argument(help="Folder of the later run.")],
    json: Json = False,
) -> None:
    """Show what changed between two runs: newly replicated, lost, closer, further."""
    from shapewright.runs.changes import compare as compare_runs

    comparison = compare_runs(before, after)
    if json:
        print_json(asdict(comparison))
    else:
        print_comparison(before, after, comparison)


def judged_by_marks(folder: Path, judge: JudgeName) -> dict[str, Any]:
    """The settings of a judge that a project's marks ask for.

    The other judge's stay. folder: of the run to be made. Raises RunError without marks.
    """
    found = _calibration(folder)
    if not found.marks:
        raise RunError(f"{marks_path(folder)}: no marks yet; make some with: shapewright mark RUN NAME same|different")
    if judge == "paper":
        return {"threshold": found.threshold, "metric": found.metric}
    return {"replicated": found.replicated, "close": min(Settings.close, found.replicated)}


def _calibration(run: Path) -> Calibration:
    from shapewright.judging.calibration import calibrate
    from shapewright.runs.marks import read_marks

    marks = read_marks(run)
    return calibrate([mark.measures for mark in marks], [mark.same for mark in marks])


def explain_saved(
    iteration: Iteration,
    procedure: Procedure,
    references: Collection,
    run: Path,
    progress: Listener | None,
    suggestions: bool = True,
    workers: int | None = None,
    executor: Executor | None = None,
) -> dict[str, Any]:
    """Explain an iteration that is saved in a folder, and put that into the folder; returns the record."""
    from shapewright.feedback.explanation import explain as explain_iteration
    from shapewright.feedback.record import record_of, write

    explanation = explain_iteration(
        iteration, procedure, references, progress, cache_folder(), suggestions, workers, executor=executor
    )
    return write(run, record_of(explanation), previous_run(run, set(iteration.names)))
