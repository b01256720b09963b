"""Random shapes of a procedure, in memory, or written as files: thousands of them, in parallel, and resumed.

The folder holds one file a shape, ``manifest.csv`` with a row for every parameter vector, and
``manifest.samples.json``, which says what the samples are of. A file is whole or not there, and the manifest never
names one that is not.
"""

from __future__ import annotations

import csv
import hashlib
import io
import json
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from functools import partial
from pathlib import Path
from typing import Any

from shapewright.building import Build, Workers, describe_failures
from shapewright.parameters import Parameters
from shapewright.procedures import Facts, Procedure, source_digest
from shapewright.progress import Listener, Stages
from shapewright.runs.folder import RunError, check_free
from shapewright.runs.versions import version_of
from shapewright.shapes import Drawing, Mesh
from shapewright.shapes.files import Format, encode
from shapewright.shapes.soundness import Soundness
from shapewright.storage import remove_leftovers, whole_file, write_file
from shapewright.threads import cores

MANIFEST, RECORD = "manifest.csv", "manifest.samples.json"
_FORMAT = 1
_CHUNK = 256
"""Shapes after which the manifest is written, at least; an eighth of those before, so that this costs little."""
_MEASURES = tuple(field.name for field in fields(Soundness))
COLUMNS = ("path", "sound", *_MEASURES, "failure")
"""Columns of a manifest that are no parameters."""


@dataclass(frozen=True)
class Samples:
    """What a folder of samples holds."""

    shapes: int  # number of files
    unsound: int  # number of shapes that are not sound
    failed: int  # number of vectors without a shape
    failures: str  # why, in words


def sample(
    procedure: Procedure, count: int, seed: int = 0, workers: int | None = None, progress: Listener | None = None
) -> list[Build]:
    """Shapes at ``count`` random parameter vectors: ``build.parameters``, ``build.shape``.

    ``build.failure`` says why where the shape is None. The same seed gives the same vectors. workers: processes, all
    cores by default. Raises ProcedureError when the procedure cannot be loaded.
    """
    stages = Stages(progress)
    stages.begin("sample", count)
    with Workers(procedure, workers) as crew:
        builds = crew.build(procedure.space.sample(count, seed=seed), stages.step)
    stages.end()
    return builds


def write_samples(
    procedure: Procedure,
    count: int,
    folder: Path,
    format: Format = "glb",
    seed: int = 0,
    workers: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    given: Mapping[str, Parameters] | None = None,
    shown: bool = False,
) -> Samples:
    """Write shapes at ``count`` random parameter vectors and a manifest of these with the soundness of each shape.

    given: parameters by the name of their file, in place of random ones. shown: see ``Workers``.

    A folder that holds the first samples of the same procedure, seed and format is resumed. Drawings are written as
    SVG; they have no soundness. Raises RunError when the folder holds something else or cannot be written (what is
    there is then whole), ProcedureError when the procedure is broken.
    """
    if given is None:
        vectors = procedure.space.sample(count, seed=seed)
        names = [f"{procedure.name}-{i:05d}" for i in range(count)]
    else:
        vectors, names = list(given.values()), list(given)
    record = _record(procedure, format, seed, given)
    write = partial(_write_shape, folder, format=format, record=record, facts=procedure.facts)
    header = [COLUMNS[0], *procedure.space.names, *COLUMNS[1:]]
    rows: list[list[str]] = []

    def step(done: int, _: int) -> None:
        if progress:
            progress(len(rows) + done, len(vectors))

    try:
        rows = _resume(folder, record, vectors)
        failed: list[Build] = []
        with Workers(procedure, workers, shown=shown) as crew, ThreadPoolExecutor(workers or cores()) as pool:
            while len(rows) < len(vectors):
                chunk = vectors[len(rows) : len(rows) + max(_CHUNK, len(rows) // 8)]
                builds = crew.build(chunk, step, give_up=not rows)
                failed += [build for build in builds if build.failure]
                rows += pool.map(write, names[len(rows) : len(rows) + len(chunk)], builds)
                table = io.StringIO(newline="")
                csv.writer(table).writerows([header, *rows])
                write_file(folder / MANIFEST, table.getvalue())
    except OSError as error:
        raise RunError(
            f"{folder}: cannot be written: {error.strerror or error}; the shapes in its manifest are whole: "
            "repeat the command to go on"
        ) from error
    written = [row for row in rows if row[0]]
    unsound = sum(row[header.index("sound")] == "False" for row in written)
    failures = describe_failures(failed) if failed else ""
    return Samples(len(written), unsound, len(rows) - len(written), failures)


def _record(
    procedure: Procedure, format: str, seed: int, given: Mapping[str, Parameters] | None = None
) -> dict[str, Any]:
    """What ``RECORD`` holds. The digest is not that of runs: with another value no older folder could resume."""
    return {
        "format": _FORMAT,
        "procedure": procedure.name,
        "source": hashlib.blake2b(procedure.source.encode(), digest_size=8).hexdigest(),
        "files": format,
        "seed": seed,
        "version": version_of("shapewright"),
        **({} if given is None else {"parameters": source_digest(json.dumps(given))}),
    }


def _resume(folder: Path, record: dict[str, Any], vectors: Sequence[Parameters]) -> list[list[str]]:
    """The rows of the manifest that a folder has already; a new folder is begun."""
    if not (folder / RECORD).exists():
        check_free(folder)
        folder.mkdir(parents=True, exist_ok=True)
        write_file(folder / RECORD, json.dumps(record, indent=1))
    remove_leftovers(folder, age=0.0)
    try:
        begun = json.loads((folder / RECORD).read_text(encoding="utf-8"))
        lines = (folder / MANIFEST).read_text(encoding="utf-8") if (folder / MANIFEST).exists() else ""
    except ValueError as error:
        raise RunError(f"{folder / RECORD}: cannot be read: {error}") from error
    if begun != record:
        differing = ", ".join(key for key in record if begun.get(key) != record[key])
        raise RunError(f"{folder}: there are samples of another kind here (other {differing}); name another folder")
    rows = list(csv.reader(io.StringIO(lines)))[1:][: len(vectors)]
    for row, vector in zip(rows, vectors, strict=False):
        if row[1 : 1 + len(vector)] != [str(value) for value in vector.values()]:
            raise RunError(f"{folder}: its samples are not the first of these {len(vectors)}; name another folder")
    return rows


def _write_shape(
    folder: Path, name: str, build: Build, format: Format, record: dict[str, Any], facts: Facts
) -> list[str]:
    """Write one shape, in the procedure's axes but for GLB, which is Y up; returns its row of the manifest."""
    values, soundness = [str(value) for value in build.parameters.values()], [""] * (1 + len(_MEASURES))
    if build.shape is None:
        return ["", *values, *soundness, str(build.failure)]
    extras = {key: record[key] for key in ("procedure", "version", "seed")} | {"parameters": dict(build.parameters)}
    shape = build.shape if format == "glb" else facts.laid(build.shape)
    path = f"{name}.{'svg' if isinstance(build.shape, Drawing) else format}"
    with whole_file(folder / path) as partial:
        partial.write_bytes(encode(shape, format, extras | facts.stated, facts.metres))
    if isinstance(build.shape, Mesh):
        state = build.shape.soundness()
        soundness = [str(state.sound), *(str(getattr(state, name)) for name in _MEASURES)]
    return [path, *values, *soundness, ""]
