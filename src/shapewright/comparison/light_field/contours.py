"""Contour coefficients of silhouettes: the Fourier transform of the outer contour's distance from the middle.

Chen et al. 2003, section 4.2, and the program of its authors, whose walk along the contour is followed step by step.
An image is a flattened (256 x 256) uint8 array of 0 and 1 with at least ``MARGIN`` empty pixels along every border; a
pixel is an index of it, a step an offset, and "down" leads to the next row. A box is (first row, row after the last,
first column, column after the last) of the foreground.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from shapewright.rendering.silhouettes import SIZE
from shapewright.shapes import Bytes, Floats, Ints

Pixels = NDArray[np.int32]
Box = tuple[int, int, int, int]

FOURIER = 10
"""Coefficients of a contour."""
MARGIN = 6
"""Two dilations reach 3 pixels outwards, the flood 2 more, and a step of the walk looks one further."""
_LONGEST = 4 * SIZE * SIZE  # a walk through more pairs of a pixel and a direction than there are repeats itself

_DOWN, _RIGHT, _UP, _LEFT = SIZE, 1, -SIZE, -1
_SIDES = (_DOWN, _RIGHT, _UP, _LEFT)
_AHEAD = np.array(  # for each direction (down, right, up, left) the steps to try, in this order
    [
        [_DOWN + _LEFT, _DOWN, _DOWN + _RIGHT],
        [_DOWN + _RIGHT, _RIGHT, _UP + _RIGHT],
        [_UP + _RIGHT, _UP, _UP + _LEFT],
        [_UP + _LEFT, _LEFT, _DOWN + _LEFT],
    ]
)
_TURNS = np.array([[3, 0, 0], [0, 1, 1], [1, 2, 2], [2, 3, 3]])  # and the direction after each of them
_RING = np.array([_RIGHT, _UP + _RIGHT, _UP, _UP + _LEFT, _LEFT, _DOWN + _LEFT, _DOWN, _DOWN + _RIGHT])
_SQUARE = np.array([_UP + _LEFT, _UP, _UP + _RIGHT, _LEFT, 0, _RIGHT, _DOWN + _LEFT, _DOWN, _DOWN + _RIGHT])
_DISC = np.array([r * SIZE + c for r in range(-2, 3) for c in range(-2, 3) if abs(r) + abs(c) < 4])
_WHOLE = 0.95  # a contour that encloses no more of the foreground than this has missed a part
_FREE, _WALL, _OUTSIDE = 0, 1, 2


@njit(nogil=True, cache=True)
def contour_coefficients(images: Bytes, boxes: Ints, fourier: Floats) -> None:
    """Magnitudes 1 to 10 over magnitude 0 (V, 10) for V silhouettes (V, 256, 256) and their boxes (V, 4).

    0 for a silhouette of no pixels, and for a contour of fewer than eight.
    """
    contour = np.empty(_LONGEST, np.int32)
    marks, stack = np.empty(SIZE * SIZE, np.uint8), np.empty(SIZE * SIZE, np.int32)
    fourier[:] = 0.0
    for v in range(len(images)):
        box = (boxes[v, 0], boxes[v, 1], boxes[v, 2], boxes[v, 3])
        if box[0] < box[1]:
            count = _outer_contour(images[v].ravel(), box, contour, marks, stack)
            _transform(contour[:count], 0.5 * (box[0] + box[1] - 1), 0.5 * (box[2] + box[3] - 1), fourier[v])


@njit(nogil=True, cache=True)
def _outer_contour(image: Bytes, box: Box, contour: Pixels, marks: Bytes, stack: Pixels) -> int:
    """Write the pixels of the closed outer contour to ``contour`` and return how many; the start is counted twice.

    Several parts are first joined: dilated, at most twice, or replaced by their bounding box, then thinned again.
    marks and stack are scratch of the image's size.
    """
    count = _trace(image, box, contour)
    if _encloses(image, box, contour[:count], marks, stack):
        return count
    joined = np.zeros_like(image)
    _dilate(image, box, _SQUARE, joined)
    reach = (box[0] - 1, box[1] + 1, box[2] - 1, box[3] + 1)
    count = _trace(joined, reach, contour)
    if not _encloses(joined, reach, contour[:count], marks, stack):
        once = joined.copy()
        _dilate(once, reach, _DISC, joined)
        reach = (reach[0] - 2, reach[1] + 2, reach[2] - 2, reach[3] + 2)
        count = _trace(joined, reach, contour)
        if not _encloses(joined, reach, contour[:count], marks, stack):
            reach = box
            joined[:] = 0
            for row in range(box[0], box[1]):
                joined[row * SIZE + box[2] : row * SIZE + box[3]] = 1
    _thin(joined, image, reach, stack)
    return _trace(joined, reach, contour)


@njit(nogil=True, cache=True)
def _trace(image: Bytes, box: Box, contour: Pixels) -> int:
    """Walk along the foreground's border from its first pixel on, until the start is reached again."""
    start = box[0] * SIZE + box[2]
    while image[start] == 0:
        start += 1
    early = (
        image[start + _DOWN + _LEFT] == 1
        and image[start + _DOWN] == 0
        and (image[start + _DOWN + _RIGHT] == 1 or image[start + _RIGHT] == 1)
    )
    contour[0] = start
    count, pixel, direction = 1, start, 0
    while count < _LONGEST:
        choice, turns = 0, 0
        while image[pixel + _AHEAD[direction, choice]] == 0:
            choice += 1
            if choice == 3:
                choice = 0
                direction = (direction + 1) % 4
                turns += 1
                if turns == 4:
                    return count
        pixel += _AHEAD[direction, choice]
        direction = _TURNS[direction, choice]
        contour[count] = pixel
        count += 1
        if pixel == start and not (early and direction == 1):
            break
    return count


@njit(nogil=True, cache=True)
def _encloses(image: Bytes, box: Box, contour: Pixels, marks: Bytes, stack: Pixels) -> bool:
    """Whether nearly all of the foreground is out of reach for a 4-connected flood from outside the contour."""
    first, last, left, right = box[0] - 2, box[1] + 1, box[2] - 2, box[3] + 1
    for row in range(first, last + 1):
        marks[row * SIZE + left : row * SIZE + right + 1] = _WALL if row in (first, last) else _FREE
        marks[row * SIZE + left] = _WALL
        marks[row * SIZE + right] = _WALL
    for pixel in contour:
        marks[pixel] = _WALL
    corner = (first + 1) * SIZE + left + 1
    marks[corner] = _OUTSIDE
    stack[0] = corner
    waiting, missed = 1, 0
    while waiting > 0:
        waiting -= 1
        pixel = stack[waiting]
        missed += image[pixel]
        for step in _SIDES:
            if marks[pixel + step] == _FREE:
                marks[pixel + step] = _OUTSIDE
                stack[waiting] = pixel + step
                waiting += 1
    foreground = 0
    for row in range(box[0], box[1]):
        for pixel in range(row * SIZE + box[2], row * SIZE + box[3]):
            foreground += image[pixel]
    return foreground - missed > _WHOLE * foreground


@njit(nogil=True, cache=True)
def _dilate(image: Bytes, box: Box, element: NDArray[np.int64], dilated: Bytes) -> None:
    for row in range(box[0], box[1]):
        for pixel in range(row * SIZE + box[2], row * SIZE + box[3]):
            if image[pixel]:
                for step in element:
                    dilated[pixel + step] = 1


@njit(nogil=True, cache=True)
def _thin(image: Bytes, kept: Bytes, box: Box, stack: Pixels) -> None:
    """Remove pixels in sweeps from above, below, left and right until none can go; never one of ``kept``."""
    spare = 0
    for row in range(box[0], box[1]):
        for pixel in range(row * SIZE + box[2], row * SIZE + box[3]):
            if image[pixel] and not kept[pixel]:
                stack[spare] = pixel
                spare += 1
    changed = True
    while changed:
        changed = False
        for side in (_UP, _DOWN, _LEFT, _RIGHT):
            gone = 0
            for n in range(spare):  # gather those that go at the front: all are judged before the first one goes
                pixel = stack[n]
                if image[pixel + side] == 0 and _is_removable(image, pixel):
                    stack[n] = stack[gone]
                    stack[gone] = pixel
                    gone += 1
            changed = changed or gone > 0
            for n in range(gone - 1, -1, -1):
                image[stack[n]] = 0
                spare -= 1
                stack[n] = stack[spare]


@njit(nogil=True, cache=True)
def _is_removable(image: Bytes, pixel: int) -> bool:
    """Whether at most one 4-connected part of the ring around the pixel touches it, and the ring has not just one."""
    parts, neighbours = 0, 0
    for k in range(0, 8, 2):
        side, corner = image[pixel + _RING[k]], image[pixel + _RING[k + 1]]
        neighbours += side + corner
        if side and not (corner and image[pixel + _RING[(k + 2) % 8]]):
            parts += 1
    return parts <= 1 and neighbours != 1


@njit(nogil=True, cache=True)
def _transform(contour: Pixels, row: float, column: float, fourier: Floats) -> None:
    count = len(contour)
    if count < 8:
        return
    real, imaginary = np.zeros(FOURIER), np.zeros(FOURIER)
    cosine, sine = np.ones(FOURIER), np.zeros(FOURIER)
    turn = 2.0 * math.pi / count * np.arange(1, FOURIER + 1)
    turn_cosine, turn_sine = np.cos(turn), np.sin(turn)
    total = 0.0
    for pixel in contour:
        distance = math.sqrt((pixel // SIZE - row) ** 2 + (pixel % SIZE - column) ** 2)
        total += distance
        for k in range(FOURIER):
            real[k] += distance * cosine[k]
            imaginary[k] += distance * sine[k]
            along = cosine[k] * turn_cosine[k] - sine[k] * turn_sine[k]
            sine[k] = sine[k] * turn_cosine[k] + cosine[k] * turn_sine[k]
            cosine[k] = along
    for k in range(FOURIER):
        fourier[k] = math.hypot(real[k], imaginary[k]) / total
