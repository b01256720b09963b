"""Searching on where an iteration gave up: longer inside the space, and beyond the Ranges that end too soon."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build, Workers
from shapewright.feedback.surfaces.placement import Overlay
from shapewright.judging.judge import Judge
from shapewright.parameters import End, Integer, Parameters, ParameterSpace, Scalar
from shapewright.prediction.lookup import nearest
from shapewright.rendering.raster import render
from shapewright.search.budgets import Budget, Round
from shapewright.search.search import Measure, refine
from shapewright.shapes import Floats, Mesh, Shape
from shapewright.threads import in_threads

Overlays = Mapping[int, Overlay]
Inferred = Sequence[NDArray[np.float32]]

_RIVAL = 1.25  # of the best combination's cost
LONGER = Budget((Round(8), Round(2, rival=_RIVAL), *(Round(1, 2, 5),) * 12), patience=1)
LAID = Budget(
    (Round(6), Round(2, rival=_RIVAL), Round(2, 2, 4, rival=_RIVAL), *(Round(1, 2, 5),) * 10),
    patience=2,
)
WIDE = Budget(
    (Round(1), Round(1), *(Round(1, 2, 5),) * 3, Round(1, afresh=True), *(Round(1, 2, 5),) * 5),
    patience=3,
)
RANDOM = 256
"""Random shapes among which the most similar to a reference is looked up."""
EVALUATIONS = 3_600
"""Shapes built for all references together, at most about: few misfits are searched for longer than many."""
_ENOUGH = 0.9  # of the threshold: in the pose they share, distances are upper bounds of what is judged
_CLOSE = 0.4  # of the threshold: beyond a Range the surfaces have to come together as well
_LEVEL = 0.1  # rise of the distance that is not worth a longer Range


@dataclass(frozen=True)
class Found:
    """The nearest shape that is known for a reference: its parameters, mesh and distance.

    parameters may lie outside the Ranges of the space. field: the light field in which it differs least.
    """

    parameters: Parameters
    mesh: Mesh
    distance: float
    field: int = 0


@dataclass(frozen=True, eq=False)
class Searcher:
    """Searches for many references of a collection at once; rows are their indices there."""

    space: ParameterSpace
    crew: Workers
    judge: Judge
    seed: int = 0

    @property
    def threshold(self) -> float:
        return self.judge.settings.threshold

    def placed(self, rows: Sequence[int], known: Sequence[Found]) -> list[Found]:
        """The same, with their light fields."""
        builds = [Build(found.parameters, found.mesh) for found in known]
        fields = self.judge.nearest(builds, rows)[1]
        return [replace(found, field=int(field)) for found, field in zip(known, fields, strict=True)]

    def longer(
        self, rows: Sequence[int], inferred: Inferred, known: Sequence[Found], budget: Budget | None = None
    ) -> list[Found]:
        """The nearest shapes inside the space. inferred: what the predictor says, for these rows."""
        vectors = refine(
            self.space,
            inferred,
            self.crew,
            self.judge.measure(rows, [found.field for found in known]),
            budget or self._within(LONGER, 0.45, len(rows)),
            self.seed,
            [found.parameters for found in known],
            spread=0.15,
            enough=_ENOUGH * self.judge.goal,
        )
        return self._nearer(rows, vectors, known)

    def laid(self, rows: Sequence[int], inferred: Inferred, known: Sequence[Found], overlays: Overlays) -> list[Found]:
        """The shapes inside the space whose surfaces have most in common with the references'.

        overlays: by row. A shape may be further away by the light field than what is known. The search starts from the
        most similar of some random shapes where that has more in common with the reference than what is known.
        """
        vectors = refine(
            self.space,
            inferred,
            self.crew,
            self._overlaid(rows, overlays),
            self._within(LAID, 0.55, len(rows)),
            self.seed,
            self._starts(rows, known, overlays),
            spread=0.2,
        )
        fresh = self.measured(rows, vectors)
        return [new or old for new, old in zip(fresh, known, strict=True)]

    def chosen(self, rows: Sequence[int], before: Sequence[Found], best: Sequence[Found]) -> list[Found]:
        """The same, with the choices of what was found before, where these do as well with the numbers found since."""
        best = list(best)
        choices = [parameter.name for parameter in self.space if not isinstance(parameter, Scalar)]
        tried = {}
        for i, (old, new) in enumerate(zip(before, best, strict=True)):
            kept = self.space.canonical({**new.parameters, **{name: old.parameters[name] for name in choices}})
            if new.distance <= self.threshold and kept != new.parameters:
                tried[i] = kept
        for i, found in zip(tried, self.measured([rows[i] for i in tried], list(tried.values())), strict=True):
            if found and found.distance <= self.threshold:
                best[i] = found
        return best

    def beyond(self, rows: Sequence[int], known: Sequence[Found]) -> list[Found]:
        """The nearest shapes when the Ranges are longer at the ends that the known parameters rest on.

        A parameter lies outside its Range only where that pays.
        """
        best, ends = list(known), [self.space.pressed(found.parameters) for found in known]
        todo = [i for i, free in enumerate(ends) if free]
        for _ in range(2):
            if not todo:
                break
            more = self._wide_search([rows[i] for i in todo], [best[i] for i in todo], [ends[i] for i in todo])
            again = []
            for i, found in zip(todo, more, strict=True):
                best[i] = found
                free = ends[i] | self.space.pressed(found.parameters)
                if free != ends[i] and found.distance > self.threshold:
                    again.append(i)
                ends[i] = free
            todo = again
        return self._pulled_back(rows, known, best)

    def measured(self, rows: Sequence[int], vectors: Sequence[Parameters]) -> list[Found | None]:
        """Build and judge one vector for each row; None where no shape can be built."""
        builds = self.crew.build(vectors)
        return [_found(*each) for each in zip(builds, *self.judge.nearest(builds, rows), strict=True)]

    def _wide_search(self, rows: Sequence[int], known: Sequence[Found], ends: Sequence[set[End]]) -> list[Found]:
        wide = self.space.widened()
        vectors = refine(
            wide,
            [_guess(wide, column, known, ends) for column in range(len(wide))],
            self.crew,
            self.judge.measure(rows, [found.field for found in known]),
            self._within(_with_integers(WIDE, self.space, ends), 0.4, len(rows)),
            self.seed,
            [found.parameters for found in known],
            within=self.space.limits(wide, ends),
            spread=0.06,
            enough=_ENOUGH * _CLOSE * self.judge.goal,
        )
        return self._nearer(rows, vectors, known)

    def _pulled_back(self, rows: Sequence[int], known: Sequence[Found], best: Sequence[Found]) -> list[Found]:
        """The same, with every parameter inside its Range again whose longer Range brings next to nothing."""
        best = list(best)
        names = [name for name in self.space.names if any(_outside(self.space, found, name) for found in best)]
        for name in names:
            some = [i for i, found in enumerate(best) if _outside(self.space, found, name)]
            tried = [self.space.clipped(best[i].parameters, [name]) for i in some]
            for i, found in zip(some, self.measured([rows[i] for i in some], tried), strict=True):
                if found and self._as_good(found.distance, best[i].distance, known[i].distance):
                    best[i] = found
        return best

    def _as_good(self, distance: float, wide: float, before: float) -> bool:
        if distance <= self.threshold:
            return True
        return wide > self.threshold and distance - wide <= _LEVEL * (before - wide)

    def _starts(self, rows: Sequence[int], known: Sequence[Found], overlays: Overlays) -> list[Parameters]:
        """What is known, or the most similar of some random shapes where more of the surfaces lies together."""
        builds = self.crew.build(self.space.sample(RANDOM, self.seed + 1))
        drawn = [(build.parameters, build.shape) for build in builds if isinstance(build.shape, Mesh)]
        if not drawn:
            return [found.parameters for found in known]
        theirs = [shape for row in rows if isinstance(shape := self.judge.references.references[row].shape, Mesh)]
        pictures = [
            render([mesh.normalised() for mesh in meshes], threads=self.judge.settings.workers)
            for meshes in (theirs, [mesh for _, mesh in drawn])
        ]
        alike = [drawn[i] for i in nearest(*pictures)]
        return [
            parameters if overlays[row](mesh) < overlays[row](found.mesh) else found.parameters
            for row, found, (parameters, mesh) in zip(rows, known, alike, strict=True)
        ]

    def _overlaid(self, rows: Sequence[int], overlays: Overlays) -> Measure:
        def residual(pair: tuple[int, Shape]) -> Floats | None:
            return overlays[rows[pair[0]]].residual(pair[1]) if isinstance(pair[1], Mesh) else None

        return lambda pairs: in_threads(residual, pairs, self.judge.settings.workers)

    def _within(self, budget: Budget, share: float, references: int) -> Budget:
        """What the references' part of a share of all evaluations pays for."""
        return budget.within(share * EVALUATIONS / max(references, 1), int(self.space.scalars.sum()))

    def _nearer(self, rows: Sequence[int], vectors: Sequence[Parameters], known: Sequence[Found]) -> list[Found]:
        """The nearer of what was known and what these vectors give."""
        best = list(known)
        moved = [i for i, (vector, old) in enumerate(zip(vectors, known, strict=True)) if vector != old.parameters]
        for i, new in zip(moved, self.measured([rows[i] for i in moved], [vectors[i] for i in moved]), strict=True):
            if new and new.distance < best[i].distance:
                best[i] = new
        return best


def _found(build: Build, distance: float, field: int) -> Found | None:
    if not isinstance(build.shape, Mesh) or np.isnan(distance):
        return None
    return Found(build.parameters, build.shape, float(distance), int(field))


def _outside(space: ParameterSpace, found: Found, name: str) -> bool:
    return any(excess.parameter == name for excess in space.outside(found.parameters))


def _with_integers(budget: Budget, space: ParameterSpace, ends: Sequence[set[End]]) -> Budget:
    """The same, with a combination more for each whole number that may go on."""
    more = max(sum(isinstance(space[name], Integer) for name, _ in free) for free in ends)
    first = replace(budget.rounds[0], combinations=budget.rounds[0].combinations + more)
    return replace(budget, rounds=(first, *budget.rounds[1:]))


def _guess(wide: ParameterSpace, column: int, known: Sequence[Found], ends: Sequence[set[End]]) -> NDArray[np.float32]:
    """What is known, in the form of a prediction; an integer that rests on an end of its Range may go on."""
    parameter = wide.parameters[column]
    values = np.array([parameter.encode(found.parameters[parameter.name]) for found in known], dtype=np.float32)
    if not parameter.classes:
        return values
    likely = np.full((len(known), parameter.classes), 1e-6, dtype=np.float32)
    for row, (value, free) in enumerate(zip(values.astype(int), ends, strict=True)):
        likely[row, value] = 1.0
        if isinstance(parameter, Integer):
            if (parameter.name, "low") in free and value > 0:
                likely[row, value - 1] = 0.1
            if (parameter.name, "high") in free and value + 1 < parameter.classes:
                likely[row, value + 1] = 0.1
    return likely
