"""What tells which way a shape stands: numbers for each of the 24 ways to turn it.

They are those of Fu et al. 2008, "Upright orientation of man-made objects": what touches the ground and whether the
middle stands above it, mirror planes, what is seen from above and from below. Front and back are told by openings,
details and heights. All are taken from six pictures, so a turn costs no drawing.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from shapewright.axes.sides import Sides
from shapewright.axes.turns import ABOVE, BACK, BELOW, FRONT, LEFT, RIGHT, SOURCES, TURNS
from shapewright.rendering.surround import SIZE
from shapewright.shapes import Floats

_FINE, _COARSE = 0.004, 0.1
"""Steps in depth, in parts of the box, that count as a detail (a door on a cabinet) and as an edge."""
_TOUCHES = 0.02  # of the box: what lies so near its side touches it
_END = 12  # rows of a picture that are its top and its bottom
_THIN = 0.02  # of the largest extent: thinner boxes count alike
_FIRM = 0.3  # of the box: how far inside what it stands on the middle counts
_SIDED = (0, 1, 3, 11)  # coverage, depth, details, symmetry: in which left and right may differ


def features(sides: Sides) -> Floats:
    """(24, FEATURES): of the shape after each of TURNS."""
    seen = np.stack([_picture(np.rot90(sides.nearness, quarters, axes=(1, 2))) for quarters in range(4)], axis=1)
    return np.stack([_standing(seen, sides, number) for number in range(len(TURNS))])


def _standing(seen: Floats, sides: Sides, number: int) -> Floats:
    """Of the shape after one turn. seen: (6, 4, 18), of each picture in each quarter turn."""
    views = [seen[view, quarters] for view, quarters in SOURCES[number]]
    front, back, above, below = (views[i] for i in (FRONT, BACK, ABOVE, BELOW))
    left, right = views[LEFT], views[RIGHT]
    centre, extent = TURNS[number] @ sides.centre, np.abs(TURNS[number]) @ sides.extent
    size = np.log(np.maximum(extent, _THIN))
    whole = [
        *(abs(centre[0]), centre[1], centre[2]),
        *(size[0] - size[1], size[2] - size[1], size[0] - size[2]),
        min(below[14] / 2.0 - abs(centre[0]), _FIRM),
        below[5] - above[5],
        below[14] * below[15] - below[5],
        above[14] * above[15] - above[5],
    ]
    parts = front, back, front - back, (left + right) / 2.0, np.abs(right - left)[list(_SIDED)]
    return np.concatenate([*parts, above, below, above - below, whole])


def _picture(nearness: Any) -> Floats:
    """(6, 18): of six pictures, in the order of the list at the end."""
    covered = nearness >= 0.0
    depth = np.where(covered, nearness, 0.0)
    height = np.linspace(1.0, -1.0, SIZE)[:, None]
    fine, coarse = _edges(depth, _FINE), _edges(depth, _COARSE)
    touching = depth > 1.0 - _TOUCHES
    count = covered.sum(axis=(1, 2))
    return np.stack(
        [
            count / SIZE**2,
            depth.mean(axis=(1, 2)),
            depth.std(axis=(1, 2)),
            fine.mean(axis=(1, 2)),
            coarse.mean(axis=(1, 2)),
            touching.mean(axis=(1, 2)),
            (covered * height).sum(axis=(1, 2)) / np.maximum(count, 1),
            (depth * height).sum(axis=(1, 2)) / np.maximum(depth.sum(axis=(1, 2)), 1e-6),
            (fine * height).mean(axis=(1, 2)) * 4.0,
            depth[:, -_END:].mean(axis=(1, 2)),
            depth[:, :_END].mean(axis=(1, 2)),
            np.abs(depth - depth[:, :, ::-1]).mean(axis=(1, 2)),
            np.abs(depth - depth[:, ::-1]).mean(axis=(1, 2)),
            (covered ^ covered[:, :, ::-1]).mean(axis=(1, 2)),
            _reach(touching.any(axis=1)),
            _reach(touching.any(axis=2)),
            (touching * height).sum(axis=(1, 2)) / np.maximum(touching.sum(axis=(1, 2)), 1),
            np.abs(np.diff(depth.mean(axis=2), axis=1)).mean(axis=1) * 10.0,
        ],
        axis=-1,
    )


def _edges(depth: Any, step: float) -> Any:
    marks = np.zeros(depth.shape, dtype=bool)
    marks[:, :, :-1] |= np.abs(np.diff(depth, axis=2)) > step
    marks[:, :-1] |= np.abs(np.diff(depth, axis=1)) > step
    return marks


def _reach(marks: Any) -> Floats:
    """(6,): from the first mark to the last one in each row (6, SIZE), as a part of the row."""
    first, last = marks.argmax(axis=1), SIZE - marks[:, ::-1].argmax(axis=1)
    return np.where(marks.any(axis=1), last - first, 0) / SIZE
