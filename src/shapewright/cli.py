"""The command line: new, fit, sample, report, compare, demo."""

from __future__ import annotations

import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer
from rich.console import Console
from rich.markup import escape

from shapewright.procedure import ProcedureError, load_procedure
from shapewright.references.errors import CollectionError
from shapewright.settings import Settings
from shapewright.workspace import RunError, cache_folder, check_writable, next_run, read_record, runs

if TYPE_CHECKING:
    from shapewright.iteration import Iteration
    from shapewright.procedure import Procedure
    from shapewright.references import Collection

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
    help="Find the parameters that replicate a collection of shapes, and see what the procedure cannot make yet.",
    epilog="Start with [bold]shapewright demo[/], or with [bold]shapewright new chairs[/] for a project of your own.",
)
out, err = Console(), Console(stderr=True)
_HANDLED = (ProcedureError, CollectionError, RunError, ValueError, OSError)

ProcedureArgument = Annotated[
    Path, typer.Argument(help="The Python file with the @procedure; file.py:name for one of several.")
]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object as the last line of standard output.")]
Seed = Annotated[int, typer.Option(help="Of everything random: the same seed gives the same result.")]
Workers = Annotated[int | None, typer.Option(min=1, help="Processes and threads.  [dim]default: all cores[/]")]


@app.command()
def new(name: Annotated[Path, typer.Argument(help="The folder to make.")]) -> None:
    """Start a project: a folder with a first procedure and a place for references."""
    if name.exists():
        raise RunError(f"{name}: exists already; name another folder")
    (name / "references").mkdir(parents=True)
    (name / "procedure.py").write_text(_STARTER, encoding="utf-8")
    out.print(f"made {escape(str(name))}/procedure.py and {escape(str(name))}/references/", highlight=False)
    out.print("\nPut meshes (OBJ, PLY, STL, OFF, GLB, glTF, 3MF) into references, then:\n")
    out.print(f"  cd {escape(str(name))}\n  shapewright fit procedure.py references", highlight=False)


@app.command()
def fit(
    procedure: ProcedureArgument,
    references: Annotated[str, typer.Argument(help="A folder, a glob in quotes, a CSV manifest, or a file.")],
    out_dir: Annotated[
        Path | None, typer.Option("--out", help="Folder of this run.  [dim]default: the next free runs/NNN[/]")
    ] = None,
    seed: Seed = 0,
    preset: Annotated[Literal["fast"], typer.Option(help="How to predict: fast is made for laptops.")] = "fast",
    samples: Annotated[int, typer.Option(min=20, help="Parameter vectors to learn from.")] = Settings.samples,
    epochs: Annotated[int, typer.Option(min=1, help="Passes over them.")] = Settings.epochs,
    refine: Annotated[
        Literal["off", "quick", "thorough"], typer.Option(help="Search for better parameters from the predicted ones.")
    ] = "quick",
    threshold: Annotated[float, typer.Option(help="Largest distance of a compatible reference.")] = Settings.threshold,
    align: Annotated[
        Literal["free", "upright"], typer.Option(help="Compare in all rotations, or about the up axis only.")
    ] = "free",
    up: Annotated[str, typer.Option(help="The axis of the files that points up: x, y, z, -x, -y, -z.")] = "y",
    front: Annotated[
        str | None, typer.Option(help="The axis that points to the front.  [dim]default: z, or -y where up is z[/]")
    ] = None,
    time_limit: Annotated[float, typer.Option(help="Seconds that building one shape may take.")] = 10.0,
    memory_limit: Annotated[int, typer.Option(help="Megabytes that building one shape may take.")] = 2048,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Find the parameters of every reference, build replicas, and report what the procedure cannot make yet."""
    from shapewright.console import iteration_record, print_iteration, print_json

    folder = (out_dir or next_run(Path("runs"))).absolute()
    check_writable(folder)
    settings = Settings(
        seed=seed,
        samples=samples,
        epochs=epochs,
        refine=refine,
        threshold=threshold,
        align=align,
        shape_seconds=time_limit,
        shape_memory_mb=memory_limit,
        workers=workers,
    )
    iteration, folder = _fit(load_procedure(procedure), _load(references, up, front), settings, folder)
    if json:
        print_json(iteration_record(iteration, folder))
    else:
        print_iteration(out, iteration, folder)


@app.command()
def sample(
    procedure: ProcedureArgument,
    out_dir: Annotated[
        Path, typer.Option("--out", help="Folder for the shapes; one that holds the first of them is gone on with.")
    ],
    count: Annotated[int, typer.Option("-n", "--count", min=1, help="How many shapes.")] = 10,
    format: Annotated[
        Literal["glb", "ply", "obj", "stl", "off"], typer.Option(help="Kind of file; drawings are written as SVG.")
    ] = "glb",
    seed: Seed = 0,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Write random shapes of a procedure, and a table of their parameters and soundness."""
    from shapewright.console import print_json, progress_bars
    from shapewright.progress import Progress
    from shapewright.sampling import MANIFEST, write_samples

    folder = out_dir.absolute()
    try:
        with progress_bars(err) as listen:
            samples = write_samples(
                load_procedure(procedure),
                count,
                folder,
                format,
                seed,
                workers,
                lambda done, total: listen(Progress("sample", done, total)),
            )
    except KeyboardInterrupt:
        err.print(f"stopped: what {MANIFEST} lists is whole; the same command goes on from there")
        raise typer.Exit(130) from None
    if samples.failures:
        err.print(f"[yellow]failed:[/] {escape(samples.failures)}", highlight=False)
    if json:
        print_json({"out": str(folder), "manifest": str(folder / MANIFEST), **asdict(samples)})
    else:
        unsound = f", {samples.unsound} of them unsound," if samples.unsound else ""
        out.print(f"{samples.shapes} shapes{unsound} and {MANIFEST} in {escape(str(out_dir))}", highlight=False)


@app.command()
def report(
    run: Annotated[Path, typer.Argument(help="Folder of a run.")],
    previous: Annotated[
        Path | None, typer.Option(help="Run to compare with.  [dim]default: the one before it in the same folder[/]")
    ] = None,
    json: Json = False,
) -> None:
    """Write a run's report anew and print its path."""
    from shapewright.console import print_json
    from shapewright.report import write_report

    read_record(run)
    if previous:
        read_record(previous)
    path = write_report(run.absolute(), previous or _before(run.absolute()))
    if json:
        print_json({"report": str(path)})
    else:
        out.print(escape(str(path)), soft_wrap=True, highlight=False)


@app.command()
def compare(
    before: Annotated[Path, typer.Argument(help="Folder of the earlier run.")],
    after: Annotated[Path, typer.Argument(help="Folder of the later run.")],
    json: Json = False,
) -> None:
    """Show what changed between two runs: newly compatible, lost, closer, further."""
    from shapewright.console import print_comparison, print_json
    from shapewright.report import compare as compare_records

    comparison = compare_records(read_record(after), read_record(before))
    if json:
        print_json(asdict(comparison))
    else:
        print_comparison(out, before, after, comparison)


@app.command()
def demo(
    out_dir: Annotated[Path, typer.Option("--out", help="Folder for the demo's references and runs.")] = Path(
        "demo-run"
    ),
    seed: Seed = 0,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Fit two versions of a table procedure to forty bundled tables, and report what the second one gained."""
    from shapewright.console import iteration_record, print_iteration, print_json
    from shapewright.demo import collection as bundled
    from shapewright.demo import procedures

    references = out_dir / "references"
    bundled.write(references)
    loaded, folder = _load(str(references), "y", None), out_dir
    for version in ("v3", "v5"):
        folder = next_run(out_dir / "runs").absolute()
        check_writable(folder)
        if not json:
            out.print(f"\n[bold]tables, {version}[/]", highlight=False)
        settings = Settings(seed=seed, workers=workers)
        iteration, folder = _fit(load_procedure(procedures.path(version)), loaded, settings, folder)
        if not json:
            print_iteration(out, iteration, folder)
    if json:
        print_json(iteration_record(iteration, folder))


def _load(references: str, up: str, front: str | None) -> Collection:
    from shapewright.references import Collection

    return Collection.load(references, up=up, front=front)


def _fit(procedure: Procedure, references: Collection, settings: Settings, folder: Path) -> tuple[Iteration, Path]:
    """Run and save one iteration; returns it and the folder that it is in."""
    from shapewright.authoring import fit as iterate
    from shapewright.console import progress_bars

    try:
        with progress_bars(err) as listen:
            iteration = iterate(procedure, references, settings, listen, cache_folder())
    except KeyboardInterrupt:
        err.print("stopped: nothing of this run was written; earlier runs are as they were")
        raise typer.Exit(130) from None
    previous = _before(folder, set(iteration.names))
    try:
        return iteration, iteration.save(folder, previous)
    except RunError as error:
        refuge = next_run(Path(_temporary()) / "shapewright-runs")
        err.print(f"[red]{escape(str(error))}[/]\nsaving to {escape(str(refuge))} instead", highlight=False)
        iteration.save(refuge)
        raise RunError(f"{error}\nThe run is whole in {refuge}; free some space and move it") from error


def _before(folder: Path, names: set[str] | None = None) -> Path | None:
    """The newest run beside ``folder`` that is older than it, and shares references with it."""
    beside = [run for run in runs(folder.parent) if run != folder]
    if (folder / "iteration.json").exists():
        written = (folder / "iteration.json").stat().st_mtime_ns
        beside = [run for run in beside if (run / "iteration.json").stat().st_mtime_ns < written]
    for run in reversed(beside):
        theirs = {entry["name"] for entry in read_record(run)["references"]}
        if names is None or names & theirs:
            return run
    return None


def _temporary() -> str:
    import tempfile

    return tempfile.gettempdir()


def main() -> None:
    """Run a command; a failure prints one message that says what to do, and the exit status is not 0."""
    try:
        app()
    except _HANDLED as error:
        _fail(str(error), "--json" in sys.argv)


def _fail(message: str, json: bool) -> None:
    from shapewright.console import print_json

    err.print(f"[bold red]error:[/] {escape(message)}", highlight=False, soft_wrap=True)
    if json:
        print_json({"error": message})
    sys.exit(1)


_STARTER = '''"""A first procedure: every parameter of the function is a parameter of the model."""

from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cylinder


@procedure
def table(
    height: Annotated[float, Range(0.4, 1.1)] = 0.7,
    breadth: Annotated[float, Range(0.3, 1.0)] = 0.6,
    thickness: Annotated[float, Range(0.02, 0.15)] = 0.05,
    leg: Annotated[float, Range(0.03, 0.15)] = 0.06,
    top: Literal["square", "round"] = "square",
):
    # Y is up, the front faces +Z; any unit will do, because shapes are compared at the same size.
    make = cylinder if top == "round" else box
    plate = make((1.0, thickness, breadth), at=(0, height - thickness / 2, 0)).label("top")
    reach = 0.7 if top == "round" else 1.0
    x, z = (reach - leg) / 2, (breadth * reach - leg) / 2
    post = box((leg, height, leg), at=(x, height / 2, z)).label("legs")
    return plate | post.mirror("x", keep=True).mirror("z", keep=True)
'''

if __name__ == "__main__":
    main()
