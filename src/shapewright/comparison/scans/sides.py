"""From which sides a scan was seen: what is missing from those sides is not there, the rest was hidden."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import view
from shapewright.rendering.visibility import shown_by
from shapewright.shapes import Floats, Ints, Mesh

_DISTANCE = 4.0  # of the cameras to the origin, in units of the largest extent: far enough for little perspective
_FIELD = math.degrees(2.0 * math.asin(0.87 / _DISTANCE))  # in which all of a normalised mesh fits
_SIZE = 64  # pixels along the side of a picture
_UNEXPLAINED = 2.0
"""What a point of the replica counts that is seen from a side and not explained; one that is explained counts 1. So a
side was not seen where less than two thirds of what it shows are explained."""
_LEAST = 0.01  # share of the replica's surface that a side has to explain to be one


_HEIGHTS = ((20.0, 12), (45.0, 12), (-35.0, 4))
"""Elevations of the sides, in degrees, and how many of them are around. People scan from a little above. Level sides
with one from the top would also explain shapes that have boards too many."""
AROUND = tuple(
    Camera(360.0 * number / count, elevation, _DISTANCE, _FIELD)
    for elevation, count in _HEIGHTS
    for number in range(count)
)
"""The sides that a scan is taken to be seen from, where nobody says from where it was."""
_TOWARDS = np.array([camera.frame()[2] for camera in AROUND])
_NEXT = np.argsort(-_TOWARDS @ _TOWARDS.T, axis=1, kind="stable")[:, 1:5]
_OF_NEXT = 3
"""The four sides next to each, and how many of them have to show what a scan from it shows."""


@lru_cache(maxsize=256)
def _cameras_at(places: tuple[tuple[float, float, float], ...]) -> tuple[Camera, ...]:
    """Cameras in these directions from the middle; they all have the same distance."""
    return tuple(
        Camera(math.degrees(math.atan2(x, z)), math.degrees(math.atan2(y, math.hypot(x, z))), _DISTANCE, _FIELD)
        for x, y, z in places
    )


def visible(mesh: Mesh, points: Floats, normals: Floats, cameras: tuple[Camera, ...]) -> Ints:
    """(N,): which cameras show each point (N, 3) of a normalised mesh, a bit for each camera; at most 60 cameras."""
    views = np.stack([view(mesh, camera, _SIZE)[1] for camera in cameras])
    return shown_by(points, normals, cameras, views)


def all_sides(places: Floats | None) -> tuple[Camera, ...]:
    """AROUND, and after these the places (S, 3) from which a scan was seen, where they are known."""
    return AROUND if places is None else (*AROUND, *_cameras_at(tuple(map(tuple, places))))


def seen_sides(bits: Ints, explained: NDArray[np.bool_]) -> int:
    """The sides that a scan was seen from, a bit for each: those that together show what is explained and little else.

    bits: of ``visible``, for points of a replica. explained: (N,), which of them lie near to points of the scan.
    """
    return int(_cover(bits, explained, len(AROUND)))


def surely_seen(bits: Ints, sides: int) -> NDArray[np.bool_]:
    """(N,): which points a scan from these sides would show.

    Where a side stands for a sensor that is up to 15 degrees aside, three of the four sides next to it have to show the
    point as well: of 18 scanned shapes .3 % of the surface instead of 1.7 % are then taken to be seen and are not.
    """
    return np.asarray(_surely(bits, sides, _NEXT))


@njit(nogil=True, cache=True)
def _surely(bits: Any, sides: int, next_to: Any) -> Any:
    seen = np.zeros(len(bits), np.bool_)
    for n in range(len(bits)):
        for c in range(60):
            if not (bits[n] & sides) >> c & 1:
                continue
            if c >= len(next_to):
                seen[n] = True
                break
            others = 0
            for k in next_to[c]:
                others += bits[n] >> k & 1
            if others >= _OF_NEXT:
                seen[n] = True
                break
    return seen


@njit(nogil=True, cache=True)
def _cover(bits: Any, explained: Any, count: int) -> Any:
    """Side after side, each time the one that explains most."""
    chosen = np.int64(0)
    while True:
        best, gain = -1, _LEAST * len(bits)
        for c in range(count):
            if chosen >> c & 1:
                continue
            own = 0.0
            for n in range(len(bits)):
                if bits[n] >> c & 1 and not bits[n] & chosen:
                    own += 1.0 if explained[n] else -_UNEXPLAINED
            if own > gain:
                best, gain = c, own
        if best < 0:
            return chosen
        chosen |= np.int64(1) << best
