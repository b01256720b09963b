"""The judge: measures replicas against the references of one collection, and says which of them count as the same."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build
from shapewright.comparison.grouping import Group
from shapewright.judging.drawing_target import DrawingTarget
from shapewright.judging.mesh_target import MeshTarget
from shapewright.judging.paper import Metric
from shapewright.judging.target import Measures, Target
from shapewright.references import Collection
from shapewright.search.objective import Criterion, Measure, measure_of
from shapewright.settings import Settings
from shapewright.shapes import Floats, Ints, Mesh, Shape
from shapewright.threads import in_threads

Rows = Sequence[int] | Ints  # indices of references in their collection


def target_of(shape: Shape, settings: Settings, cache: Path | None = None) -> Target:
    """What replicas of a mesh or of a drawing are measured against; cache: a folder that keeps descriptors."""
    return MeshTarget(shape, settings, cache) if isinstance(shape, Mesh) else DrawingTarget(shape, settings)


@dataclass(frozen=True, eq=False)
class Judge:
    """Measures replicas against the references of one collection, on several threads."""

    references: Collection  # at least one
    targets: tuple[Target, ...]  # one for each reference
    settings: Settings  # threads, and what the targets were made with

    @classmethod
    def of(cls, references: Collection, settings: Settings, cache: Path | None = None) -> Judge:
        """Describe the references; cache: a folder that keeps the descriptors of meshes."""
        targets = tuple(target_of(reference.shape, settings, cache) for reference in references)
        in_threads(lambda target: target.visible, targets, settings.workers)
        return cls(references, targets, settings)

    @property
    def metric(self) -> Metric:
        """By which references are compatible."""
        return self.targets[0].metric

    @property
    def goal(self) -> float:
        """The cost up to which a replica is surely compatible, see ``Target``."""
        return self.targets[0].goal

    def distances(self, builds: Sequence[Build], rows: Rows | None = None) -> Floats:
        """The distance of each build to its reference, those of ``rows`` or all: (N,); NaN where there is none."""
        return self.nearest(builds, rows)[0]

    def nearest(self, builds: Sequence[Build], rows: Rows | None = None) -> tuple[Floats, Ints]:
        """Distances as above, and of each pair the light field in which it differs least: by that it is searched on."""
        pairs = zip(self._targets(rows), builds, strict=True)
        found = in_threads(lambda pair: pair[0].nearest(pair[1].shape), pairs, self.settings.workers)
        distances, fields = [distance for distance, _ in found], [field for _, field in found]
        return np.array(distances, dtype=np.float64), np.array(fields, dtype=np.int64)

    def measures(self, builds: Sequence[Build], distances: Floats) -> list[Measures]:
        """All that can be measured of one build for each reference, whose distances are known already, (N,)."""
        triples = zip(self.targets, builds, distances.tolist(), strict=True)
        return in_threads(lambda each: each[0].measures(each[1].shape, each[2]), triples, self.settings.workers)

    def search_costs(self, pairs: Sequence[tuple[int, Shape]]) -> list[float]:
        """Costs to search by: of a replica against the reference with that index, in the pose that it has."""
        return in_threads(lambda pair: self.targets[pair[0]].cost(pair[1]), pairs, self.settings.workers)

    def measure(self, rows: Rows, fields: Rows | None = None) -> Measure:
        """The residuals for a search for some references; it gets replicas with their places among ``rows``.

        fields: the light field to go by for each, the first by default.
        """
        pairs = zip(self._targets(rows), np.zeros(len(rows), int) if fields is None else fields, strict=True)
        objectives = in_threads(lambda pair: pair[0].objective(int(pair[1])), pairs, self.settings.workers)
        return measure_of(objectives, self.settings.workers)

    def criterion(self, rows: Rows, fields: Rows | None = None) -> Criterion:
        """What a search for some references makes small, and how far; fields: as for ``measure``."""
        target = self.targets[0]
        measure = self.measure(rows, fields)
        return Criterion(measure, target.parts, target.goal, target.enough, target.surprise_cost)

    def compatible(self, measures: Sequence[Measures]) -> NDArray[np.bool_]:
        """Which replicas count as the same as their references, (N,)."""
        pairs = zip(self.targets, measures, strict=True)
        return np.array([target.compatible(each) for target, each in pairs], dtype=bool)

    def groups(self, compatible: NDArray[np.bool_]) -> tuple[Group, ...]:
        """The visible references that are not compatible, by likeness to each other."""
        rows = [i for i, target in enumerate(self.targets) if target.visible and not compatible[i]]
        names = [self.references.names[i] for i in rows]
        return type(self.targets[0]).groups(names, self._targets(rows), self.settings)

    def _targets(self, rows: Rows | None) -> Sequence[Target]:
        return self.targets if rows is None else [self.targets[int(row)] for row in rows]
