"""Samples of a procedure that builds slowly, kept between runs and used again where they still hold."""

from __future__ import annotations

import ast
import hashlib
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Protocol, TypeAlias

import numpy as np

from shapewright.building import Build, Workers
from shapewright.fitting.pacing.filing import LEAST_SECONDS, read, tidy, write
from shapewright.parameters import Parameters, Value
from shapewright.procedures import Procedure
from shapewright.progress import Notice
from shapewright.shapes import Mesh, Shape, shape_digest
from shapewright.shapes.conversion.libraries import kernel
from shapewright.versions import version_of

_PROBED = 16
"""Samples that are built anew after an edit, besides: at least."""
_PROBED_MOST = 48
"""And at most, where parameters have many classes."""
_WAVE, _WAVE_SECONDS = 256, 20.0
"""Samples that are built before they are put where they are kept: at first, and later as many as take so long."""
_PROGRAM = ".toml"
"""Suffix of procedures that another program builds, whose text is not known here: each run builds these samples."""

Key: TypeAlias = tuple[Value, ...]


class Pieces(Protocol):
    """Where samples of a run are kept until it is finished."""

    def builds(self) -> Iterable[Build]:
        """Those of an earlier try."""

    def put(self, builds: Sequence[Build], seconds: float) -> None:
        """Keep some that took so long together."""


class Stock:
    """Builds of samples: those of this run, and those that a folder keeps of runs before.

    Kept samples are used only where a run asks for the same parameters, and while the procedure builds the same. It is
    said to when the first samples of a run, built anew, equal the kept ones to the bit, and the text of the procedure
    and of what it imports from its folder is the same but for comments and layout. After another edit 16 to 48 more are
    built anew, among them one for each class of each parameter; all must be equal, or nothing is used again.
    """

    def __init__(
        self,
        crew: Workers,
        folder: Path | None = None,
        first: Sequence[Build] = (),
        pieces: Pieces | None = None,
    ) -> None:
        """folder: where samples are kept; without one, or without a file of the procedure, none are.

        first: the first samples of this run, where they are built already. pieces: where samples are put while others
        are built, and those that an earlier try of this run has put there.
        """
        self.crew = crew
        self.probes: list[Build] = []
        self._first = list(first)
        self._path: Path | None = None
        self._pieces = pieces
        self._built: dict[Key, Build] = {_key(b.parameters): b for b in (pieces.builds() if pieces else ())}
        self._kept: dict[Key, Build] = {}
        self._digest = ""
        self._same = False
        procedure = crew.procedure
        if folder and procedure.path:
            name = hashlib.sha256(f"{procedure.path}:{procedure.name}".encode()).hexdigest()[:20]
            self._path = folder / "samples" / f"{name}.npz"
            self._digest = text_digest(procedure)  # of what is loaded: the author may save the file during a run
            digest, builds = read(self._path)
            names = list(procedure.space.names)
            self._kept = {_key(build.parameters): build for build in builds if list(build.parameters) == names}
            self._same = digest == self._digest and procedure.path.suffix != _PROGRAM

    def fresh(self, vectors: Sequence[Parameters], progress: Callable[[int, int], None] | None = None) -> list[Build]:
        """Build the first samples of a run, and forget what was kept where it is not the same any more.

        Raises ProcedureError where the procedure is broken.
        """
        there = [build.parameters for build in self._first] == list(vectors)
        builds = self._first if there else self.crew.build(vectors, progress, give_up=True)
        self._take(builds)
        self.probes = builds
        return builds

    def build_anew(self) -> None:
        """Use none of those that an earlier try of this run has built."""
        self._built = {_key(build.parameters): build for build in self.probes}

    def hold(self, vectors: Sequence[Parameters], seed: int) -> Notice | None:
        """Before the samples of a run: build some that are kept anew, where the text was edited.

        Returns what to tell where kept ones are used.
        """
        asked = [vector for vector in vectors if _key(vector) in self._kept and _key(vector) not in self._built]
        if asked and not self._same:
            self._take(self.crew.build(_probes(asked, self.crew.procedure, seed)))
        found = sum(_key(vector) in self._kept for vector in asked)
        return Notice("kept", f"{found:,} samples of an earlier run are used again") if found else None

    def build(
        self,
        vectors: Sequence[Parameters],
        progress: Callable[[int, int], None] | None = None,
        give_up: bool = False,
    ) -> list[Build]:
        """Builds of all vectors, of which those that are known are not built again. give_up: as of ``Workers``."""
        known = {**self._kept, **self._built}
        missing = [vector for vector in vectors if _key(vector) not in known]
        have = len(vectors) - len(missing)
        step = progress and (lambda done, _: progress(have + done, len(vectors)))
        for build in self._new(missing, step, give_up and not known):
            self._built[_key(build.parameters)] = build
        known |= self._built
        return [known[_key(vector)] for vector in vectors]

    def _new(
        self, vectors: Sequence[Parameters], progress: Callable[[int, int], None] | None, give_up: bool
    ) -> Iterator[Build]:
        """Builds of all vectors, some at a time, so that those which took long are put where they are kept."""
        size, done = _WAVE if self._pieces else max(len(vectors), 1), 0
        while done < len(vectors):
            begun = time.perf_counter()

            def step(more: int, _: int, before: int = done) -> None:
                if progress:
                    progress(before + more, len(vectors))

            builds = self.crew.build(vectors[done : done + size], step, give_up and not done)
            yield from builds
            done += size
            if self._pieces:
                seconds = time.perf_counter() - begun
                self._pieces.put(builds, seconds)
                size = min(max(int(size * _WAVE_SECONDS / max(seconds, 1e-6)), _WAVE), 4 * size)

    def forget(self) -> None:
        """Neither use nor keep any: the procedure builds other shapes from the same parameters."""
        self._kept, self._path = {}, None

    def keep(self) -> None:
        """Put the samples into the folder, where building them took long."""
        made = [build for build in self._built.values() if build.shape is not None]
        if self._path is None or not made:
            return
        if np.mean([build.seconds for build in made]) >= LEAST_SECONDS:
            write(self._path, self._digest, list({**self._kept, **self._built}.values()))
            tidy(self._path.parent)

    def _take(self, builds: Sequence[Build]) -> None:
        """New builds; kept ones go where one of them is not equal."""
        for build in builds:
            old = self._kept.get(_key(build.parameters))
            self._built[_key(build.parameters)] = build
            if old and not _equal(old, build):
                self._kept = {}


def text_digest(procedure: Procedure) -> str:
    """Of all that decides what a procedure builds, as far as it is in files of its folder and in this package.

    Comments and layout of Python do not count.
    """
    texts = [procedure.source.encode(), *(file.read_bytes() for file in procedure.helpers if file.is_file())]
    parts = [_meaning(text) for text in texts]
    parts += [
        repr(procedure.facts),
        repr((kernel.TESSELLATION, kernel.ANGLE, kernel.ANGLE_DRAWN)),
        version_of("shapewright"),
    ]
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def _meaning(text: bytes) -> str:
    try:
        return ast.dump(ast.parse(text))
    except (SyntaxError, ValueError):
        return hashlib.sha256(text).hexdigest()


def _key(parameters: Parameters) -> Key:
    return tuple(parameters.values())


def _equal(one: Build, other: Build) -> bool:
    if one.shape is None or other.shape is None:
        return one.shape is other.shape and one.failure == other.failure
    return _bits(one.shape) == _bits(other.shape)


def _bits(shape: Shape) -> tuple[object, ...]:
    named = (shape.labels, shape.rules) if isinstance(shape, Mesh) else ()
    return (type(shape), shape_digest(shape), *named)


def _probes(vectors: Sequence[Parameters], procedure: Procedure, seed: int) -> list[Parameters]:
    """Some of the vectors, drawn by the seed: one of each class of each parameter first."""
    drawn = [vectors[i] for i in np.random.default_rng(seed).permutation(len(vectors))]
    classes = [parameter.name for parameter in procedure.space if parameter.classes]
    seen: set[tuple[str, Value]] = set()
    chosen: list[Parameters] = []
    for vector in drawn:
        new = {(name, vector[name]) for name in classes} - seen
        if new and len(chosen) < _PROBED_MOST:
            seen |= new
            chosen.append(vector)
    others = [vector for vector in drawn if vector not in chosen]
    return chosen + others[: max(0, _PROBED - len(chosen))]
