"""The judge: knows the references, and measures how far replicas are from them. Drawings have one of their own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shapewright.building import Build
from shapewright.comparison import light_field
from shapewright.comparison.depths import depth_difference
from shapewright.comparison.grouping import Group, group
from shapewright.comparison.leaders import LARGE, group_by_leaders
from shapewright.comparison.light_field.aligned import AlignedCost, nearest_field
from shapewright.comparison.overlap import intersection_over_union
from shapewright.comparison.surfaces import chamfer
from shapewright.judging import metric
from shapewright.judging.calibration import is_same
from shapewright.judging.picture_judge import PictureJudge
from shapewright.references import Collection
from shapewright.search.search import Measure
from shapewright.settings import Settings
from shapewright.shapes import Mesh, Shape
from shapewright.threads import in_threads

_DOUBT = 5.0
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def judge_of(references: Collection, settings: Settings, cache: Path | None = None) -> Judge | PictureJudge:
    """The judge of a collection of meshes or of drawings; cache: a folder that keeps the descriptors of meshes."""
    return (Judge if references.kind is Mesh else PictureJudge).of(references, settings, cache)


@dataclass(frozen=True, eq=False)
class Judge:
    """Measures replicas against the references of one collection, on several threads.

    descriptors: of the references; None for one so thin that no view shows it, which nothing can replicate.
    """

    references: Collection
    descriptors: tuple[light_field.Descriptor | None, ...]
    settings: Settings
    _targets: dict[tuple[int, int], AlignedCost] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, references: Collection, settings: Settings, cache: Path | None = None) -> Judge:
        """Describe the references; cache: a folder that keeps the descriptors."""
        shapes = [_mesh(reference.shape) for reference in references]
        return cls(references, tuple(_describe(shapes, settings.workers, cache)), settings)

    @property
    def metric(self) -> metric.Metric:
        return metric.light_field(self.settings.threshold)

    def distances(self, builds: Sequence[Build], rows: Sequence[int] | None = None) -> Floats:
        """Normalised light-field distance of one build for each reference, (N,); NaN where it cannot be measured.

        rows: indices of the references that the builds are for, all of them by default.
        """
        return self.nearest(builds, rows)[0]

    def nearest(self, builds: Sequence[Build], rows: Sequence[int] | None = None) -> tuple[Floats, Ints]:
        """Distances as above, and of each pair the light field in which it differs least: by that it is searched on."""
        described = _describe([_mesh(build.shape) for build in builds], self.settings.workers)
        theirs = self.descriptors if rows is None else [self.descriptors[i] for i in rows]
        pairs, align = list(zip(theirs, described, strict=True)), self.settings.align
        distances = [light_field.distance(a, b, align) if a and b else np.nan for a, b in pairs]
        return np.array(distances), np.array([nearest_field(a, b) if a and b else 0 for a, b in pairs], dtype=np.int64)

    def search_costs(self, pairs: Sequence[tuple[int, Shape]]) -> list[float]:
        """Costs to search by: of a replica against the reference with that index, in the pose that it has."""

        def cost(pair: tuple[int, Shape]) -> float:
            target, shape = self._target(pair[0], 0), pair[1]
            return target(shape) if target and isinstance(shape, Mesh) else np.inf

        return in_threads(cost, pairs, self.settings.workers)

    def measure(self, rows: Sequence[int] | Ints, fields: Sequence[int] | Ints | None = None) -> Measure:
        """What a search for some references goes by; it gets replicas with their references' places among ``rows``.

        The vectors' sums of absolute values are about the costs of ``search_costs``, and what differs in depth. fields:
        the light field to go by for each, the first by default.
        """

        def residual(pair: tuple[int, Shape]) -> Floats | None:
            i, shape = pair
            target = self._target(int(rows[i]), 0 if fields is None else int(fields[i]))
            return target.residual(shape) if target and isinstance(shape, Mesh) else None

        return lambda pairs: in_threads(residual, pairs, self.settings.workers)

    @property
    def search_parts(self) -> tuple[slice, ...]:
        """What a search goes by: all of the residuals."""
        return (slice(None),)

    @property
    def search_enough(self) -> float:
        """A cost at which a search may end: there is none."""
        return -np.inf

    @property
    def search_doubt(self) -> float:
        """What it costs a search to choose something unlikely: far less than a difference that can be seen."""
        return _DOUBT

    def _target(self, row: int, field: int) -> AlignedCost | None:
        """The cost against one reference in one light field, made once; None where it cannot be compared."""
        reference = _mesh(self.references.references[row].shape)
        if reference is None or self.descriptors[row] is None:
            return None
        if (row, field) not in self._targets:
            self._targets[row, field] = AlignedCost(reference, field)
        return self._targets[row, field]

    @property
    def goal(self) -> float:
        """The cost up to which a replica is surely compatible."""
        return self.settings.threshold * light_field.RAW_SCALE

    def overlaps(self, builds: Sequence[Build]) -> tuple[Floats, Floats]:
        """IoU of silhouettes and Chamfer distance of one build for each reference; NaN where there is no mesh."""
        iou, surface = np.full(len(builds), np.nan), np.full(len(builds), np.nan)
        rows = [i for i, build in enumerate(builds) if _mesh(build.shape) and self.descriptors[i]]
        theirs = [mesh for i in rows if (mesh := _mesh(self.references.references[i].shape))]
        ours = [mesh for i in rows if (mesh := _mesh(builds[i].shape))]
        iou[rows] = intersection_over_union(theirs, ours, threads=self.settings.workers)
        seed = self.settings.seed
        surface[rows] = in_threads(
            lambda pair: chamfer(*pair, seed=seed), list(zip(theirs, ours, strict=True)), self.settings.workers
        )
        return iou, surface

    def depths(self, builds: Sequence[Build]) -> Floats:
        """Difference of depth pictures of one build for each reference, (N,); NaN where there is no mesh."""
        depth = np.full(len(builds), np.nan)
        rows = [i for i, build in enumerate(builds) if _mesh(build.shape) and self.descriptors[i]]
        ours = [mesh for i in rows if (mesh := _mesh(builds[i].shape))]
        theirs = [mesh for i in rows if (mesh := _mesh(self.references.references[i].shape))]
        depth[rows] = depth_difference(theirs, ours, threads=self.settings.workers)
        return depth

    def compatible(self, distances: Floats, iou: Floats, depth: Floats) -> NDArray[np.bool_]:
        """Which pairs count as the same: by the metric, where the settings have one, else by the threshold."""
        learned = self.settings.metric
        if learned is None:
            return np.asarray(distances <= self.settings.threshold)
        return np.array([is_same(learned, *row) for row in zip(distances, iou, depth, strict=True)], dtype=bool)

    def groups(self, compatible: NDArray[np.bool_]) -> tuple[Group, ...]:
        """The references that are not compatible, by likeness to each other."""
        rows = [i for i, d in enumerate(self.descriptors) if d and not compatible[i]]
        misfits = [d for i in rows if (d := self.descriptors[i])]
        names, settings = [self.references.names[i] for i in rows], self.settings
        if len(rows) <= LARGE:
            apart = light_field.distances(misfits, align=settings.align, threads=settings.workers)
            return group(names, apart, settings.cut, settings.cut_absolute)

        def between(some: Sequence[int], others: Sequence[int]) -> Floats:
            ours, theirs = [misfits[i] for i in some], [misfits[i] for i in others]
            return light_field.distances(ours, theirs, settings.align, 1)

        return group_by_leaders(names, between, settings.cut, settings.cut_absolute, threads=settings.workers)


def _mesh(shape: Shape | None) -> Mesh | None:
    return shape if isinstance(shape, Mesh) else None


def _describe(
    shapes: Iterable[Mesh | None], threads: int | None, cache: Path | None = None
) -> list[light_field.Descriptor | None]:
    def describe(mesh: Mesh | None) -> light_field.Descriptor | None:
        try:
            return light_field.descriptor(mesh, cache=cache) if mesh else None
        except ValueError:
            return None

    return in_threads(describe, list(shapes), threads)
