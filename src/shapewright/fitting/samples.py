"""Random shapes of a procedure, in memory, or written as files: thousands of them, in parallel, and resumed.

The folder holds one file a shape, ``manifest.csv`` with a row for every parameter vector, and
``manifest.samples.json``, which says what the samples are of. A file is whole or not there, and the manifest never
names one that is not.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from itertools import islice
from pathlib import Path

from shapewright.building import Build, Executor, ExecutorError, Workers, describe_failures
from shapewright.fitting.sampling import manifest
from shapewright.fitting.sampling import parquet as tables
from shapewright.fitting.sampling.drawing import Drawn
from shapewright.fitting.sampling.formats import FileFormat, shape_format
from shapewright.fitting.sampling.likeness import Likeness
from shapewright.fitting.sampling.making import Form, made
from shapewright.fitting.sampling.manifest import COLUMNS, MANIFEST, RECORD, Row
from shapewright.fitting.sampling.packing import Packing, packing
from shapewright.fitting.sampling.shards import Shard
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Stages
from shapewright.runs.folder import RunError

__all__ = ["COLUMNS", "MANIFEST", "RECORD", "Samples", "sample", "write_samples"]


@dataclass(frozen=True)
class Samples:
    """What a folder of samples holds."""

    shapes: int  # number of files
    unsound: int  # number of shapes that are not sound
    failed: int  # number of vectors without a shape
    failures: str  # why, in words


def sample(
    procedure: Procedure,
    count: int,
    seed: int = 0,
    workers: int | None = None,
    progress: Listener | None = None,
    *,
    like: str | Path | None = None,
    executor: Executor | None = None,
) -> list[Build]:
    """Shapes at ``count`` random parameter vectors: ``build.parameters``, ``build.shape``.

    ``build.failure`` says why where the shape is None. The same seed gives the same vectors. workers: processes, all
    cores by default. like: the folder of a run; what its references showed is drawn more often, see ``Likeness``.

    executor: builds on other machines, and changes nothing in the shapes: ``client.get_executor()`` of dask, one of
    ``concurrent.futures``, or whatever has ``submit(function, *args)`` and gives futures. ``workers`` says then how
    many build at the same time.

    Raises ProcedureError when the procedure cannot be loaded, RunError when a run shows nothing, ExecutorError when an
    executor loses the same work twice.
    """
    drawn = Drawn.of(procedure, count, seed, like=_likeness(like, procedure))
    stages = Stages(progress)
    stages.begin("sample", len(drawn.vectors))
    with Workers(procedure, workers, executor=executor) as crew:
        builds = crew.build(drawn.vectors, stages.step)
    stages.end()
    return builds


def write_samples(
    procedure: Procedure,
    count: int,
    folder: Path,
    format: FileFormat = "glb",
    seed: int = 0,
    workers: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    given: Mapping[str, Parameters] | None = None,
    shown: bool = False,
    *,
    shard: Shard | None = None,
    like: str | Path | None = None,
    parquet: bool = False,
    executor: Executor | None = None,
) -> Samples:
    """Write shapes at ``count`` random parameter vectors and a manifest of these with the soundness of each shape.

    given: parameters by the name of their file, in place of random ones. shown: see ``Workers``. shard: which part of
    the samples is written; all shards together hold to the bit what one folder of all would hold. like: see ``sample``.
    executor: see ``sample``; other machines make the files' contents as well, and this one writes them.
    parquet: whether the manifest is written as Parquet as well; a folder that has it keeps it.

    A folder that holds the first samples of the same procedure, seed and format is resumed. Drawings are written as
    SVG; they have no soundness. Raises RunError when the folder holds something else or cannot be written (what is
    there is then whole), ProcedureError when the procedure is broken.
    """
    parquet = parquet or (folder / tables.PARQUET).exists()
    if parquet:
        tables.check_installed()
    likeness = _likeness(like, procedure)
    drawn = Drawn.of(procedure, count, seed, given, shard, likeness)
    vectors, pack = drawn.vectors, packing(format)
    record = manifest.record_of(procedure, format, seed, given, likeness)
    form = Form(shape_format(format), {key: record[key] for key in ("procedure", "version", "seed")}, procedure.facts)
    if shard:
        record = manifest.of_shard(record, shard, drawn.count, len(vectors))
    columns = manifest.header(procedure.space.names)
    failed: list[Build] = []
    try:
        rows = _kept(manifest.resume(folder, record, columns, vectors), drawn.start, len(vectors), pack)
        first = listed = len(rows)

        def step(done: int) -> None:
            if progress:
                progress(first + done, len(vectors))

        with (
            Workers(procedure, workers, shown=shown, executor=executor) as crew,
            closing(
                crew.make(
                    vectors[first:],
                    partial(made, form=form),
                    step,
                    give_up=drawn.start + first == 0,
                    wave=pack.size,
                )
            ) as samples,
        ):
            while len(rows) < len(vectors):
                number, before = divmod(drawn.start + len(rows), pack.size)
                chunk = list(islice(samples, pack.size - before))
                failed += [Build(one.parameters, None, one.failure) for one in chunk if one.failure]
                names = drawn.names[len(rows) : len(rows) + len(chunk)]
                paths = pack.write(folder, procedure.name, number, form, list(zip(names, chunk, strict=True)))
                rows += map(manifest.row, chunk, paths)
                if len(rows) == len(vectors) or len(rows) - listed >= listed // 8:  # so listing costs little
                    manifest.write(folder, columns, rows)
                    listed = len(rows)
        if parquet:
            tables.write(folder, tables.types_of(procedure.space))
    except OSError as error:
        raise RunError(
            f"{folder}: cannot be written: {error.strerror or error}; the shapes in its manifest are whole: "
            "repeat the command to go on"
        ) from error
    except ExecutorError as error:
        raise RunError(f"{folder}: {error} to go on: the shapes in its manifest are whole") from error
    written = [row for row in rows if row[0]]
    unsound = sum(row[columns.index("sound")] == "False" for row in written)
    failures = describe_failures(failed) if failed else ""
    return Samples(len(written), unsound, len(rows) - len(written), failures)


def _likeness(run: str | Path | None, procedure: Procedure) -> Likeness | None:
    return None if run is None else Likeness.of_run(Path(run).expanduser(), procedure.space)


def _kept(rows: list[Row], start: int, count: int, pack: Packing) -> list[Row]:
    """The rows of samples that are not written again: a tar that is not full is."""
    if not pack.whole or len(rows) == count:
        return rows
    return rows[: max(0, (start + len(rows)) // pack.size * pack.size - start)]
