"""Commands that write shapes into files: random ones of a procedure, silhouettes of meshes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Literal

import typer
from rich.markup import escape
from rich.table import Table

from shapewright.cli.bars import interruptible
from shapewright.cli.console import err, out, print_json
from shapewright.cli.options import ClusterOption, Front, Json, ProcedureArgument, Seed, Up, Workers, option, parsed
from shapewright.fitting.sampling.formats import FileFormat
from shapewright.fitting.sampling.shards import Shard
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure, ProcedureError, load_procedure
from shapewright.procedures.sets import read_sets
from shapewright.settings import Settings
from shapewright.storage import file_names, printable


def sample(
    procedure: ProcedureArgument,
    out_dir: Annotated[
        Path,
        typer.Option(
            "--out", help="Folder for the shapes. If it holds the first of them already, the command adds the others."
        ),
    ],
    count: Annotated[int, typer.Option("-n", "--count", min=1, help="How many shapes.")] = 10,
    format: Annotated[
        FileFormat,
        typer.Option(
            help="Kind of file; drawings are written as SVG. wds: tars of 1,000 samples, as WebDataset reads them."
        ),
    ] = "glb",
    shard: Annotated[
        Shard | None,
        typer.Option(
            parser=parsed(Shard.parse),
            metavar="K/M",
            help="Write part K of M alone, from 1/M to M/M, each in a folder of its own; "
            "[bold]shapewright samples merge[/] joins them.",
        ),
    ] = None,
    like: Annotated[
        Path | None,
        typer.Option(
            metavar="RUN", help="Draw more of what the references of a run showed, each as well as it is replicated."
        ),
    ] = None,
    parameters: Annotated[
        Path | None,
        typer.Option(help="Build what a file lists: OpenSCAD's parameter sets (JSON), or a CSV with a header."),
    ] = None,
    parquet: Annotated[
        bool, typer.Option("--parquet", help="Write the manifest as Parquet as well; needs shapewright[scale].")
    ] = False,
    seed: Seed = Settings.seed,
    cluster: ClusterOption = None,
    workers: Workers = None,
    verbose: Annotated[bool, option("verbose")] = False,
    json: Json = False,
) -> None:
    """Write random shapes of a procedure, or those that a file lists, and a table of their parameters and soundness."""
    from shapewright.building.clusters import where
    from shapewright.fitting.samples import MANIFEST, write_samples
    from shapewright.progress import Progress

    if parameters and like:
        raise typer.BadParameter("--parameters lists what is built, so nothing is drawn --like a run: leave one out")
    author, folder = load_procedure(procedure), out_dir.absolute()
    given = None if parameters is None else _listed(parameters, author)
    count = count if given is None else len(given)
    stopped = f"what {MANIFEST} lists is whole; the same command adds the others"
    with where(cluster) as there, interruptible(stopped) as listen:
        written = write_samples(
            author,
            count,
            folder,
            format,
            seed,
            workers,
            lambda done, total: listen(Progress("sample", done, total)),
            given,
            verbose,
            shard=shard,
            like=like,
            parquet=parquet,
            executor=there,
        )
    if written.failed and not written.shapes and not shard:
        raise ProcedureError(f"none of {count} shapes could be built: {written.failures}")
    if written.failures:
        err.print(f"[yellow]failed:[/] {escape(written.failures)}", highlight=False)
    if json:
        print_json({"out": str(folder), "manifest": str(folder / MANIFEST), **asdict(written)})
    else:
        unsound = f", {written.unsound} of them unsound," if written.unsound else ""
        out.print(f"{written.shapes} shapes{unsound} and {MANIFEST} in {escape(str(out_dir))}", highlight=False)


samples = typer.Typer(no_args_is_help=True, help="Folders of samples: join the shards of many machines.")


@samples.command()
def merge(
    shards: Annotated[list[Path], typer.Argument(help="Folders that [bold]shapewright sample --shard[/] has written.")],
    out_dir: Annotated[Path, typer.Option("--out", help="A new folder for all their samples.")],
    json: Json = False,
) -> None:
    """Join all shards of the same samples: to the bit what one command without --shard writes.

    The shards stay as they are.
    """
    from shapewright.fitting.sampling.manifest import MANIFEST
    from shapewright.fitting.sampling.merging import merge as merge_shards

    folder = out_dir.absolute()
    listed = merge_shards([shard.absolute() for shard in shards], folder)
    if json:
        print_json({"out": str(folder), "manifest": str(folder / MANIFEST), "shards": len(shards), "samples": listed})
    else:
        out.print(f"{listed} samples of {len(shards)} shards in {escape(str(out_dir))}", highlight=False)


def _listed(path: Path, author: Procedure) -> dict[str, Parameters]:
    """The parameters that a file lists, by the names of the files to write."""
    from shapewright.fitting.samples import COLUMNS

    sets = read_sets(path, author, COLUMNS)
    if sets.held:
        err.print(f"[yellow]left at their defaults:[/] {escape(', '.join(sets.held))}", highlight=False)
    named: dict[str, Parameters] = {}
    for i, (name, values) in enumerate(sets.vectors):
        named[name if name and name not in named else f"{name or author.name}-{i:05d}"] = values
    slugs = file_names(tuple(named))
    return {slugs[name]: values for name, values in named.items()}


def describe(procedure: ProcedureArgument, json: Json = False) -> None:
    """Show the parameter space of a procedure; with --json as JSON Schema."""
    author = load_procedure(procedure)
    if json:
        schema = author.space.to_schema()
        for name, text in author.signature.meanings.items():
            schema["properties"][name]["description"] = text
        print_json({"title": author.name, **schema, "x-fixed": list(author.signature.fixed)})
    else:
        meanings = author.signature.meanings
        columns = ("parameter", "kind", "values", "default", "when", *(("meaning",) if meanings else ()))
        table = Table(*columns, box=None, pad_edge=False)
        for name, entry in author.space.to_schema()["properties"].items():
            cells = (name, entry.get("type", "choice"), _values(entry), str(entry["default"]), entry.get("x-when", ""))
            table.add_row(*map(escape, (*cells, meanings.get(name, ""))[: len(columns)]))
        out.print(table)
        if author.signature.fixed:
            out.print(f"left at their defaults, since they have no Range: {', '.join(author.signature.fixed)}")


def _values(entry: Mapping[str, Any]) -> str:
    """What a parameter may be, from its schema."""
    if "enum" in entry:
        return ", ".join(map(str, entry["enum"]))
    if "minimum" not in entry:
        return "yes, no"
    steps = entry.get("x-steps")
    sampled = "" if steps is None else f", {steps} steps" if isinstance(steps, int) else f", at {len(steps)} values"
    return f"{entry['minimum']:g} to {entry['maximum']:g}{sampled}{', log' if 'x-scale' in entry else ''}"


def silhouettes(
    references: Annotated[str, typer.Argument(help="Meshes: a folder, a glob in quotes, a CSV manifest, or a file.")],
    out_dir: Annotated[Path, typer.Option("--out", help="Folder for the drawings.")],
    view: Annotated[Literal["front", "side", "top"], typer.Option(help="Where they are seen from.")] = "front",
    format: Annotated[Literal["svg", "png"], typer.Option(help="Kind of file.")] = "svg",
    up: Up = "y",
    front: Front = None,
    workers: Workers = None,
    json: Json = False,
) -> None:
    """Write silhouettes of meshes as drawings, which procedures that draw can be fitted to."""
    from shapewright.references import Collection
    from shapewright.references.silhouette_drawings import write_silhouettes

    loaded = Collection.load(references, up=up, front=front)
    skipped = {printable(path): reason for path, reason in loaded.skipped.items()}
    paths, unseen = write_silhouettes(loaded, out_dir.absolute(), view, format, workers)
    for name, reason in (skipped | unseen).items():
        err.print(f"[yellow]skipped[/] {escape(name)}: {escape(reason)}", highlight=False, soft_wrap=True)
    if json:
        print_json({"out": str(out_dir.absolute()), "drawings": len(paths), "skipped": skipped | unseen})
    else:
        out.print(f"{len(paths)} drawings in {escape(str(out_dir))}", highlight=False)
