"""Details that furniture is made of: rounded and chamfered boxes, legs, slats, cushions. Each fills its size."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from shapewright.modelling import arguments
from shapewright.modelling.arguments import ORIGIN, Axis, Vector
from shapewright.modelling.curves import TOLERANCE, interpolate
from shapewright.modelling.solid.primitives import box, cone
from shapewright.modelling.solid.sections import Section, rectangle
from shapewright.modelling.solid.solid import Solid, union
from shapewright.modelling.solid.sweeps import extrude, revolve, skin

VASE = ((0.45, 0.0), (0.6, 0.06), (0.35, 0.14), (0.6, 0.45), (1.0, 0.68), (0.5, 0.82), (0.8, 0.88), (0.8, 1.0))


def rounded_box(size: float | Vector, radius: float, at: Vector = ORIGIN, segments: int = 4) -> Solid:
    """A box whose edges and corners are rounded, by ``segments`` facets each.

    Raises ValueError for a radius that is not positive or more than half the least extent.
    """
    steps = arguments.count("rounded_box", segments, 1, "segments")
    return _rounded("rounded_box", size, arguments.positive("rounded_box", "radius", radius), steps, at)


def chamfered_box(size: float | Vector, chamfer: float, at: Vector = ORIGIN) -> Solid:
    """A box whose edges are cut off, by so much of either side. Raises ValueError as ``rounded_box`` does."""
    return _rounded("chamfered_box", size, arguments.positive("chamfered_box", "chamfer", chamfer), 1, at)


def cushion(size: float | Vector, at: Vector = ORIGIN, crown: float = 0.4, segments: int = 4) -> Solid:
    """A box with round edges and a full top and bottom; ``crown``, 0 to below 1, is the part of the height they bulge.

    Raises ValueError for a height of more than the width or depth.
    """
    width, height, depth = arguments.size("cushion", size)
    swell = arguments.number("cushion", "crown", crown)
    if not 0.0 <= swell < 1.0:
        raise ValueError(f"cushion: crown={crown!r} must lie in 0..1, below 1")
    body = height * (1.0 - swell)
    steps = arguments.count("cushion", segments, 1, "segments")
    core = _rounded("cushion", (width, body, depth), body / 2.0, steps, ORIGIN)
    if swell:
        core = core.bulge(height * swell / 2.0, "y").bulge(height * swell / 2.0, "-y")
    return core.translate(arguments.vector("cushion", "at", at))


def tapered_leg(
    size: float | Vector, at: Vector = ORIGIN, foot: float = 0.6, round: bool = False, segments: int = 12
) -> Solid:
    """A leg that is widest at the top; ``foot`` is the part of the width that it has at the bottom."""
    width, height, depth = arguments.size("tapered_leg", size)
    narrow = arguments.positive("tapered_leg", "foot", foot)
    if narrow > 1.0:
        raise ValueError(f"tapered_leg: foot={foot!r} must lie above 0 and up to 1")
    if round:
        return cone((width, height, depth), at, 1.0, narrow, segments)
    return extrude(rectangle(width * narrow, depth * narrow), height, at, taper=1.0 / narrow)


def turned_leg(
    size: float | Vector,
    at: Vector = ORIGIN,
    profile: Sequence[tuple[float, float]] = VASE,
    smooth: bool = True,
    segments: int = 12,
    tolerance: float = TOLERANCE,
) -> Solid:
    """A leg turned on a lathe.

    profile: points (r, y) from the bottom up, in any unit: they are stretched to fill the size; joined by a smooth
    curve, or by straight lines. tolerance: of the curve, as a part of the height.
    Raises ValueError for fewer than two points, heights that do not rise, and a radius that is not positive.
    """
    points = np.array([tuple(point) for point in profile], dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2 or (np.diff(points[:, 1]) <= 0.0).any():
        raise ValueError("turned_leg: profile takes two or more points (r, y), from the bottom up")
    width, height, depth = arguments.size("turned_leg", size)
    radius = (width + depth) / 4.0
    points = (points - (0.0, points[0, 1])) * (radius / points[:, 0].max(), height / np.ptp(points[:, 1]))
    slack = arguments.positive("turned_leg", "tolerance", tolerance) * height
    line = interpolate(points[:, None], points[:, 1], slack)[:, 0] if smooth else points
    line = line * (radius / line[:, 0].max(), 1.0)
    if line[:, 0].min() <= 0.0:
        raise ValueError("turned_leg: the profile reaches the axis; use larger radii, or more points")
    half = np.concatenate([[(0.0, 0.0)], line, [(0.0, height)]]) - (0.0, height / 2.0)
    turned = revolve(half, segments=segments).scale((width / (2.0 * radius), 1.0, depth / (2.0 * radius)))
    return turned.translate(arguments.vector("turned_leg", "at", at))


def slats(size: float | Vector, count: int, gap: float, axis: Axis = "x", at: Vector = ORIGIN) -> Solid:
    """So many equal boxes side by side along an axis, with gaps between them, which fill the size together.

    Raises ValueError when the gaps leave no room for the slats.
    """
    extents = list(arguments.size("slats", size))
    centre = arguments.vector("slats", "at", at)
    index, number = arguments.axis("slats", axis), arguments.count("slats", count, 1)
    space = arguments.number("slats", "gap", gap)
    width = (extents[index] - (number - 1) * space) / number
    if space <= 0.0 or width <= 0.0:
        raise ValueError(f"slats: {number} slats with gaps of {gap!r} between them do not fit into {extents[index]:g}")
    first = (width - extents[index]) / 2.0
    extents[index] = width
    centres = np.tile(centre, (number, 1))
    centres[:, index] += first + np.arange(number) * (width + space)
    return union(*(box(extents, centre) for centre in centres))


def _rounded(function: str, size: float | Vector, radius: float, segments: int, at: Vector) -> Solid:
    """Rounded rectangles stacked so that their corners make quarters of spheres."""
    width, height, depth = arguments.size(function, size)
    if radius > min(width, height, depth) / 2.0 * (1.0 + 1e-9):
        raise ValueError(f"{function}: {radius:g} is more than half the least extent of {(width, height, depth)}")
    radius = min(radius, width / 2.0, height / 2.0, depth / 2.0)
    quarter = np.linspace(0.0, np.pi / 2.0, segments + 1)
    out, up = radius * np.cos(quarter), radius * np.sin(quarter)
    out[-1], rim = 0.0, (width / 2.0 - radius, depth / 2.0 - radius)
    around = np.concatenate([quarter + turn * np.pi / 2.0 for turn in range(4)])
    unit = np.stack([np.cos(around), np.sin(around)], axis=1)
    corners = np.repeat([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)], segments + 1, axis=0) * rim
    reaches = [*out[::-1], *out]
    levels = [*(-(height / 2.0 - radius) - up[::-1]), *((height / 2.0 - radius) + up)]
    stack = [np.insert(corners + reach * unit, 1, y, axis=1) for reach, y in zip(reaches, levels, strict=True)]
    return skin(Section((stack[segments][:, [0, 2]],)), np.stack(stack), at=arguments.vector(function, "at", at))
