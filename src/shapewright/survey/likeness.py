"""How alike the shapes of a collection look, quickly: small pictures of coverage and depth, whichever way they face."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numba import njit

from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import render
from shapewright.shapes import Bytes, Drawing, Floats, Ints, ReferenceShape

_CAMERAS = tuple(Camera(azimuth, 20.0) for azimuth in (0.0, 90.0, 180.0, 270.0))
"""From a little above; a quarter turn of a shape shifts them by one."""
_SIZE = 24
"""Pixels along the side of a picture, of 2 x 2 samples each."""


def pictures(shapes: Sequence[ReferenceShape], threads: int | None = None) -> Bytes:
    """(N, 4, D): of normalised shapes, coverage and depth in each view; of drawings coverage, the same in all."""
    drawn = render(shapes, _CAMERAS, _SIZE, threads=threads)
    if shapes and isinstance(shapes[0], Drawing):
        return drawn[:, :, 0].reshape(len(shapes), len(_CAMERAS), -1)
    depth = drawn[:, :, 1]
    covered = np.where(depth > 0, np.uint8(255), np.uint8(0))
    return np.stack([covered, depth], axis=2).reshape(len(shapes), len(_CAMERAS), -1)


def differences(seen: Bytes, first: Ints, second: Ints) -> tuple[Floats, Ints]:
    """How much pairs of shapes differ, (K,): 0 for the same pictures, 1 where they have nothing in common; and the
    quarter turns (K,) of the second about the up axis, from the front towards the right, at which that is so.

    seen: see ``pictures``. first, second: rows of it, (K,).
    """
    least, turns = np.empty(len(first), dtype=np.int64), np.zeros(len(first), dtype=np.int64)
    _least(np.ascontiguousarray(seen), first, second, least, turns)
    sums = ink(seen)
    return least / np.maximum(sums[first] + sums[second], 1), turns


def ink(seen: Bytes) -> Ints:
    """(N,): the sums of all pictures of each shape. Two that differ by little have nearly the same."""
    return np.asarray(seen.sum(axis=(1, 2), dtype=np.int64))


@njit(nogil=True, cache=True)
def _least(seen: Any, first: Any, second: Any, least: Any, turns: Any) -> None:
    views, size = seen.shape[1], seen.shape[2]
    for k in range(len(first)):
        a, b = seen[first[k]], seen[second[k]]
        for turn in range(views):
            total = np.int64(0)
            for view in range(views):
                one, other = a[view], b[(view - turn) % views]
                for i in range(size):
                    total += abs(np.int64(one[i]) - np.int64(other[i]))
            if turn == 0 or total < least[k]:
                least[k], turns[k] = total, turn
