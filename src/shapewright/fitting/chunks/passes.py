"""The passes of a fit over its references, chunk after chunk: what was known before, searches, and measures.

One chunk stays in memory. Of several each is written when it is done, and read again by the next pass.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from functools import cache, lru_cache, partial

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Workers
from shapewright.fitting.chunks.forms import MEASURED, REPLICAS, Measured
from shapewright.fitting.chunks.judges import Judges
from shapewright.fitting.keeping.unfinished import Unfinished
from shapewright.fitting.learning import Lesson
from shapewright.fitting.replicas import Replicas, Search, replicate, resume
from shapewright.fitting.start import Start
from shapewright.judging.judge import Judge
from shapewright.parameters import Parameters, Prediction
from shapewright.progress import AnswerKind, Stages
from shapewright.runs.folder import RunError
from shapewright.shapes import Shape


@dataclass(frozen=True, eq=False)
class Found:
    """What is found so far for a chunk of references.

    rows: their places.
    near: which replicas need no search, (N,).
    replicas: gives them.
    measured: gives what is measured of them.
    """

    rows: range
    near: NDArray[np.bool_]
    replicas: Callable[[], Replicas]
    measured: Callable[[], Measured]

    def shape(self, place: int) -> Shape | None:
        """One of the replicas."""
        build = self.replicas().builds[place]
        return build.shape if build else None


class Passes:
    """What all passes of a fit share."""

    def __init__(self, crew: Workers, judges: Judges, unfinished: Unfinished, stages: Stages) -> None:
        self._crew, self._judges, self._unfinished, self._stages = crew, judges, unfinished, stages
        self._read = lru_cache(maxsize=1)(self._kept)

    def known(self, start: Start) -> list[Found]:
        """The replicas of an earlier iteration, see ``replicas.resume``."""
        if not self._judges.many:
            self._judges.of(self._judges.chunks[0])
        if not start.resumed and not any(start.others):
            return [self._found("", rows, Replicas.none(len(rows))) for rows in self._judges.chunks]

        def made(rows: range) -> Replicas:
            return resume(start, self._crew, self._judges.of(rows), rows)

        return [self._made("known", rows, partial(made, rows)) for rows in self._judges.chunks]

    def searched(
        self,
        lesson: Lesson,
        before: Sequence[Found],
        number: int,
        last: bool,
        new: AbstractSet[str] | None = None,
    ) -> list[Found]:
        """Predicted, and searched for where no replica was near before.

        number: of the pass, from 0. last: whether the replicas are measured then, while their judge is there.
        """
        references, many = self._judges.references, self._judges.many
        rows = [np.flatnonzero(~each.near) for each in before]
        firsts = np.cumsum([0, *map(len, rows)]).tolist()
        budget = lesson.budget(self._judges.settings, firsts[-1])

        @cache
        def prediction() -> Prediction:
            self._stages.begin("predict", len(references))
            return lesson.predictor.infer([reference.shape for reference in references], references.extents)

        def made(place: int) -> Replicas:
            chunk = before[place].rows
            predicted = prediction().take(list(chunk)) if many else prediction()
            told = _Part(self._stages, place, len(before)) if many else self._stages
            search = Search(predicted, rows[place], firsts[place], firsts[-1], budget, new)
            return replicate(self._crew, self._judges.of(chunk), lesson, search, told, before[place].replicas())

        found = []
        for place, each in enumerate(before):
            found.append(self._made(f"search{number}", each.rows, partial(made, place)))
            if many:
                _Part(self._stages, place, len(before)).step(1, 1)
                if last:
                    found[-1].measured()
        return found

    def _made(self, name: str, rows: range, make: Callable[[], Replicas]) -> Found:
        """What a pass makes of a chunk, or has made of it before."""
        name = f"{name}-{rows.start:06d}-{rows.stop:06d}"
        return self._found(name, rows, self._unfinished.piece(name, REPLICAS, make, always=self._judges.many))

    def _found(self, name: str, rows: range, replicas: Replicas) -> Found:
        read = partial(self._read, name) if self._judges.many and name else partial(_itself, replicas)
        near = replicas.near(self._judges.settings, self._judges.metric)
        return Found(rows, near, read, partial(self._measured, rows, read))

    def _measured(self, rows: range, replicas: Callable[[], Replicas]) -> Measured:
        def made() -> Measured:
            return measured(self._judges.of(rows), replicas())

        name = f"measured-{rows.start:06d}-{rows.stop:06d}"
        return self._unfinished.piece(name, MEASURED, made, always=self._judges.many)

    def _kept(self, name: str) -> Replicas:
        replicas = self._unfinished.known(name, REPLICAS)
        if replicas is None:
            raise RunError("what this fit has kept on disk is gone: fit again")
        return replicas


def measured(judge: Judge, replicas: Replicas) -> Measured:
    """All that is measured of the replicas of a chunk."""
    builds = [build for build in replicas.builds if build]
    measures = judge.measures(builds, replicas.distances, replicas.evidence)
    compatible = judge.compatible(measures).tolist()
    return Measured(measures, judge.grades(measures), compatible, judge.places(builds))


@dataclass(frozen=True)
class _Part:
    """The search for one of several chunks, as a part of one stage; see ``Told``."""

    stages: Stages
    place: int
    count: int

    def begin(self, stage: str, total: int) -> None:
        """Each chunk has all stages of a search: they would follow each other too quickly."""

    def step(self, done: int, total: int) -> None:
        self.stages.begin("refine", total * self.count)
        self.stages.step(total * self.place + done, total * self.count)

    def answer(self, answer: Mapping[str, Parameters], kind: AnswerKind) -> None:
        self.stages.answer(answer, kind)


def _itself(replicas: Replicas) -> Replicas:
    return replicas
