"""The command line: new, fit, explain, mark, evaluate, sample, silhouettes, report, compare, studio, demo."""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer
from rich.console import Console
from rich.markup import escape

from shapewright.cli import runs as commands
from shapewright.cli import samples as files
from shapewright.cli.options import (
    Augment,
    Cameras,
    Device,
    Epochs,
    Front,
    Json,
    Preset,
    ProcedureArgument,
    Refine,
    Samples,
    Seed,
    Up,
    Views,
    Workers,
)
from shapewright.cli.studio import studio
from shapewright.procedures import ProcedureError, load_procedure
from shapewright.references.errors import CollectionError
from shapewright.runs.folder import RunError, check_free, check_writable, next_run, previous_run
from shapewright.settings import Settings
from shapewright.storage import cache_folder
from shapewright.studio.project.workspace import ProjectError

if TYPE_CHECKING:
    from shapewright.procedures import Procedure
    from shapewright.references import Collection
    from shapewright.runs.iteration import Iteration

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
    help="Find the parameters that replicate a collection of shapes, and see what the procedure cannot make yet.",
    epilog="Start with [bold]shapewright demo[/], or with [bold]shapewright new chairs[/] for a project of your own.",
)
out, err = Console(), Console(stderr=True)
_HANDLED = (ProcedureError, CollectionError, RunError, ProjectError, ValueError, OSError)


@app.command()
def new(name: Annotated[Path, typer.Argument(help="The folder to make.")]) -> None:
    """Start a project: a folder with a first procedure and a place for references."""
    if name.exists():
        raise RunError(f"{name}: exists already; name another folder")
    (name / "references").mkdir(parents=True)
    shutil.copyfile(Path(__file__).with_name("starter.py"), name / "procedure.py")
    out.print(f"made {escape(str(name))}/procedure.py and {escape(str(name))}/references/", highlight=False)
    out.print("\nPut meshes (OBJ, PLY, STL, OFF, GLB, glTF, 3MF) into references, then:\n")
    place = escape(str(name))
    out.print(f"  shapewright studio {place}\n\nor, without a browser:\n", highlight=False)
    out.print(f"  cd {place}\n  shapewright fit procedure.py references", highlight=False)


@app.command()
def fit(
    procedure: ProcedureArgument,
    references: Annotated[str, typer.Argument(help="A folder, a glob in quotes, a CSV manifest, or a file.")],
    out_dir: Annotated[
        Path | None, typer.Option("--out", help="Folder of this run.  [dim]default: the next free runs/NNN[/]")
    ] = None,
    seed: Seed = 0,
    preset: Preset = "fast",
    samples: Samples = None,
    epochs: Epochs = None,
    cameras: Cameras = None,
    views: Views = None,
    augment: Augment = False,
    refine: Refine = None,
    rounds: Annotated[int, typer.Option(min=0, help="Rounds of adaptive sampling around what was found.")] = 0,
    previous: Annotated[
        Path | None,
        typer.Option("--from", help="A run of an earlier version to go on from: quicker, and what was found stays."),
    ] = None,
    device: Device = "auto",
    threshold: Annotated[
        float | None, typer.Option(help="Largest distance of a compatible mesh.  [dim]default: 0.18[/]")
    ] = None,
    marks: Annotated[
        bool, typer.Option("--marks", help="Judge as the project's marks say: see [bold]shapewright mark[/].")
    ] = False,
    fidelity: Annotated[
        float, typer.Option(help="Least visual information fidelity of a compatible drawing.")
    ] = Settings.fidelity,
    align: Annotated[
        Literal["free", "upright"], typer.Option(help="Compare in all rotations, or about the up axis only.")
    ] = "free",
    facing: Annotated[
        Literal["given", "found"],
        typer.Option(help="found turns each reference by the quarter turns about the up axis that fit best."),
    ] = "given",
    up: Up = "y",
    front: Front = None,
    time_limit: Annotated[float, typer.Option(help="Seconds that building one shape may take.")] = 10.0,
    memory_limit: Annotated[int, typer.Option(help="Megabytes that building one shape may take.")] = 2048,
    explain: Annotated[bool, typer.Option("--explain", help="Say why, and what to write next.")] = False,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Find the parameters of every reference, build replicas, and report what the procedure cannot make yet."""
    from shapewright.cli.console import iteration_record, print_iteration, print_json

    folder = (out_dir or next_run(Path("runs"))).absolute()
    check_free(folder)
    given = _given(samples=samples, epochs=epochs, cameras=cameras, views=views, refine=refine, threshold=threshold)
    settings = Settings.preset(
        preset,
        **{**(commands.judged_by_marks(folder) if marks else {}), **given},
        seed=seed,
        augment=augment,
        rounds=rounds,
        device=device,
        fidelity=fidelity,
        align=align,
        facing=facing,
        shape_seconds=time_limit,
        shape_memory_mb=memory_limit,
        workers=workers,
    )
    earlier = _load_run(previous) if previous else None
    author, loaded = load_procedure(procedure), _load(references, up, front)
    check_writable(folder)
    iteration, folder = _fit(author, loaded, settings, folder, earlier, explain)
    if json:
        print_json(iteration_record(iteration, folder))
    else:
        print_iteration(out, iteration, folder)


app.command()(commands.explain)
app.command()(commands.mark)


@app.command()
def evaluate(
    procedure: ProcedureArgument,
    seeds: Annotated[int, typer.Option(min=1, help="Trainings, each with another seed.")] = 1,
    preset: Preset = "fast",
    samples: Samples = None,
    epochs: Epochs = None,
    cameras: Cameras = None,
    views: Views = None,
    augment: Augment = False,
    refine: Refine = None,
    refined: Annotated[int, typer.Option(min=1, help="Held-out samples that refinement is measured on.")] = 100,
    compare: Annotated[
        Literal["cameras", "views", "both"] | None,
        typer.Option(help="cameras: fixed against learned; views: 1, 2, 3 and 5 cameras; both: all combinations."),
    ] = None,
    device: Device = "auto",
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Measure how well the parameters of a procedure are found, on samples that were held out."""
    from shapewright.cli.console import print_json, print_trials, progress_bars
    from shapewright.fitting.evaluation import evaluate as run_trials
    from shapewright.fitting.evaluation import summary, variants

    given = _given(samples=samples, epochs=epochs, cameras=cameras, views=views, refine=refine)
    settings = Settings.preset(preset, **given, augment=augment, device=device, workers=workers)
    author = load_procedure(procedure)
    found = []
    for variant in variants(settings, compare):
        with progress_bars(err) as listen:
            trials = list(run_trials(author, [variant], range(seeds), listen, refined))
        seconds = [trial.seconds for trial in trials]
        record = {"cameras": variant.cameras, "views": variant.views, "parameters": summary(trials), "seconds": seconds}
        found.append(record)
        if not json:
            if compare:
                out.print(f"\n[bold]{variant.cameras} cameras, {variant.views}[/]", highlight=False)
            print_trials(out, trials)
    if json:
        print_json({"variants": found} if compare else found[0])


for command in (files.sample, files.silhouettes, commands.report, commands.compare, studio):
    app.command()(command)


@app.command()
def demo(
    out_dir: Annotated[Path, typer.Option("--out", help="Folder for the demo's references and runs.")] = Path(
        "demo-run"
    ),
    drawings: Annotated[bool, typer.Option("--drawings", help="Fifty drawings of tables instead of meshes.")] = False,
    seed: Seed = 0,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Fit two versions of a table procedure to forty bundled tables, and report what the second one gained."""
    from shapewright.cli.console import iteration_record, print_iteration, print_json
    from shapewright.demo import drawings as drawn
    from shapewright.demo import meshes as collection
    from shapewright.demo import procedures

    references = out_dir / "references"
    (drawn if drawings else collection).write(references)
    loaded, folder = _load(str(references), "y", None), out_dir
    for version in ("v3", "v5"):
        folder = next_run(out_dir / "runs").absolute()
        check_writable(folder)
        if not json:
            out.print(f"\n[bold]tables, {version}[/]", highlight=False)
        settings = Settings(seed=seed, workers=workers)
        iteration, folder = _fit(load_procedure(procedures.path(version, drawings)), loaded, settings, folder)
        if not json:
            print_iteration(out, iteration, folder)
    if not (out_dir / "procedure.py").exists():
        shutil.copyfile(procedures.path(version), out_dir / "procedure.py")
    if json:
        print_json(iteration_record(iteration, folder))
    else:
        out.print(f"\nto go on from here in the browser: shapewright studio {escape(str(out_dir))}", highlight=False)


def _load(references: str, up: str, front: str | None) -> Collection:
    from shapewright.references import Collection

    return Collection.load(references, up=up, front=front)


def _given(**options: Any) -> dict[str, Any]:
    """The options that were given; the others are as the preset says."""
    return {name: value for name, value in options.items() if value is not None}


def _load_run(folder: Path) -> Iteration:
    from shapewright.runs.iteration import Iteration

    return Iteration.load(folder)


def _fit(
    procedure: Procedure,
    references: Collection,
    settings: Settings,
    folder: Path,
    previous: Iteration | None = None,
    explained: bool = False,
) -> tuple[Iteration, Path]:
    """Run and save one iteration, explained if wanted; returns it and the folder that it is in."""
    from shapewright.cli.console import progress_bars
    from shapewright.fitting.fit import fit as iterate

    try:
        with progress_bars(err) as listen:
            iteration = iterate(procedure, references, settings, listen, cache_folder(), previous)
            explain = commands.explanation_of(procedure, references, iteration, listen) if explained else None
    except KeyboardInterrupt:
        err.print("stopped: nothing of this run was written; earlier runs are as they were")
        raise typer.Exit(130) from None
    before = previous_run(folder, set(iteration.names))
    try:
        return iteration, iteration.save(folder, partial(_write_more, explain, before))
    except RunError as error:
        refuge = next_run(Path(tempfile.gettempdir()) / "shapewright-runs")
        err.print(f"[red]{escape(str(error))}[/]\nsaving to {escape(str(refuge))} instead", highlight=False)
        iteration.save(refuge, partial(_write_more, explain, None))
        raise RunError(f"{error}\nThe run is whole in {refuge}; free some space and move it") from error


def _write_more(explain: Callable[[Path], object] | None, previous: Path | None, folder: Path) -> None:
    """Write an explanation, if wanted, and the report into the folder of a run."""
    from shapewright.report import write_report

    if explain:
        explain(folder)
    write_report(folder, previous)


def main() -> None:
    """Run a command; a failure prints one message that says what to do, and the exit status is not 0."""
    try:
        app()
    except KeyboardInterrupt:
        sys.exit(130)
    except _HANDLED as error:
        _fail(str(error), "--json" in sys.argv)


def _fail(message: str, json: bool) -> None:
    from shapewright.cli.console import print_json

    err.print(f"[bold red]error:[/] {escape(message)}", highlight=False, soft_wrap=True)
    if json:
        print_json({"error": message})
    sys.exit(1)


if __name__ == "__main__":
    main()
