"""The judge of meshes that are known from pictures: how likely a person calls a replica and the object in its pictures
the same.

Silhouettes are compared as drawings are, from the camera that suits the replica best. What no picture shows counts
nothing. ``benchmarks/judging_views.py`` fitted what is weighed here.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.judging.drawn_fidelity import PAGE, Likeness, Seen, beside, largest_first
from shapewright.judging.verdict import Region
from shapewright.rendering.framed import framed
from shapewright.search.views.camera_search import ViewsDifference
from shapewright.shapes import Bytes, Floats, Mesh, Shape
from shapewright.shapes.views import SIDE, Views

_WEIGHTS = np.array([2.82, 3.22, 1.4, -10.06])
_BIAS = -19.67
"""Of ``Likeness.terms``."""


@dataclass(frozen=True, eq=False)
class InView:
    """A replica in the pictures of an object.

    places: (V, 3), of the cameras, see ``anywhere``.
    likenesses: of the silhouettes, one for each view.
    missing, surplus: regions of the first view, in the frame of a drawing; the largest first.
    """

    places: Floats
    likenesses: tuple[Likeness, ...]
    missing: tuple[Region, ...]
    surplus: tuple[Region, ...]

    @property
    def value(self) -> float:
        """The fidelity: of the view in which the two are least alike."""
        return min(value_of(likeness) for likeness in self.likenesses)

    @property
    def iou(self) -> float:
        """Of the silhouettes, the mean over the views."""
        return float(np.mean([likeness.iou for likeness in self.likenesses]))


class ViewFidelity:
    """A reference, described when it is first needed; any thread may ask."""

    def __init__(self, reference: Views, difference: ViewsDifference) -> None:
        self._difference = difference
        self._seen = functools.cache(lambda: [_seen(_pooled(view.mask)) for view in reference.views])

    def in_view(self, replica: Shape | None) -> InView | None:
        """None where the two cannot be compared."""
        if not isinstance(replica, Mesh):
            return None
        places = np.array([found.place for found in self._difference.found(replica)])
        pictures = framed(replica.normalised(), places, PAGE)
        if not all(picture.any() for picture in pictures):
            return None
        found = [beside(ours, _seen(picture)) for ours, picture in zip(self._seen(), pictures, strict=True)]
        _, missing, surplus = found[0]
        return InView(places, tuple(one[0] for one in found), largest_first(missing), largest_first(surplus))


def value_of(likeness: Likeness, weights: Sequence[float] | Floats = _WEIGHTS, bias: float = _BIAS) -> float:
    """The probability that a person calls the object in a picture and a replica the same, 0 to 1."""
    return 1.0 / (1.0 + math.exp(-float(np.asarray(weights) @ likeness.terms()) - bias))


def _seen(picture: Bytes) -> Seen:
    rows, columns = (np.flatnonzero((picture > 0).any(axis=axis)) for axis in (1, 0))
    height, width = (np.ptp(places) + 1 for places in (rows, columns))
    return Seen(picture / 255.0, math.log(width / height))


def _pooled(mask: Bytes) -> Bytes:
    step = SIDE // PAGE
    return np.asarray(mask.reshape(PAGE, step, PAGE, step).mean(axis=(1, 3)) + 0.5).astype(np.uint8)
