"""Primitive solids: box, cylinder, cone, sphere, prism."""

from __future__ import annotations

from functools import lru_cache

from manifold3d import Manifold

from shapewright.modelling.arguments import ORIGIN, Vector, count, number, vector
from shapewright.modelling.arguments import size as checked_size
from shapewright.modelling.solid.solid import Solid

_UPRIGHT = (-90.0, 0.0, 0.0)  # turns manifold3d's z, along which its cylinders stand, into our y


def box(size: float | Vector, at: Vector = ORIGIN) -> Solid:
    return _place("box", Manifold.cube((1.0, 1.0, 1.0), True), size, at)


def cylinder(size: float | Vector, at: Vector = ORIGIN, segments: int = 32) -> Solid:
    """Upright; elliptical when width and depth differ."""
    return _place("cylinder", _unit_cone(count("cylinder", segments, 3, "segments"), 1.0, 1.0), size, at)


def cone(size: float | Vector, at: Vector = ORIGIN, top: float = 0.0, bottom: float = 1.0, segments: int = 32) -> Solid:
    """Upright; ``top`` and ``bottom`` say which part of the width and depth each end has, from 0 (a point) to 1."""
    ends = number("cone", "bottom", bottom), number("cone", "top", top)
    if min(ends) < 0.0 or max(ends) > 1.0 or max(ends) == 0.0:
        raise ValueError(f"cone: top={top!r}, bottom={bottom!r} must lie in 0..1, and not both be 0")
    return _place("cone", _unit_cone(count("cone", segments, 3, "segments"), *ends), size, at)


def sphere(size: float | Vector, at: Vector = ORIGIN, segments: int = 32) -> Solid:
    """An ellipsoid when the extents differ; ``segments`` around, rounded up to a multiple of four."""
    return _place("sphere", _unit_sphere(count("sphere", segments, 3, "segments")), size, at)


def prism(size: float | Vector, at: Vector = ORIGIN, sides: int = 6) -> Solid:
    """Upright with a regular polygon as its plan, inscribed in the ellipse of width and depth, a flat side in front."""
    return _place("prism", _unit_prism(count("prism", sides, 3, "sides")), size, at)


def _place(function: str, unit: Manifold, size: float | Vector, at: Vector) -> Solid:
    return Solid(unit.scale(checked_size(function, size)).translate(vector(function, "at", at)))


@lru_cache(maxsize=64)
def _unit_cone(segments: int, bottom: float, top: float) -> Manifold:
    return Manifold.cylinder(1.0, bottom / 2, top / 2, segments, True).rotate(_UPRIGHT)


@lru_cache(maxsize=64)
def _unit_sphere(segments: int) -> Manifold:
    return Manifold.sphere(0.5, segments)


@lru_cache(maxsize=64)
def _unit_prism(sides: int) -> Manifold:
    return _unit_cone(sides, 1.0, 1.0).rotate((0.0, 180.0 / sides - 90.0, 0.0))  # a side, not a corner, in front
