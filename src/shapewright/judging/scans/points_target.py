"""Points to measure replicas against: what was scanned has to be there, and what was not scanned says nothing."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from shapewright.comparison import light_field
from shapewright.comparison.grouping import Group
from shapewright.comparison.scans.laid import LOOSE, lay
from shapewright.comparison.scans.scan import Scan
from shapewright.comparison.scans.scan_difference import ScanDifference
from shapewright.judging.mesh_target import Described, MeshTarget, grouped
from shapewright.judging.paper import Metric
from shapewright.judging.scans.likeness import likeness
from shapewright.judging.scans.shortfall import compare, regions
from shapewright.judging.target import Measures
from shapewright.judging.verdict import Evidence, Grade, grade_by
from shapewright.rendering.splats import discs
from shapewright.settings import Settings
from shapewright.shapes import Floats, Mesh, Points, Shape

_THRESHOLD, _FAR = 0.006, 0.03
"""Mean distances of a scan to its replica up to which they count as the same, and from which on they have nothing in
common. Both are set by hand: the fidelity decides, the distance is shown beside."""
_GOAL, REACH = 250.0, 6.0
"""Of the cost of a search: less is noise alone; and see ``Criterion``. By pictures of 64 samples ten chairs and tables
cost 160 to 530 themselves, 180 to 980 with every scalar 2 % off, and 350 to 1,200 with 5 % off."""


class PointsTarget:
    """One scan. See ``Target``, and ``MeshTarget`` for how it is kept.

    A search goes by the sides that the scan was seen from, which ``nearest`` finds, so they stand for its light field.
    The paper measures meshes alone; the distance is that of the points to the replica's surface.
    """

    parts = (slice(None),)
    enough = -np.inf
    goal = _GOAL
    surprise_cost = MeshTarget.surprise_cost
    metric = Metric("distance of the points", _THRESHOLD, _FAR, f"points lie {_THRESHOLD:g} of the size apart at most")

    def __init__(self, shape: Points, settings: Settings) -> None:
        self.shape, self._settings = shape, settings
        self._scan = functools.cache(functools.partial(_scan, shape, settings.seed))
        self._describe = functools.cache(functools.partial(_descriptor, shape))
        self._difference = functools.cache(self._made)

    def __reduce__(self) -> tuple[Any, ...]:
        return PointsTarget, (self.shape, self._settings)

    @property
    def descriptor(self) -> light_field.Descriptor | None:
        """Of discs in place of the points: the likeness of scans groups them."""
        return self._describe()

    @property
    def visible(self) -> bool:
        return self._scan() is not None

    def objective(self, field: int = 0) -> ScanDifference | None:
        """field: the sides that ``nearest`` found."""
        return self._difference(field) if self.visible else None

    def cost(self, replica: Shape) -> float:
        scan = self._scan()
        if scan is None or not isinstance(replica, Mesh):
            return np.inf
        return self._difference(self.nearest(replica)[1])(replica)

    def nearest(self, replica: Shape | None) -> tuple[float, int]:
        """The mean distance of the points to the replica; and the sides that they were seen from, if it is right."""
        scan = self._scan()
        if scan is None or not isinstance(replica, Mesh):
            return math.nan, 0
        try:
            laid = lay(scan, replica, LOOSE)
        except ValueError:
            return math.nan, 0
        return float(laid.missing.mean()), laid.sides

    def fidelity(self, replica: Shape | None) -> float:
        return self.evidence(replica).value

    def evidence(self, replica: Shape | None) -> Evidence:
        scan = self._scan()
        if scan is None or not isinstance(replica, Mesh):
            return Evidence(math.nan)
        try:
            compared = compare(scan, replica)
        except ValueError:
            return Evidence(math.nan)
        return Evidence(likeness(compared.shortfall), *regions(scan, compared))

    def measures(self, replica: Shape | None, distance: float | None = None, fidelity: float | None = None) -> Measures:
        """One-sided: of the points alone. The overlap of silhouettes, of depths and of volumes cannot be measured."""
        scan = self._scan()
        distance = self.nearest(replica)[0] if distance is None else distance
        if math.isnan(distance) or scan is None or not isinstance(replica, Mesh):
            return Measures()
        missing = lay(scan, replica).missing
        return Measures(
            distance,
            chamfer=float(missing.mean()),
            fidelity=self.fidelity(replica) if fidelity is None else fidelity,
            f1=float((missing <= 0.01).mean()),
            f2=float((missing <= 0.02).mean()),
        )

    def compatible(self, measures: Measures) -> bool:
        return self.metric.accepts(measures.distance)

    def grade(self, measures: Measures) -> Grade:
        return grade_by(self._settings, measures.fidelity, self.compatible(measures))

    @classmethod
    def groups(
        cls, names: Sequence[str], targets: Sequence[Described], settings: Settings, left: Floats | None = None
    ) -> tuple[Group, ...]:
        return grouped(names, targets, settings, left)

    def _made(self, sides: int) -> ScanDifference:
        scan = self._scan()
        assert scan is not None
        return ScanDifference(scan, sides)


def _scan(points: Points, seed: int) -> Scan | None:
    """None for too few points."""
    try:
        scan = Scan.of(points.normalised(), seed)
    except ValueError:
        return None
    _ = scan.tree
    return scan


def _descriptor(points: Points) -> light_field.Descriptor | None:
    try:
        return light_field.descriptor(discs(points.normalised()))
    except ValueError:
        return None
