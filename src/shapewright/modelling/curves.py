"""Curves through space as points, no more of them than their bends need; and Bezier curves as functions."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from shapewright.modelling.arguments import positive
from shapewright.shapes import Floats

TOLERANCE = 0.0025  # facets from a smooth shape, as a part of its largest extent: a pixel in a picture of 400
_SAMPLES, _MOST = 33, 96


def knots(curves: Floats, tolerance: float) -> list[float]:
    """Where in (0, 1) to break curves into chords that stay within about ``tolerance`` of them.

    curves: (S, L, 3), L curves at S even steps of their parameter. The knots lie as dense as the square root of the
    largest second derivative, which is optimal for chords (de Boor, A Practical Guide to Splines, XII).
    """
    steps = len(curves) - 1
    bends = curves[2:] - 2.0 * curves[1:-1] + curves[:-2]
    second = np.sqrt(np.einsum("sld,sld->sl", bends, bends).max(axis=1)) * steps**2
    if second.max() <= tolerance:
        return []
    density = np.sqrt(np.concatenate([second[:1], second, second[-1:]]) / (8.0 * tolerance))
    needed = np.concatenate([[0.0], np.cumsum((density[1:] + density[:-1]) / 2.0)]) / steps
    pieces = min(math.ceil(needed[-1] - 1e-6), _MOST)
    if pieces < 2:
        return []
    shares = needed[-1] * np.arange(1, pieces) / pieces
    return [float(t) for t in np.interp(shares, needed, np.linspace(0.0, 1.0, steps + 1))]


def bernstein(control: ArrayLike, t: Floats) -> Floats:
    """A Bezier curve at t in [0, 1]: control (K, D) and t (N,) give (N, D)."""
    points = np.asarray(control, dtype=np.float64)
    powers = _power_basis(len(points)) @ points
    result = np.full((len(t), points.shape[1]), powers[-1])
    for coefficient in powers[-2::-1]:
        result *= t[:, None]
        result += coefficient
    return result


@lru_cache(maxsize=32)
def _power_basis(count: int) -> Floats:
    """(K, K): from the control points of a Bezier curve to its coefficients of t to the power of 0, 1, ..."""
    rows = [
        [(-1) ** (power + k) * math.comb(count - 1, power) * math.comb(power, k) for k in range(count)]
        for power in range(count)
    ]
    return np.array(rows, dtype=np.float64)


def bezier(*control: Sequence[float], tolerance: float = TOLERANCE) -> Floats:
    """Points (N, D) on the Bezier curve of these control points (two or more, of two or three numbers each).

    tolerance: how far the chords may be from the curve, as a part of the largest extent of its control points.
    """
    points = _points("bezier", control, 2)
    slack = _slack(tolerance, points)
    return bernstein(points, _times(lambda t: bernstein(points, t)[:, None], np.array([0.0, 1.0]), slack))


def spline(*through: Sequence[float], closed: bool = False, tolerance: float = TOLERANCE) -> Floats:
    """Points (N, D) on a smooth curve through the given ones: a centripetal Catmull-Rom spline.

    closed: the curve returns to its first point, which is then also the last. tolerance: see ``bezier``.
    Raises ValueError for fewer than two points (closed: three), or two equal ones in succession.
    """
    points = _points("spline", through, 3 if closed else 2)
    ring = np.concatenate([points, points[:1]]) if closed else points
    lengths = np.linalg.norm(np.diff(ring, axis=0), axis=1)
    if not lengths.all():
        raise ValueError("spline: two points in succession are equal")
    times = np.concatenate([[0.0], np.cumsum(np.sqrt(lengths))])
    return interpolate(ring[:, None], times, _slack(tolerance, points), closed)[:, 0]


def smooth(stack: Floats, tolerance: float) -> Floats:
    """Copies (M, P, 3) of a ring of points, on smooth curves through the given copies (K, P, 3), K > 2.

    tolerance: how far the chords may be from the curves.
    """
    steps = np.linalg.norm(np.diff(stack, axis=0), axis=2).max(axis=1)
    return interpolate(stack, np.concatenate([[0.0], np.cumsum(np.sqrt(steps))]), tolerance)


def interpolate(points: Floats, times: Floats, tolerance: float, closed: bool = False) -> Floats:
    """Points (M, L, D) on L smooth curves that pass through points (K, L, D) at times (K,), which rise.

    tolerance: how far the chords may be from the curves. closed: the last points are the first, and it is smooth there.
    """
    flat = points.reshape(len(points), -1)
    slopes = _slopes(flat, times, closed)
    every = _times(lambda t: _hermite(flat, slopes, times, t).reshape(len(t), *points.shape[1:]), times, tolerance)
    return _hermite(flat, slopes, times, every).reshape(len(every), *points.shape[1:])


def _slopes(points: Floats, times: Floats, closed: bool) -> Floats:
    """Derivatives (N, D) at the points of the parabolas through each and its neighbours."""
    step = np.diff(times)[:, None]
    rise = np.diff(points, axis=0) / step
    if len(rise) == 1:
        return np.concatenate([rise, rise])
    if closed:
        step, rise = np.concatenate([step[-1:], step]), np.concatenate([rise[-1:], rise])
    inner = (rise[:-1] * step[1:] + rise[1:] * step[:-1]) / (step[1:] + step[:-1])
    if closed:
        return np.concatenate([inner, inner[:1]])
    return np.concatenate([2.0 * rise[:1] - inner[:1], inner, 2.0 * rise[-1:] - inner[-1:]])


def _hermite(points: Floats, slopes: Floats, times: Floats, at: Floats) -> Floats:
    i = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 2)
    step = (times[i + 1] - times[i])[:, None]
    u = (at - times[i])[:, None] / step
    return np.asarray(
        (1.0 + 2.0 * u) * (1.0 - u) ** 2 * points[i]
        + u * (1.0 - u) ** 2 * step * slopes[i]
        + u**2 * (3.0 - 2.0 * u) * points[i + 1]
        + u**2 * (u - 1.0) * step * slopes[i + 1]
    )


def _slack(tolerance: float, control: Floats) -> float:
    return positive("curve", "tolerance", tolerance) * float(np.ptp(control, axis=0).max())


def _times(curves: Callable[[Floats], Floats], breaks: Floats, tolerance: float) -> Floats:
    """Parameters at which to break curves, from t (N,) to (N, L, 3), besides at their own breaks."""
    steps = np.linspace(0.0, 1.0, _SAMPLES)
    samples = curves((breaks[:-1, None] + np.diff(breaks)[:, None] * steps).ravel())
    pieces = samples.reshape(len(breaks) - 1, _SAMPLES, *samples.shape[1:])
    inner = [
        start + (end - start) * t
        for piece, (start, end) in zip(pieces, pairwise(breaks), strict=True)
        for t in knots(piece, tolerance)
    ]
    return np.sort(np.concatenate([breaks, inner]))


def _points(function: str, points: Sequence[Sequence[float]], least: int) -> Floats:
    array = np.array([tuple(point) for point in points], dtype=np.float64)
    if array.ndim != 2 or array.shape[1] not in (2, 3) or len(array) < least or not np.isfinite(array).all():
        raise ValueError(f"{function}: it takes at least {least} finite points of two or three numbers each")
    if not np.ptp(array, axis=0).any():
        raise ValueError(f"{function}: all its points are one")
    return array
