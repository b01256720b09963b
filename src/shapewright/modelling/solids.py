"""Solids to write procedures with: primitives, moves and booleans whose results are closed and keep their labels.

Space is Y up with the front towards +Z, in units of your own. Every primitive takes its ``size`` (width along x, height
along y, depth along z; one number for three equal ones), which it fills, and ``at``, where its centre goes:

    top = cylinder((1, 0.05, 0.6), at=(0, 0.7, 0)).label("top")
    leg = box((0.06, 0.7, 0.06), at=(0.3, 0.35, 0.2))
    table = top | leg.mirror("x", keep=True).mirror("z", keep=True).label("legs")

Angles are degrees, counter-clockwise when the axis points at you. A Solid never changes: each verb returns a new one.
The booleans are those of manifold3d, which evaluates them when a mesh, a volume, bounds or a label is asked for.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, Literal, TypeAlias

import numpy as np
from manifold3d import CrossSection, Error, FillRule, Manifold, OpType
from numpy.typing import ArrayLike

from shapewright.shapes import Floats, Mesh

Axis: TypeAlias = Literal["x", "y", "z"]
Vector: TypeAlias = Sequence[float] | Floats
Polygon: TypeAlias = Any
"""Points (N, 2); or several such rings, of which one inside another is a hole; or a shapely Polygon or MultiPolygon."""

ORIGIN = (0.0, 0.0, 0.0)
_AXES: Mapping[str, tuple[float, float, float]] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_UPRIGHT = (-90.0, 0.0, 0.0)  # turns manifold3d's z, along which it extrudes and revolves, into our y


@dataclass(frozen=True, slots=True, eq=False)
class Solid:
    """A closed volume, possibly empty, whose faces know the label of the part that they came from.

    manifold: the geometry; wrap a manifold3d.Manifold of your own as ``Solid(manifold)``.
    labels: the label of each original of manifold3d (the ids in ``run_original_id``) that has one.
    """

    manifold: Manifold
    labels: Mapping[int, str] = field(default_factory=dict)

    def label(self, name: str) -> Solid:
        """The same solid as one part called ``name``; it replaces the labels it had."""
        original = self.manifold.as_original()
        return Solid(original, {original.original_id(): name})

    def __or__(self, other: Solid) -> Solid:
        """Union."""
        if not isinstance(other, Solid):
            return NotImplemented
        return Solid(self.manifold + other.manifold, {**self.labels, **other.labels})

    def __and__(self, other: Solid) -> Solid:
        """Intersection."""
        if not isinstance(other, Solid):
            return NotImplemented
        return Solid(self.manifold ^ other.manifold, {**self.labels, **other.labels})

    def __sub__(self, other: Solid) -> Solid:
        """Difference; the faces of a cut bear the label of what cut them."""
        if not isinstance(other, Solid):
            return NotImplemented
        return Solid(self.manifold - other.manifold, {**self.labels, **other.labels})

    def translate(self, by: Vector) -> Solid:
        return Solid(self.manifold.translate(_vector("translate", "by", by)), self.labels)

    def rotate(self, degrees: float, axis: Axis = "y", about: Vector = ORIGIN) -> Solid:
        turn = _number("rotate", "degrees", degrees)
        x, y, z = _axis("rotate", axis)
        return self._about("rotate", about, lambda manifold: manifold.rotate((turn * x, turn * y, turn * z)))

    def scale(self, factor: float | Vector, about: Vector = ORIGIN) -> Solid:
        """Larger or smaller by a positive factor, or by one along each axis."""
        factors = _size("scale", factor, "factor")
        return self._about("scale", about, lambda manifold: manifold.scale(factors))

    def mirror(self, axis: Axis, keep: bool = False, about: Vector = ORIGIN) -> Solid:
        """The mirror image along an axis; ``keep`` unites it with the original."""
        normal = _axis("mirror", axis)
        image = self._about("mirror", about, lambda manifold: manifold.mirror(normal))
        return self | image if keep else image

    def array(self, count: int, step: Vector) -> Solid:
        """The union of ``count`` copies, each ``step`` further than the one before, from where this one is."""
        x, y, z = _vector("array", "step", step)
        return union(*(self.translate((i * x, i * y, i * z)) for i in range(_count("array", count, 1))))

    def polar_array(self, count: int, axis: Axis = "y", about: Vector = ORIGIN) -> Solid:
        """The union of ``count`` copies spread evenly around an axis, the first of them where this one is."""
        return union(*(self.rotate(360 * i / count, axis, about) for i in range(_count("polar_array", count, 1))))

    def mesh(self) -> Mesh:
        """Closed triangles, wound counter-clockwise seen from outside, with the labels; without faces if empty."""
        if self.manifold.status() != Error.NoError:
            raise ValueError(f"the solid has no geometry: manifold3d reports {self.manifold.status().name}")
        mesh = self.manifold.simplify(0.0).to_mesh64()  # booleans of flush faces leave triangles without area
        vertices, faces = mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64)
        if not self.labels:
            return Mesh(vertices, faces)
        lengths = np.diff(mesh.run_index) // 3
        runs = [self.labels.get(original) for original in mesh.run_original_id]
        present = {name for name, length in zip(runs, lengths, strict=True) if length}
        names = tuple(dict.fromkeys(name for name in self.labels.values() if name in present))
        index: dict[str | None, int] = {name: i for i, name in enumerate(names)}
        return Mesh(vertices, faces, np.repeat([index.get(name, -1) for name in runs], lengths), names)

    @property
    def volume(self) -> float:
        return float(self.manifold.volume())

    @property
    def bounds(self) -> Floats:
        """(2, 3): the least and the greatest corner. Raises ValueError for an empty solid."""
        if self.manifold.is_empty():
            raise ValueError("an empty solid has no bounds")
        return np.array(self.manifold.bounding_box(), dtype=np.float64).reshape(2, 3)

    def _about(self, function: str, about: Vector, move: Callable[[Manifold], Manifold]) -> Solid:
        x, y, z = _vector(function, "about", about)
        if x == y == z == 0.0:
            return Solid(move(self.manifold), self.labels)
        return Solid(move(self.manifold.translate((-x, -y, -z))).translate((x, y, z)), self.labels)

    def __repr__(self) -> str:
        return f"Solid({', '.join([f'{self.manifold.num_tri()} triangles', *dict.fromkeys(self.labels.values())])})"


def union(*solids: Solid) -> Solid:
    """All of them as one. Raises ValueError when there is none."""
    if not solids:
        raise ValueError("union: there is nothing to unite")
    labels = {original: name for solid in solids for original, name in solid.labels.items()}
    return Solid(Manifold.batch_boolean([solid.manifold for solid in solids], OpType.Add), labels)


def box(size: float | Vector, at: Vector = ORIGIN) -> Solid:
    return _place("box", Manifold.cube((1.0, 1.0, 1.0), True), size, at)


def cylinder(size: float | Vector, at: Vector = ORIGIN, segments: int = 32) -> Solid:
    """Upright; elliptical when width and depth differ."""
    return _place("cylinder", _unit_cone(_count("cylinder", segments, 3, "segments"), 1.0, 1.0), size, at)


def cone(size: float | Vector, at: Vector = ORIGIN, top: float = 0.0, bottom: float = 1.0, segments: int = 32) -> Solid:
    """Upright; ``top`` and ``bottom`` say which part of the width and depth each end has, from 0 (a point) to 1."""
    ends = _number("cone", "bottom", bottom), _number("cone", "top", top)
    if min(ends) < 0.0 or max(ends) > 1.0 or max(ends) == 0.0:
        raise ValueError(f"cone: top={top!r}, bottom={bottom!r} must lie in 0..1, and not both be 0")
    return _place("cone", _unit_cone(_count("cone", segments, 3, "segments"), *ends), size, at)


def sphere(size: float | Vector, at: Vector = ORIGIN, segments: int = 32) -> Solid:
    """An ellipsoid when the extents differ; ``segments`` around, rounded up to a multiple of four."""
    return _place("sphere", _unit_sphere(_count("sphere", segments, 3, "segments")), size, at)


def prism(size: float | Vector, at: Vector = ORIGIN, sides: int = 6) -> Solid:
    """Upright with a regular polygon as its plan, inscribed in the ellipse of width and depth, a flat side in front."""
    return _place("prism", _unit_prism(_count("prism", sides, 3, "sides")), size, at)


def extrude(
    polygon: Polygon,
    height: float,
    at: Vector = ORIGIN,
    twist: float = 0.0,
    taper: float | tuple[float, float] = 1.0,
    segments: int = 32,
) -> Solid:
    """A plan of points (x, z), given height: half of it above ``at``, half below; the plan's origin goes to ``at``.

    twist: how far the top is turned about y; it takes ``segments`` steps for a whole turn.
    taper: scale of the top, the same or one each along x and z; 0 ends in a point.
    Raises ValueError for a plan without area, and for sizes that are not positive numbers.
    """
    up = _number("extrude", "height", height)
    if up <= 0.0:
        raise ValueError(f"extrude: height={height!r} must be positive")
    x, z = taper if isinstance(taper, Sequence) else (taper, taper)
    scale = _number("extrude", "taper", x), _number("extrude", "taper", z)
    if min(scale) < 0.0 or (0.0 in scale and max(scale) > 0.0):
        raise ValueError(f"extrude: taper={taper!r} must be positive, or 0 for a point")
    turn = _number("extrude", "twist", twist)
    steps = math.ceil(abs(turn) / 360.0 * _count("extrude", segments, 3, "segments"))
    plan = _cross_section("extrude", polygon, (1.0, -1.0))
    solid = Manifold.extrude(plan, up, max(steps - 1, 0), turn, scale)
    return Solid(solid.translate((0.0, 0.0, -up / 2)).rotate(_UPRIGHT).translate(_vector("extrude", "at", at)))


def revolve(profile: Polygon, at: Vector = ORIGIN, degrees: float = 360.0, segments: int = 32) -> Solid:
    """A profile of points (r, y), r >= 0, turned about the y axis, from +x on; its origin goes to ``at``.

    Raises ValueError for a profile without area or with points beyond the axis, and for degrees outside 0..360.
    """
    turn = _number("revolve", "degrees", degrees)
    if not 0.0 < turn <= 360.0:
        raise ValueError(f"revolve: degrees={degrees!r} must lie above 0 and up to 360")
    section = _cross_section("revolve", profile)
    if section.bounds()[0] < 0.0:
        raise ValueError(f"revolve: the profile reaches r={section.bounds()[0]:.4g}; r must not be negative")
    solid = Manifold.revolve(section, _count("revolve", segments, 3, "segments"), turn)
    return Solid(solid.rotate(_UPRIGHT).translate(_vector("revolve", "at", at)))


def _place(function: str, unit: Manifold, size: float | Vector, at: Vector) -> Solid:
    return Solid(unit.scale(_size(function, size)).translate(_vector(function, "at", at)))


@lru_cache(maxsize=64)
def _unit_cone(segments: int, bottom: float, top: float) -> Manifold:
    return Manifold.cylinder(1.0, bottom / 2, top / 2, segments, True).rotate(_UPRIGHT)


@lru_cache(maxsize=64)
def _unit_sphere(segments: int) -> Manifold:
    return Manifold.sphere(0.5, segments)


@lru_cache(maxsize=64)
def _unit_prism(sides: int) -> Manifold:
    return _unit_cone(sides, 1.0, 1.0).rotate((0.0, 180.0 / sides - 90.0, 0.0))  # a side, not a corner, in front


def _cross_section(function: str, polygon: Polygon, signs: tuple[float, float] = (1.0, 1.0)) -> CrossSection:
    rings = [np.asarray(ring, dtype=np.float64) for ring in _rings(polygon)]
    for ring in rings:
        if ring.ndim != 2 or ring.shape[1] != 2 or len(ring) < 3 or not np.isfinite(ring).all():
            raise ValueError(f"{function}: a polygon is at least three finite points (N, 2), not {ring.tolist()!r}")
    section = CrossSection([ring * signs for ring in rings], FillRule.EvenOdd)
    if section.is_empty():
        raise ValueError(f"{function}: the polygon has no area")
    return section


def _rings(polygon: Polygon) -> list[ArrayLike]:
    if hasattr(polygon, "geom_type"):
        parts = getattr(polygon, "geoms", [polygon])
        return [ring.coords for part in parts for ring in (part.exterior, *part.interiors)]
    points = list(polygon)
    return points if points and np.ndim(points[0]) == 2 else [points]


def _size(function: str, size: float | Vector, name: str = "size") -> tuple[float, float, float]:
    extents = size if isinstance(size, Sequence | np.ndarray) else (size, size, size)
    x, y, z = _vector(function, name, extents)
    if min(x, y, z) <= 0.0:
        raise ValueError(f"{function}: {name}={size!r} must be positive")
    return x, y, z


def _vector(function: str, name: str, value: Vector) -> tuple[float, float, float]:
    try:
        x, y, z = map(float, value)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{function}: {name}={value!r} must be three numbers (x, y, z)") from error
    if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(z)):
        raise ValueError(f"{function}: {name}={value!r} must be finite")
    return x, y, z


def _number(function: str, name: str, value: float) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{function}: {name}={value!r} must be finite")
    return number


def _count(function: str, value: int, least: int, name: str = "count") -> int:
    if value != int(value) or value < least:
        raise ValueError(f"{function}: {name}={value!r} must be a whole number of at least {least}")
    return int(value)


def _axis(function: str, axis: Axis) -> tuple[float, float, float]:
    if axis not in _AXES:
        raise ValueError(f"{function}: axis={axis!r} must be 'x', 'y' or 'z'")
    return _AXES[axis]
