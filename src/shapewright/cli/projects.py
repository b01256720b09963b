"""Commands that make a project: an empty one, or the demo."""

from __future__ import annotations

import shutil
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, Literal, TypeAlias, get_args

import typer
from rich.markup import escape

from shapewright.cli.console import iteration_record, out, print_iteration, print_json
from shapewright.cli.fits import fit_and_save
from shapewright.cli.options import Json, Seed, Workers
from shapewright.procedures import load_procedure
from shapewright.procedures.loading import EXTRAS
from shapewright.runs.folder import RunError, check_writable, next_run
from shapewright.settings import Settings

Kind: TypeAlias = Literal["python", "cadquery", "build123d", "openscad", "blender", "drawing"]
NEEDED = {extra: module for module, extra in EXTRAS.items() if extra in get_args(Kind)}
"""The module that a kind of procedure needs; the extra that installs it has the name of the kind."""


def new(
    name: Annotated[Path, typer.Argument(help="The folder to make.")],
    kind: Annotated[Kind, typer.Option(help="What the first procedure is written with.")] = "python",
) -> None:
    """Start a project: a folder with a first procedure and a place for references."""
    from shapewright.references.readers.formats import MESH_FORMATS

    if name.exists():
        raise RunError(f"{name}: exists already; name another folder")
    page = f"procedure{'.scad' if kind == 'openscad' else '.py'}"
    (name / "references").mkdir(parents=True)
    shutil.copyfile(starter(kind), name / page)
    place = escape(str(name))
    out.print(f"made {place}/{page} and {place}/references/", highlight=False, soft_wrap=True)
    if kind in NEEDED and not find_spec(NEEDED[kind]):
        out.print(
            f"\nIt needs a library that is not installed here:\n\n  pip install 'shapewright\\[{kind}]'",
            highlight=False,
        )
    formats = "drawings (SVG, pictures)" if kind == "drawing" else f"meshes ({', '.join(MESH_FORMATS)})"
    out.print(f"\nPut {formats} into references, then:\n")
    option = "" if page == "procedure.py" else f" --procedure {page}"
    out.print(f"  shapewright studio {place}{option}\n\nor, without a browser:\n", highlight=False)
    out.print(f"  cd {place}\n  shapewright fit {page} references", highlight=False)


def starter(kind: Kind) -> Path:
    """The file that a new project of this kind gets a copy of."""
    return Path(__file__).parent / "starters" / f"{kind}_page{'.scad' if kind == 'openscad' else '.py'}"


def demo(
    out_dir: Annotated[Path, typer.Option("--out", help="Folder for the demo's references and runs.")] = Path(
        "demo-run"
    ),
    drawings: Annotated[bool, typer.Option("--drawings", help="Fifty drawings of tables instead of meshes.")] = False,
    seed: Seed = Settings.seed,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Fit two versions of a table procedure to bundled tables, and report what the second one gained."""
    from shapewright.demo import drawings as drawn
    from shapewright.demo import meshes as collection
    from shapewright.demo import procedures
    from shapewright.references import Collection

    references = out_dir / "references"
    (drawn if drawings else collection).write(references)
    loaded, folder = Collection.load(str(references)), out_dir
    for version in ("v3", "v5"):
        folder = next_run(out_dir / "runs").absolute()
        check_writable(folder)
        if not json:
            out.print(f"\n[bold]tables, {version}[/]", highlight=False)
        settings = Settings(seed=seed, workers=workers)
        iteration = fit_and_save(load_procedure(procedures.path(version, drawings)), loaded, settings, folder)
        if not json:
            print_iteration(iteration, folder)
    placed = place_procedure(out_dir / "procedure.py", procedures.path(version, drawings))
    if json:
        print_json(iteration_record(iteration, folder))
    else:
        if not placed:
            out.print(
                f"\n{escape(str(out_dir))}/procedure.py is your own and stays; "
                f"the demo's is {escape(str(procedures.path(version, drawings)))}",
                highlight=False,
                soft_wrap=True,
            )
        out.print(f"\nto go on in the browser: shapewright studio {escape(str(out_dir))}", highlight=False)


def place_procedure(place: Path, wanted: Path) -> bool:
    """Put a procedure of the demo where there is none, or another one of the demo's; what an author wrote stays.

    place: the file to write. wanted: the procedure. Returns whether it is there now.
    """
    from shapewright.demo.procedures import VERSIONS, path

    bundled = {path(version, drawn).read_bytes() for version in VERSIONS for drawn in (False, True)}
    if place.exists() and place.read_bytes() not in bundled:
        return False
    shutil.copyfile(wanted, place)
    return True
