"""Deformations of space: bend, taper, twist, bulge and the like, as functions of points that say where they curve.

Each acts within a domain, the box that is deformed, and runs along one of its axes from the end at which t = 0 to the
end at t = 1; beyond the ends it goes on as it was there. Deformations are values: equal arguments give equal ones.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from shapewright.modelling import arguments
from shapewright.modelling.arguments import Point
from shapewright.modelling.curves import bernstein
from shapewright.shapes import Floats


class Domain(NamedTuple):
    """A box in space."""

    low: Point  # its corner with the least coordinates
    high: Point  # its corner with the greatest
    facing: tuple[int, int, int] = (1, 1, 1)  # -1 where it faces, and names its ends, against the axis

    @property
    def centre(self) -> Point:
        (ax, ay, az), (bx, by, bz) = self.low, self.high
        return (ax + bx) / 2.0, (ay + by) / 2.0, (az + bz) / 2.0

    @property
    def handed(self) -> int:
        """-1 when an odd number of its axes face against those of space: turns go the other way."""
        return self.facing[0] * self.facing[1] * self.facing[2]

    def along(self, function: str, axis: str) -> Along:
        index, sign = self.towards(function, axis)
        near, far = (self.low, self.high) if sign > 0 else (self.high, self.low)
        return Along(index, near[index], far[index] - near[index], self.centre)

    def towards(self, function: str, axis: str, name: str = "axis") -> tuple[int, int]:
        """The index of an axis of space, and the sign of a direction of this box along it."""
        index, sign = arguments.direction(function, axis, name)
        return index, sign * self.facing[index]

    @property
    def _domain(self) -> Domain:
        return self

    def _deformed(self, by: Deformation, tolerance: float) -> Deformation:
        return by


class Along(NamedTuple):
    """An axis of a domain, on which t runs from 0 to 1."""

    axis: int  # its index
    start: float  # the coordinate at t = 0
    length: float  # from there to t = 1; negative where the axis runs down
    centre: Point  # of the domain

    def t(self, points: Floats) -> Floats:
        return np.asarray(np.clip((points[:, self.axis] - self.start) / self.length, 0.0, 1.0))

    @property
    def across(self) -> tuple[int, int]:
        return (1, 2) if self.axis == 0 else (0, 2) if self.axis == 1 else (0, 1)


@dataclass(frozen=True, slots=True)
class Scale:
    """Sections across an axis, scaled about its middle by a Bezier curve of factors (taper, profile)."""

    along: Along
    factors: tuple[tuple[float, float], ...]

    def __call__(self, points: Floats) -> Floats:
        scale = bernstein(self.factors, self.along.t(points))
        moved = points.copy()
        for i, d in enumerate(self.along.across):
            moved[:, d] = self.along.centre[d] + (points[:, d] - self.along.centre[d]) * scale[:, i]
        return moved


@dataclass(frozen=True, slots=True)
class Shift:
    """Sections across an axis, moved by a Bezier curve of offsets (path)."""

    along: Along
    offsets: tuple[Point, ...]

    def __call__(self, points: Floats) -> Floats:
        return np.asarray(points + bernstein(self.offsets, self.along.t(points)))


@dataclass(frozen=True, slots=True)
class Twist:
    """Sections across an axis, turned about its middle; ``degrees`` at the far end."""

    along: Along
    degrees: float

    def __call__(self, points: Floats) -> Floats:
        angle = math.radians(self.degrees) * self.along.t(points)
        u, v = (self.along.axis + 1) % 3, (self.along.axis + 2) % 3
        x, y = points[:, u] - self.along.centre[u], points[:, v] - self.along.centre[v]
        moved = points.copy()
        moved[:, u] = self.along.centre[u] + np.cos(angle) * x - np.sin(angle) * y
        moved[:, v] = self.along.centre[v] + np.sin(angle) * x + np.cos(angle) * y
        return moved


@dataclass(frozen=True, slots=True)
class Bend:
    """The middle of the box bent to an arc of its own length, straight beyond the ends."""

    along: Along  # the axis that is bent
    degrees: float  # by which its far end is turned
    towards: int  # the index of the axis that it bends to
    sign: int  # 1 to the high end of that axis, -1 to the low end
    fixed: float  # the t of the section that stays in place

    def __call__(self, points: Floats) -> Floats:
        along, b = self.along, self.towards
        turn = math.radians(self.degrees)
        radius = abs(along.length) / turn
        t = (points[:, along.axis] - along.start) / along.length
        held = np.clip(t, 0.0, 1.0)
        angle = turn * (held - self.fixed)
        beyond = (t - held) * abs(along.length)
        aside = radius - self.sign * (points[:, b] - along.centre[b])
        moved = points.copy()
        forward = aside * np.sin(angle) + beyond * np.cos(angle)
        moved[:, along.axis] = along.start + along.length * self.fixed + math.copysign(1.0, along.length) * forward
        moved[:, b] = points[:, b] + self.sign * (aside * (1.0 - np.cos(angle)) + beyond * np.sin(angle))
        return moved


@dataclass(frozen=True, slots=True)
class Bulge:
    """A side pushed out in the middle, by ``height`` at most, and everything between it and the other side with it."""

    along: Along  # from the side that stays to the one that is pushed
    height: float  # how far its middle moves
    low: tuple[float, float]  # the least coordinates, across the axis, of the part that moves
    high: tuple[float, float]  # the greatest
    round: bool  # whether the part is the ellipse in that rectangle, not the rectangle

    def __call__(self, points: Floats) -> Floats:
        weights = []
        for i, d in enumerate(self.along.across):
            middle, half = (self.low[i] + self.high[i]) / 2.0, (self.high[i] - self.low[i]) / 2.0
            weights.append(np.minimum(((points[:, d] - middle) / half) ** 2, 1.0))
        rise = np.maximum(1.0 - weights[0] - weights[1], 0.0) if self.round else (1.0 - weights[0]) * (1.0 - weights[1])
        moved = points.copy()
        moved[:, self.along.axis] += math.copysign(1.0, self.along.length) * self.height * rise * self.along.t(points)
        return moved


@dataclass(frozen=True, slots=True)
class Turn:
    """A rotation about an axis through a point: straight lines stay straight."""

    axis: int
    degrees: float
    about: Point

    def __call__(self, points: Floats) -> Floats:
        u, v, angle = (self.axis + 1) % 3, (self.axis + 2) % 3, math.radians(self.degrees)
        matrix = np.eye(3)
        matrix[u, u] = matrix[v, v] = math.cos(angle)
        matrix[v, u], matrix[u, v] = math.sin(angle), -math.sin(angle)
        return np.asarray((points - self.about) @ matrix.T + self.about)


@dataclass(frozen=True, slots=True)
class Free:
    """Any function of points, given in coordinates from ``centre`` along axes that face as ``facing`` says."""

    function: Callable[[Floats], Floats]
    centre: Point
    facing: tuple[int, int, int]

    def __call__(self, points: Floats) -> Floats:
        moved = np.asarray(self.function((points - self.centre) * self.facing), dtype=np.float64)
        if moved.shape != points.shape or not np.isfinite(moved).all():
            raise ValueError(f"deform: the function must give finite points of the form {points.shape}")
        return moved * self.facing + self.centre


Deformation: TypeAlias = Scale | Shift | Twist | Bend | Bulge | Turn | Free
