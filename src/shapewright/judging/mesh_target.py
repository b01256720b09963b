"""A mesh to measure replicas against: light fields, silhouettes, depth and surfaces."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from shapewright.comparison import light_field, views, volumes
from shapewright.comparison.gaps import Surface
from shapewright.comparison.grouping import Group, group
from shapewright.comparison.leaders import LARGE, group_by_leaders
from shapewright.comparison.light_field.aligned import AlignedCost, nearest_field
from shapewright.comparison.light_field.cache import keep, known
from shapewright.comparison.posed import PosedDifference
from shapewright.comparison.remainders import CUT, mixed
from shapewright.judging.calibration import is_same
from shapewright.judging.fidelity import Fidelity
from shapewright.judging.paper import FAR, Metric, light_field_metric
from shapewright.judging.target import Measures, Target
from shapewright.judging.verdict import Evidence, Grade, grade_by
from shapewright.settings import Settings
from shapewright.shapes import Floats, Mesh, Shape

_GOAL = 1000.0
"""Of the cost by pictures in place. Of 324 replicas of vessels and houses that were labelled by eye 43 cost less: 36
good ones, 7 passable ones, none that is wrong."""
_FAR = FAR * Settings.threshold  # light-field distance from which on two references have nothing in common


class Described(Protocol):
    """What groups need of a target."""

    @property
    def descriptor(self) -> light_field.Descriptor | None: ...


class MeshTarget:
    """One mesh; cache: a folder that keeps descriptors. described: its descriptor, where it is known. See ``Target``.

    What takes time is kept by functools.cache, which lets threads make different things at the same time. A
    cached_property of Python 3.11 holds one lock for all objects of the class.
    """

    parts = (slice(None),)
    enough = -np.inf
    surprise_cost = 2.0  # a small hole costs 40; of 40 sampled shelves 5 keeps 2.7 % of the choices wrong, 2 1.7 %

    def __init__(
        self,
        shape: Mesh,
        settings: Settings,
        cache: Path | None = None,
        described: light_field.Descriptor | None = None,
    ) -> None:
        self.shape, self._settings, self._fidelity = shape, settings, Fidelity(shape)
        self._describe = functools.cache(functools.partial(_descriptor, shape, cache, described))
        self._surface = functools.cache(functools.partial(Surface, shape, settings.seed))
        self._volume = functools.cache(functools.partial(volumes.Volume.of, shape))
        self._aligned = functools.cache(functools.partial(AlignedCost, shape))
        self._posed = functools.cache(functools.partial(PosedDifference, shape))

    def __reduce__(self) -> tuple[Any, ...]:
        """It is sent with its descriptor, where that was made; what else takes time is made anew."""
        described = self._describe() if self._describe.cache_info().currsize else None
        return MeshTarget, (self.shape, self._settings, None, described)

    @property
    def descriptor(self) -> light_field.Descriptor | None:
        """None for a mesh so thin that no view shows it."""
        return self._describe()

    @property
    def visible(self) -> bool:
        return self.descriptor is not None

    @property
    def metric(self) -> Metric:
        return light_field_metric(self._settings.threshold)

    @property
    def goal(self) -> float:
        return _GOAL if self._settings.judge == "fidelity" else self._settings.threshold * light_field.RAW_SCALE

    def objective(self, field: int = 0) -> AlignedCost | PosedDifference | None:
        """What the judge sees: pictures in place, or the light field alone."""
        seen = self._posed if self._settings.judge == "fidelity" else self._aligned
        return seen(field) if self.visible else None

    def cost(self, replica: Shape) -> float:
        """An upper bound of the raw distance."""
        return self._aligned(0)(replica) if self.visible and isinstance(replica, Mesh) else np.inf

    def nearest(self, replica: Shape | None) -> tuple[float, int]:
        own, other = self.descriptor, _descriptor(replica) if isinstance(replica, Mesh) else None
        if own is None or other is None:
            return math.nan, 0
        return light_field.distance(own, other, self._settings.align), nearest_field(own, other)

    def fidelity(self, replica: Shape | None) -> float:
        return self._fidelity.value(replica) if self.visible else math.nan

    def evidence(self, replica: Shape | None) -> Evidence:
        return self._fidelity.evidence(replica) if self.visible else Evidence(math.nan)

    def measures(self, replica: Shape | None, distance: float | None = None, fidelity: float | None = None) -> Measures:
        distance = self.nearest(replica)[0] if distance is None else distance
        if math.isnan(distance) or not isinstance(replica, Mesh):
            return Measures()
        gaps = self._surface().gaps(Surface(replica, self._settings.seed))
        return Measures(
            distance,
            iou=views.intersection_over_union(self.shape, replica),
            chamfer=gaps.chamfer,
            depth=views.depth_difference(self.shape, replica),
            fidelity=self.fidelity(replica) if fidelity is None else fidelity,
            volume_iou=volumes.intersection_over_union(self._volume(), volumes.Volume.of(replica)),
            f1=gaps.f_score(0.01),
            f2=gaps.f_score(0.02),
        )

    def compatible(self, measures: Measures) -> bool:
        """By the metric where the settings have one, else by the threshold."""
        learned = self._settings.metric
        if learned is None:
            return self.metric.accepts(measures.distance)
        return is_same(learned, measures.distance, measures.iou, measures.depth)

    def grade(self, measures: Measures) -> Grade:
        return grade_by(self._settings, measures.fidelity, self.compatible(measures))

    @classmethod
    def groups(
        cls, names: Sequence[str], targets: Sequence[Described], settings: Settings, left: Floats | None = None
    ) -> tuple[Group, ...]:
        return grouped(names, targets, settings, left)


def described(
    targets: Sequence[Target],
    settings: Settings,
    each: Callable[
        [Callable[[Mesh], light_field.Descriptor | None], Sequence[Mesh]], list[light_field.Descriptor | None]
    ],
    cache: Path | None,
) -> tuple[Target, ...]:
    """The same targets, of which those of meshes know their descriptors; ``each`` makes those that are not kept yet."""
    meshes = [target.shape if isinstance(target, MeshTarget) else None for target in targets]
    found = [known(mesh, cache) if mesh and cache else None for mesh in meshes]
    missing = [i for i, (mesh, its) in enumerate(zip(meshes, found, strict=True)) if mesh and not its]
    for i, descriptor in zip(missing, each(_descriptor, [mesh for i in missing if (mesh := meshes[i])]), strict=True):
        found[i] = descriptor
        if descriptor and cache and (mesh := meshes[i]):
            keep(mesh, descriptor, cache)
    return tuple(
        MeshTarget(mesh, settings, cache, its) if mesh else target
        for target, mesh, its in zip(targets, meshes, found, strict=True)
    )


def grouped(
    names: Sequence[str], targets: Sequence[Described], settings: Settings, left: Floats | None = None
) -> tuple[Group, ...]:
    """See ``Target.groups``; of meshes and of points alike, so a collection may hold both."""
    described = [descriptor for target in targets if (descriptor := target.descriptor)]
    cut, absolute = (settings.cut, settings.cut_absolute) if left is None else (CUT * settings.cut, True)
    if len(names) <= LARGE:
        apart = light_field.distances(described, align=settings.align, threads=settings.workers)
        return group(names, apart if left is None else mixed(apart / _FAR, left, left), cut, absolute)

    def between(some: Sequence[int], others: Sequence[int]) -> Floats:
        rows, columns = [described[i] for i in some], [described[i] for i in others]
        apart = light_field.distances(rows, columns, settings.align, 1)
        return apart if left is None else mixed(apart / _FAR, left[some], left[others])

    return group_by_leaders(names, between, cut, absolute, threads=settings.workers)


def _descriptor(
    mesh: Mesh, cache: Path | None = None, described: light_field.Descriptor | None = None
) -> light_field.Descriptor | None:
    if described:
        return described
    try:
        return light_field.descriptor(mesh, cache=cache)
    except ValueError:
        return None
