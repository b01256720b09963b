"""Judges of some hundreds of references at a time: what describes all of many would not fit in the memory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from shapewright.building import Workers
from shapewright.comparison.grouping import Group
from shapewright.judging.judge import Judge, target_of
from shapewright.judging.paper import Metric
from shapewright.judging.verdict import Grade
from shapewright.references import Collection
from shapewright.runs.lazy import Lazy
from shapewright.settings import Settings
from shapewright.shapes import Shape

CHUNK = 256
"""References that are searched for at the same time. Each takes 3 MB meanwhile (docs/scale.md)."""


class Judges:
    """A judge for each chunk of references, made when it is asked for; the last one stays. crew: see ``Judge.of``.

    Attributes:
        references: all of them, turned as they are judged.
        settings: of every judge.
        chunks: places of references, as even as can be.
    """

    def __init__(
        self,
        references: Collection,
        settings: Settings,
        cache: Path | None = None,
        chunk: int = CHUNK,
        crew: Workers | None = None,
    ) -> None:
        self.references, self.settings = references, settings
        count = -(-len(references) // chunk)
        ends = np.linspace(0, len(references), count + 1).round().astype(int).tolist()
        self.chunks = [range(start, end) for start, end in pairwise(ends)]
        self._cache, self._crew = cache, crew
        self._last: tuple[range, Judge] | None = None

    @property
    def many(self) -> bool:
        """Whether there is more than one chunk."""
        return len(self.chunks) > 1

    @property
    def metric(self) -> Metric:
        """The paper's measure."""
        return target_of(self.references.references[0].shape, self.settings).metric

    def of(self, chunk: range) -> Judge:
        """The judge of a chunk."""
        if self._last is None or self._last[0] != chunk:
            self._last = None  # first, so that there are never two
            rows = chunk if self.many else None
            self._last = chunk, Judge.of(self.references, self.settings, self._cache, rows, self._crew)
        return self._last[1]

    def groups(self, grades: Sequence[Grade], replicas: Sequence[Shape | None]) -> tuple[Group, ...]:
        """The groups of all references that are not replicated, see ``Judge.groups``."""
        if not self.many:
            return self.of(self.chunks[0]).groups(grades, replicas)
        self._last = None
        rows = [row for row, grade in enumerate(grades) if grade != "replicated"]
        if not rows:
            return ()
        some = replace(self.references, references=tuple(self.references.references[row] for row in rows))
        judge = Judge.of(some, self.settings, self._cache, crew=self._crew)
        return judge.groups([grades[row] for row in rows], Lazy(len(rows), lambda place: replicas[rows[place]]))
