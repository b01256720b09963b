"""The camera from which a mesh looks most as a picture shows its object, and what still differs there.

All of a bank of cameras is tried in coarse pictures. The best are moved by Gauss-Newton steps on pictures that are
blurred less and less, as a search moves scalars. Nothing is drawn at random, and nothing is kept from one mesh to the
next: a mesh has the same camera whenever it is asked for.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapewright.comparison.blurred import PARTS, at_scales
from shapewright.rendering.anywhere import BANK, HIGH, LOW, SLACK, camera_at
from shapewright.rendering.cameras import Camera
from shapewright.rendering.framed import framed
from shapewright.search.descent import bounded_step
from shapewright.shapes import Floats, Mesh, Shape
from shapewright.shapes.views import View, Views

_COARSE, _SIZE = 16, 64
"""Pixels along the side of the pictures of the bank, and of those after it."""
_STARTS = (4, 2, 1)
"""Cameras that are followed at each scale of blur; the finest has the last number."""
_STEPS = (2, 2, 4)
_PROBE = np.array([2.0, 2.0, 0.04])
"""How far a probe moves each number of a camera: pictures make the slope of shorter moves too coarse."""
_REACH = np.array([9.0, 9.0, 0.12])
"""How far one step may move them."""
_FLOOR = 100.0  # see ``bounded_step``


@dataclass(frozen=True, eq=False)
class Found:
    """Where a mesh looks as a picture shows it."""

    place: Floats  # (3,): azimuth and elevation in degrees, nearness
    residual: Floats  # (1360,), of the blurred silhouettes, see ``blurred``
    cost: float  # the sum of absolute values at the finest scale

    @property
    def camera(self) -> Camera:
        return camera_at(self.place)


class CameraSearch:
    """The search for the camera of one view."""

    def __init__(self, view: View) -> None:
        sharp = _pooled(view.mask, _SIZE)
        self._reference = at_scales(sharp)
        self._coarse = _pooled(view.mask, _COARSE).ravel()

    def found(self, mesh: Mesh) -> Found:
        """The best camera of a normalised mesh."""
        bank = framed(mesh, BANK, _COARSE, supersample=4).reshape(len(BANK), -1) / 255.0
        order = np.argsort(np.abs(bank - self._coarse).sum(axis=1), kind="stable")
        starts = _apart(BANK[order])
        for scale, (count, steps) in enumerate(zip(_STARTS, _STEPS, strict=True), start=1):
            followed = [self._followed(mesh, place, scale, steps) for place in starts[:count]]
            starts = [place for place, _ in sorted(followed, key=lambda one: one[1])]
        residual = self._residual(mesh, starts[0])
        return Found(starts[0], residual, float(np.abs(residual[PARTS[-1]]).sum()))

    def _followed(self, mesh: Mesh, place: Floats, scale: int, steps: int) -> tuple[Floats, float]:
        """The best place after some steps at one scale, and its cost there."""
        part = PARTS[scale]
        residual = self._residual(mesh, place, part)
        cost = float(np.abs(residual).sum())
        reach = _REACH / scale
        for _ in range(steps):
            side = np.where(place + _PROBE > HIGH + SLACK, -_PROBE, _PROBE)
            probed = [self._residual(mesh, place + move, part) - residual for move in np.diag(side)]
            slopes = np.ascontiguousarray(np.array(probed) / (side / reach)[:, None])
            low, high = np.maximum((LOW - SLACK - place) / reach, -1.0), np.minimum((HIGH + SLACK - place) / reach, 1.0)
            step = bounded_step(slopes, residual, np.minimum(low, 0.0), np.maximum(high, 0.0), _FLOOR) * reach
            tried = self._residual(mesh, place + step, part)
            new = float(np.abs(tried).sum())
            if new < cost:
                place, residual, cost = place + step, tried, new
            else:
                reach = reach * 0.4
        return place, cost

    def _residual(self, mesh: Mesh, place: Floats, part: slice = slice(None)) -> Floats:
        sharp = framed(mesh, place[None], _SIZE, supersample=4 if part in (PARTS[-1], slice(None)) else 2)[0]
        return at_scales(sharp / 255.0, part) - self._reference[part]


class ViewsDifference:
    """How a replica differs from an object in all its views, each from the camera that suits the replica best.

    most: views for which residuals have room; those that the object has not are 0.
    """

    def __init__(self, views: Views, most: int = 1) -> None:
        self._searches = [CameraSearch(view) for view in views.views]
        self._room = max(most, len(views)) - len(views)

    def residual(self, replica: Shape) -> Floats | None:
        """(1360 * most,): at each scale one view after the other, see ``parts_of``; None for a drawing."""
        if not isinstance(replica, Mesh):
            return None
        rows = [found.residual / len(self._searches) for found in self.found(replica)]
        rows += [np.zeros_like(rows[0])] * self._room
        return np.concatenate([row[part] for part in PARTS for row in rows])

    def found(self, replica: Mesh) -> list[Found]:
        """For each view the camera that suits the replica best."""
        normal = replica.normalised()
        return [search.found(normal) for search in self._searches]


def parts_of(most: int) -> tuple[slice, ...]:
    """The scales of the residuals of so many views, coarse to fine."""
    return tuple(slice(part.start * most, part.stop * most) for part in PARTS)


def _apart(places: Floats) -> list[Floats]:
    """Those rows that do not lie beside an earlier one."""
    chosen: list[Floats] = []
    for place in places:
        if all(np.abs((place - other) / _REACH).max() > 2.0 for other in chosen):
            chosen.append(place)
        if len(chosen) == max(_STARTS):
            break
    return chosen


def _pooled(mask: np.ndarray, size: int) -> Floats:
    step = len(mask) // size
    return np.asarray(mask.reshape(size, step, size, step).mean(axis=(1, 3)) / 255.0)
