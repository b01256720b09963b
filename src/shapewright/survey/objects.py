"""Several objects in one mesh: clusters of pieces that stand far apart, or pieces of one name."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapewright.settings import Split
from shapewright.shapes import Ints
from shapewright.survey.pieces import Pieces

_GAP = 0.08
"""Units of the largest extent: objects stand further apart than this."""
_LIKE = 0.4
"""Of the extent of the largest: an object is at least so large. What is smaller belongs to the nearest one."""


@dataclass(frozen=True, eq=False)
class Object:
    """Pieces that are one object.

    Attributes:
        name: what the file calls them, where that is one name; empty else.
        pieces: which.
    """

    name: str
    pieces: Ints


def objects(pieces: Pieces, rest: Ints, split: Split = "apart") -> list[Object]:
    """The objects among some pieces, in the order of the file; one where they belong together."""
    if split == "off":
        return [_object(pieces, rest)]
    if split == "names":
        names: dict[tuple[str, ...], list[int]] = {}
        for piece in rest:
            names.setdefault(pieces.names([piece]), []).append(int(piece))
        return [_object(pieces, np.array(some)) for some in names.values()]
    clusters = pieces.clusters(rest, _GAP)
    extents = [float(np.ptp(pieces.bounds(some), axis=0).max()) for some in clusters]
    large = [some for some, extent in zip(clusters, extents, strict=True) if extent >= _LIKE * extents[0]]
    for some in clusters[len(large) :]:
        low, high = pieces.bounds(some)
        boxes = [pieces.bounds(each) for each in large]
        gaps = [np.linalg.norm(np.maximum(np.maximum(box[0] - high, low - box[1]), 0.0)) for box in boxes]
        nearest = int(np.argmin(gaps))
        large[nearest] = np.concatenate([large[nearest], some])
    return [_object(pieces, np.sort(some)) for some in sorted(large, key=lambda some: int(some.min()))]


def _object(pieces: Pieces, some: Ints) -> Object:
    names = pieces.names(some)
    return Object(names[0] if len(names) == 1 else "", some)
