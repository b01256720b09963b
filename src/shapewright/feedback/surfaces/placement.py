"""Laying a replica over its reference, where a part that one of them lacks has moved its bounding box."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.shapes import Floats, Mesh, Shape, Transform

FURTHEST = 0.05
"""Distances beyond count as this: what has no counterpart must not pull."""
UNIT = 100.0
"""A residual of FURTHEST, for a search that takes a fifth of that as small."""
# Where nothing else is said, chosen on seed 0 of benchmarks/causes.py.
_POINTS, _OVERLAID, _DRAWN = 160, 300, 1000  # of a surface: to place it, and of both that an overlay compares
_CLOSE = 0.006  # mean distance at which no other place is tried
_BETTER = 0.85  # what another place must reach of the cost in the middle
_SAME = 0.01  # difference of scales, and half that of extents, that are one
_SCALES = (0.4, 2.5)  # of a replica: another is not laid over its reference


@dataclass(frozen=True)
class Fit:
    """How one bounding box is laid over another."""

    axis: int | None = None  # along which both are made equally long; None leaves them as they are normalised
    anchors: tuple[float, float, float] = (0.5, 0.5, 0.5)  # per axis what coincides: lower sides at 0, upper ones at 1

    def transform(self, theirs: Floats, ours: Floats) -> Transform:
        """The transform of a replica with bounds ``ours``, (2, 3), onto a reference with bounds ``theirs``, (2, 3)."""
        extent, own = theirs[1] - theirs[0], np.maximum(ours[1] - ours[0], 1e-6)
        scale = 1.0 if self.axis is None else float(extent[self.axis] / own[self.axis])
        anchors = np.array(self.anchors)
        shift = theirs[0] + anchors * extent - scale * (ours[0] + anchors * own)
        return Transform(tuple(float(value) for value in -shift / scale), scale)


MIDDLE = Fit()


def place(reference: VisibleSurface, replica: VisibleSurface) -> Transform:
    """The scale and shift of a normalised replica under which the two surfaces are nearest to each other."""
    return best_fit(reference, replica).transform(_bounds(reference), _bounds(replica))


def best_fit(reference: VisibleSurface, replica: VisibleSurface) -> Fit:
    """How a normalised replica is laid over its reference so that the two surfaces are nearest to each other.

    Tried are, per axis, equal extents, and lower sides, middles and upper sides that coincide.
    """
    bounds, own = _bounds(reference), _bounds(replica)
    theirs, ours = _thinned(reference), _thinned(replica)

    def cost(fit: Fit) -> float:
        return float(_gaps(reference, replica, theirs, ours, fit.transform(bounds, own)).mean())

    best, least = MIDDLE, cost(MIDDLE)
    if least < _CLOSE:
        return best
    least *= _BETTER
    for fit in _different(bounds, own):
        if (apart := cost(fit)) < least:
            best, least = fit, apart
    return best


class Overlay:
    """How much of a reference's surface and of its replicas' lies apart, in the best of a few placements.

    Unlike the light field distance it does not reward a replica that grows fat to make up for what it lacks: points
    further than FURTHEST count alike, so what the two have in common decides. That tells best which parts are missing.
    """

    def __init__(self, reference: VisibleSurface, replica: Mesh | None = None) -> None:
        """replica: one whose best fit is tried as well as the middle."""
        fits = [best_fit(reference, VisibleSurface.roughly(replica.normalised()))] if replica else []
        self._reference, self._points, self._bounds = reference, _thinned(reference, _OVERLAID), _bounds(reference)
        self._fits = tuple(dict.fromkeys([MIDDLE, *fits]))

    def __call__(self, replica: Mesh) -> float:
        """The cost, in units of the largest extent: 0 to FURTHEST; infinite for a replica without area."""
        residual = self.residual(replica)
        return np.inf if residual is None else float(residual.mean()) * FURTHEST / UNIT

    def residual(self, replica: Shape) -> Floats | None:
        """What the cost is the mean of, (K,): distances of points of both surfaces, UNIT for FURTHEST and beyond.

        None for a drawing, a replica without area, or one whose extents have next to nothing of the reference's.
        """
        if not isinstance(replica, Mesh):
            return None
        try:
            surface = VisibleSurface.roughly(replica.normalised(), _DRAWN)
        except ValueError:
            return None
        own = _bounds(surface)
        transforms = [fit.transform(self._bounds, own) for fit in self._fits]
        allowed = [t for t in transforms if _SCALES[0] < t.scale < _SCALES[1]]
        gaps = [_gaps(self._reference, surface, self._points, surface.points[::4], t) for t in allowed]
        return min(gaps, key=lambda distances: float(distances.sum())) * (UNIT / FURTHEST)


def _gaps(
    reference: VisibleSurface, replica: VisibleSurface, theirs: Floats, ours: Floats, transform: Transform
) -> Floats:
    """Distances there and back of points of two surfaces, none beyond FURTHEST; both sides count the same."""
    there = transform.scale * replica.nearness(transform.invert(theirs), FURTHEST / transform.scale)
    back = reference.nearness(transform.apply(ours), FURTHEST)
    half = (len(there) + len(back)) / 2.0
    return np.concatenate([there * (half / len(there)), back * (half / len(back))])


def _different(theirs: Floats, ours: Floats) -> Iterator[Fit]:
    """Fits whose scales differ, and whose shifts differ from each other's."""
    scales: list[float] = []
    for axis in (None, 0, 1, 2):
        scale = Fit(axis).transform(theirs, ours).scale
        if not _SCALES[0] < scale < _SCALES[1] or any(abs(scale - other) < _SAME for other in scales):
            continue
        scales.append(scale)
        slack = np.abs((theirs[1] - theirs[0]) - scale * (ours[1] - ours[0]))
        anchors = [(0.5, 0.0, 1.0) if gap > 2.0 * _SAME else (0.5,) for gap in slack]
        for x, y, z in product(*anchors):
            yield Fit(axis, (x, y, z))


def _thinned(surface: VisibleSurface, count: int = _POINTS) -> Floats:
    points = surface.points[surface.visible]
    return points[:: max(1, len(points) // count)]


def _bounds(surface: VisibleSurface) -> Floats:
    points = surface.points[surface.visible]
    return np.stack([points.min(axis=0), points.max(axis=0)])
