"""The judge: measures replicas against the references of one collection, and says which of them count as the same."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build, Workers
from shapewright.comparison.grouping import Group
from shapewright.comparison.remainders import remainder
from shapewright.judging.drawing_target import DrawingTarget
from shapewright.judging.mesh_target import MeshTarget, described
from shapewright.judging.paper import Metric
from shapewright.judging.scans.points_target import REACH, PointsTarget
from shapewright.judging.target import Measures, Sought, Target
from shapewright.judging.verdict import Evidence, Grade, Standing, Verdict, apart_of
from shapewright.judging.views.view_target import ViewTarget
from shapewright.references import Collection
from shapewright.search.objective import Criterion, Measure, Objective, measure_of
from shapewright.search.sizes import SizedObjective, likeness, parts_with_size
from shapewright.settings import Settings
from shapewright.shapes import Drawing, Floats, Ints, Mesh, Points, ReferenceShape, Shape, Views
from shapewright.shapes.conversion import as_reference, as_shape
from shapewright.shapes.shelf import fresh
from shapewright.threads import in_threads

Rows = Sequence[int] | Ints  # indices of references in their collection
Item = TypeVar("Item")
Result = TypeVar("Result")


def target_of(shape: ReferenceShape, settings: Settings, cache: Path | None = None, most: int = 1) -> Target:
    """What replicas are measured against. cache: a folder that keeps descriptors. most: see ``ViewTarget``."""
    if isinstance(shape, Views):
        return ViewTarget(shape, settings, most)
    if isinstance(shape, Points):
        return PointsTarget(shape, settings)
    return MeshTarget(shape, settings, cache) if isinstance(shape, Mesh) else DrawingTarget(shape, settings)


def fidelity(replica: Any, reference: Any, settings: Settings | None = None) -> Verdict:
    """How likely a person calls a replica the same as its reference, and where the two differ.

    Both are what a procedure may return, and are compared as they stand, after normalisation: neither is turned or
    mirrored. The reference may be points, too, or views of an object, which are compared from the cameras that suit
    the replica best. settings: the cuts of the grades, and the judge that grades. Raises TypeError for a drawing with
    another kind, ValueError for a shape that no picture shows.
    """
    replica, reference = as_shape(replica), as_reference(reference)
    if isinstance(replica, Drawing) != isinstance(reference, Drawing):
        raise TypeError("a mesh and a drawing cannot be compared; a drawing can be with drawings alone")
    target = target_of(reference, settings or Settings())
    found = target.evidence(replica)
    measures = target.measures(replica, fidelity=found.value)
    if math.isnan(measures.fidelity):
        raise ValueError("one of the shapes is so thin that no picture shows it")
    return Verdict(found.value, target.grade(measures), found.missing, found.surplus, measures.by_name())


@dataclass(frozen=True, eq=False)
class Judge:
    """Measures replicas against the references of one collection, on several threads."""

    references: Collection  # at least one
    targets: tuple[Target, ...]  # one for each reference
    settings: Settings  # threads, and what the targets were made with
    lead: Target  # says what holds for the whole collection, such as the goal
    sized: bool  # whether sizes count in the whole collection
    crew: Workers | None = None  # on whose machines it measures, where these are other ones

    @classmethod
    def of(
        cls,
        references: Collection,
        settings: Settings,
        cache: Path | None = None,
        rows: Rows | None = None,
        crew: Workers | None = None,
    ) -> Judge:
        """Describe the references, or some ``rows`` of them. A judge of some measures them as one of all does.

        cache: a folder that keeps the descriptors of meshes. crew: measures on other machines, if it builds there.
        """
        shapes = [reference.shape for reference in references]
        most = max((len(shape) for shape in shapes if isinstance(shape, Views)), default=1)
        some = references if rows is None else references.part(rows)
        targets = tuple(target_of(reference.shape, settings, cache, most) for reference in some)
        crew = crew if crew and crew.executor else None
        if crew:
            targets = described(targets, settings, crew.each, cache)
        in_threads(_visible, targets, settings.workers)
        is_whole = rows is None or (len(rows) > 0 and rows[0] == 0)
        lead = targets[0] if is_whole else target_of(shapes[0], settings, cache, most)
        return cls(some, targets, settings, lead, any(references.extents), crew)

    @property
    def metric(self) -> Metric:
        """By which references are compatible: the paper's measure."""
        return self.lead.metric

    @property
    def goal(self) -> float:
        """The cost up to which a replica is surely compatible, see ``Target``."""
        return self.lead.goal

    def standings(self, builds: Sequence[Build], rows: Rows | None = None) -> list[Standing]:
        """How near each build is to its reference, those of ``rows`` or all, by the judge of the settings."""
        near = zip(*self.nearest(builds, rows), strict=True)
        if self.settings.judge == "paper":
            least = self.metric.threshold
            return [Standing(float(apart), int(field), math.nan, float(apart) / least) for apart, field in near]
        values = self.fidelities([build.shape for build in builds], rows)
        return [
            Standing(float(distance), int(field), value, apart_of(value, self.settings))
            for (distance, field), value in zip(near, values, strict=True)
        ]

    def distances(self, builds: Sequence[Build], rows: Rows | None = None) -> Floats:
        """The distance of each build to its reference, those of ``rows`` or all: (N,); NaN where there is none."""
        return self.nearest(builds, rows)[0]

    def nearest(self, builds: Sequence[Build], rows: Rows | None = None) -> tuple[Floats, Ints]:
        """Distances as above, and of each pair the light field in which it differs least: by that it is searched on."""
        pairs = zip(self._targets(rows), builds, strict=True)
        found = self._each(_nearest, [(target, build.shape) for target, build in pairs])
        distances, fields = [distance for distance, _ in found], [field for _, field in found]
        return np.array(distances, dtype=np.float64), np.array(fields, dtype=np.int64)

    def fidelities(self, shapes: Sequence[Shape | None], rows: Rows | None = None) -> list[float]:
        """The fidelity of each shape to its reference, those of ``rows`` or all, without regions; NaN for none."""
        found = self._each(_fidelity, list(zip(self._targets(rows), shapes, strict=True)))
        return [value * same for value, same in zip(found, self._likenesses(shapes, rows), strict=True)]

    def evidence(self, builds: Sequence[Build], rows: Rows | None = None) -> list[Evidence]:
        """The fidelity of each build to its reference, those of ``rows`` or all, and where the two differ."""
        pairs = zip(self._targets(rows), builds, strict=True)
        found = self._each(_evidence, [(target, build.shape) for target, build in pairs])
        same = self._likenesses([build.shape for build in builds], rows)
        return [replace(each, value=each.value * likely) for each, likely in zip(found, same, strict=True)]

    def places(self, builds: Sequence[Build]) -> list[tuple[tuple[float, ...], ...]]:
        """From where each build is seen in the views of its reference, see ``Result``; nothing for other references."""
        if not self.references.in_views:
            return [()] * len(builds)
        pairs = zip(self.targets, builds, strict=True)
        return self._each(_place, [(target, build.shape) for target, build in pairs])

    def seen(self, builds: Sequence[Build]) -> tuple[Floats, Ints, list[Evidence]]:
        """``nearest`` and ``evidence`` of a build for each reference: what is made of a reference serves both."""
        shapes = [build.shape for build in builds]
        both = self._each(_seen, list(zip(self.targets, shapes, strict=True)))
        distances, fields = [distance for (distance, _), _ in both], [field for (_, field), _ in both]
        same = self._likenesses(shapes, None)
        evidence = [replace(each, value=each.value * likely) for (_, each), likely in zip(both, same, strict=True)]
        return np.array(distances, dtype=np.float64), np.array(fields, dtype=np.int64), evidence

    def measures(
        self, builds: Sequence[Build], distances: Floats, evidence: Sequence[Evidence] | None = None
    ) -> list[Measures]:
        """All that can be measured of one build for each reference. distances, (N,), and evidence are known already."""
        evidence = self.evidence(builds) if evidence is None and self.sized else evidence
        known = [None] * len(builds) if evidence is None else [each.value for each in evidence]
        each = zip(self.targets, [build.shape for build in builds], distances.tolist(), known, strict=True)
        return self._each(_measures, list(each))

    def search_costs(self, pairs: Sequence[tuple[int, Shape]]) -> list[float]:
        """Costs to search by: of a replica against the reference with that index, in the pose that it has."""
        return self._each(_cost, [(self.targets[row], shape) for row, shape in pairs])

    def measure(self, rows: Rows, fields: Rows | None = None) -> Measure:
        """The residuals for a search for some references; it gets replicas with their places among ``rows``.

        fields: the light field to go by for each, the first by default.
        """
        pairs = zip(self._targets(rows), np.zeros(len(rows), int) if fields is None else fields, strict=True)
        forms = [Sought(target, int(field)) for target, field in pairs]
        if not self.crew:  # two threads that need one at the same time would both make it
            in_threads(lambda form: form.made(), forms, self.settings.workers)
        objectives: list[Objective] = [
            SizedObjective(form, extent, self.lead.parts) if extent else form
            for form, extent in zip(forms, self._extents(rows), strict=True)
        ]
        return measure_of(objectives, self.settings.workers)

    def criterion(self, rows: Rows, fields: Rows | None = None) -> Criterion:
        """What a search for some references makes small, and how far; fields: as for ``measure``."""
        target = self.lead
        measure = self.measure(rows, fields)
        parts = parts_with_size(target.parts) if self.sized else target.parts
        reach = REACH if isinstance(target, PointsTarget) else 1.0
        return Criterion(measure, parts, target.goal, target.enough, target.surprise_cost, reach)

    def compatible(self, measures: Sequence[Measures]) -> NDArray[np.bool_]:
        """Which replicas count as the same as their references by the paper's measure, (N,)."""
        pairs = zip(self.targets, measures, strict=True)
        return np.array([target.compatible(each) for target, each in pairs], dtype=bool)

    def grades(self, measures: Sequence[Measures]) -> list[Grade]:
        """The grade of one replica for each reference, by the judge of the settings."""
        return [target.grade(each) for target, each in zip(self.targets, measures, strict=True)]

    def groups(self, grades: Sequence[Grade], replicas: Sequence[Shape | None] | None = None) -> tuple[Group, ...]:
        """The visible references that are not replicated, by likeness to each other.

        With replicas what is left between these and the references counts as well: a group lacks one thing. Where the
        paper judges, or the cut is a light-field distance, likeness alone counts. grades, replicas: of all.
        """
        pairs = enumerate(zip(self.targets, grades, strict=True))
        rows = [i for i, (target, grade) in pairs if target.visible and grade != "replicated"]
        names = [self.references.names[i] for i in rows]
        left = None
        fine = self.settings.judge != "paper" and not self.settings.cut_absolute and not self.references.in_views
        if replicas is not None and rows and fine:
            shapes = self.references.references

            def lacks(i: int) -> Floats:
                return _remainder((shapes[i].shape, replicas[i]))

            # One after the other: all replicas of a large run would not fit in the memory.
            here = self.crew is None
            found = (
                in_threads(lacks, rows, self.settings.workers)
                if here
                else self._each(_remainder, [(shapes[i].shape, replicas[i]) for i in rows])
            )
            left = np.stack(found)
        return type(self.targets[0]).groups(names, self._targets(rows), self.settings, left)

    def _each(self, function: Callable[[Item], Result], items: Sequence[Item]) -> list[Result]:
        return self.crew.each(function, items) if self.crew else in_threads(function, items, self.settings.workers)

    def _likenesses(self, shapes: Sequence[Shape | None], rows: Rows | None) -> list[float]:
        """How like the sizes of shapes are to those that they are to have: 1 where proportions count alone."""
        pairs = zip(shapes, self._extents(rows), strict=True)
        return [likeness(shape, extent) if extent else 1.0 for shape, extent in pairs]

    def _extents(self, rows: Rows | None) -> Sequence[float | None]:
        extents = self.references.extents
        return extents if rows is None else [extents[int(row)] for row in rows]

    def _targets(self, rows: Rows | None) -> Sequence[Target]:
        return self.targets if rows is None else [self.targets[int(row)] for row in rows]


# Functions of a module can be sent to other machines.


def _visible(target: Target) -> bool:
    return target.visible


def _nearest(pair: tuple[Target, Shape | None]) -> tuple[float, int]:
    return pair[0].nearest(pair[1])


def _fidelity(pair: tuple[Target, Shape | None]) -> float:
    return pair[0].fidelity(pair[1])


def _evidence(pair: tuple[Target, Shape | None]) -> Evidence:
    return pair[0].evidence(pair[1])


def _seen(pair: tuple[Target, Shape | None]) -> tuple[tuple[float, int], Evidence]:
    return _nearest(pair), _evidence(pair)


def _measures(one: tuple[Target, Shape | None, float, float | None]) -> Measures:
    return one[0].measures(*one[1:])


def _cost(pair: tuple[Target, Shape]) -> float:
    return pair[0].cost(pair[1])


def _remainder(pair: tuple[ReferenceShape, Shape | None]) -> Floats:
    return remainder(fresh(pair[0]), pair[1])


def _place(pair: tuple[Target, Shape | None]) -> tuple[tuple[float, ...], ...]:
    target, shape = pair
    found = target.in_view(shape) if isinstance(target, ViewTarget) else None
    return tuple(map(tuple, found.places.tolist())) if found else ()
