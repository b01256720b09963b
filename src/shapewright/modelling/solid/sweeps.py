"""Solids that a section sweeps: extrude, revolve, loft, and sweep along a path."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from shapewright.modelling.arguments import ORIGIN, Vector, count, number, pair, positive, vector
from shapewright.modelling.curves import TOLERANCE, bernstein, knots, smooth
from shapewright.modelling.solid.sections import Polygon, Section, section
from shapewright.modelling.solid.solid import Solid, solid_of
from shapewright.shapes import Floats, Ints

_SAME_ANGLE = 1e-6  # radians: corners of two plans that are nearer, seen from the middle, are joined as one


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
    half = positive("extrude", "height", height) / 2.0
    scale = pair("extrude", "taper", taper)
    if min(scale) < 0.0 or (0.0 in scale and max(scale) > 0.0):
        raise ValueError(f"extrude: taper={taper!r} must be positive, or 0 for a point")
    turn = number("extrude", "twist", twist)
    steps = max(math.ceil(abs(turn) / 360.0 * count("extrude", segments, 3, "segments")), 1)
    plan = section("extrude", polygon)
    levels = []
    for t in np.linspace(0.0, 1.0, steps + 1):
        x, z = (plan.points * (1.0 - t + t * np.array(scale))).T
        angle = math.radians(turn) * t
        turned = [math.cos(angle) * x + math.sin(angle) * z, math.cos(angle) * z - math.sin(angle) * x]
        levels.append(np.stack([turned[0], np.full(len(x), half * (2.0 * t - 1.0)), turned[1]], axis=1))
    return skin(plan, np.stack(levels), at=vector("extrude", "at", at))


def revolve(profile: Polygon, at: Vector = ORIGIN, degrees: float = 360.0, segments: int = 32) -> Solid:
    """A profile of points (r, y), r >= 0, turned about the y axis, from +x on; its origin goes to ``at``.

    Raises ValueError for a profile without area or with points beyond the axis, and for degrees outside 0..360.
    """
    turn = number("revolve", "degrees", degrees)
    if not 0.0 < turn <= 360.0:
        raise ValueError(f"revolve: degrees={degrees!r} must lie above 0 and up to 360")
    half = section("revolve", profile)
    r, y = half.points.T
    if r.min() < 0.0:
        raise ValueError(f"revolve: the profile reaches r={r.min():.4g}; r must not be negative")
    whole = turn == 360.0
    steps = max(math.ceil(turn / 360.0 * count("revolve", segments, 3, "segments")), 1)
    angles = np.radians(turn) * np.arange(steps if whole else steps + 1) / steps
    levels = [np.stack([r * math.cos(a), y, -r * math.sin(a)], axis=1) for a in angles]
    return skin(half, np.stack(levels), whole, vector("revolve", "at", at))


def loft(
    sections: Sequence[Polygon],
    heights: Sequence[float],
    at: Vector = ORIGIN,
    smooth_between: bool = False,
    tolerance: float = TOLERANCE,
) -> Solid:
    """A solid through plans of points (x, z), each without holes, at heights that rise.

    Plans of equally many points are joined point by point, others at equal angles about their middles.
    smooth_between: run through the plans in smooth curves, not straight, within ``tolerance`` (a part of the largest
    extent). Raises ValueError for fewer than two plans, heights that do not rise, and plans that cannot be joined.
    """
    plans = [section("loft", polygon) for polygon in sections]
    levels = [number("loft", "height", height) for height in heights]
    if len(plans) < 2 or len(levels) != len(plans):
        raise ValueError(f"loft: {len(plans)} sections at {len(levels)} heights; it takes two or more, one height each")
    if any(b <= a for a, b in itertools.pairwise(levels)):
        raise ValueError(f"loft: heights={list(heights)!r} must rise")
    if any(len(plan.rings) > 1 for plan in plans):
        raise ValueError("loft: a section must be one ring; cut the hole out of the solid instead")
    rings = _matched([plan.rings[0] for plan in plans])
    stack = np.stack([np.insert(ring, 1, level, axis=1) for ring, level in zip(rings, levels, strict=True)])
    if smooth_between and len(stack) > 2:
        stack = smooth(stack, positive("loft", "tolerance", tolerance) * float(np.ptp(stack, axis=(0, 1)).max()))
    return skin(Section((rings[0],)), stack, at=vector("loft", "at", at))


def sweep(
    polygon: Polygon,
    path: Sequence[Sequence[float]] | Floats,
    twist: float = 0.0,
    scale: Sequence[float] = (1.0,),
    tolerance: float = TOLERANCE,
) -> Solid:
    """A section carried along a path of points (x, y, z), upright to it, with mitred corners.

    polygon: points (u, v): for someone who looks along the path, u to the right and v up; on a path that starts
    straight upwards u is x and v is z. path: a line of points, or a curve from ``bezier`` or ``spline``; one that
    returns to its first point makes a ring. twist: degrees, from one end to the other. scale: a Bezier curve of
    factors along the path. tolerance: of twist and scale, as a part of the path's largest extent.
    Raises ValueError for a path of fewer than two different points or one that turns straight back.
    """
    profile = section("sweep", polygon)
    points = np.asarray(path, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 3 or len(points) < 2 or not np.isfinite(points).all():
        raise ValueError("sweep: the path must be at least two finite points (x, y, z)")
    points = points[np.concatenate([[True], (np.diff(points, axis=0) != 0.0).any(axis=1)])]
    ring = len(points) > 3 and bool((points[0] == points[-1]).all())
    if len(points) < 2:
        raise ValueError("sweep: all points of the path are one")
    factors = [positive("sweep", "scale", factor) for factor in scale]
    turn = math.radians(number("sweep", "twist", twist))
    if ring and (turn or factors[0] != factors[-1]):
        raise ValueError("sweep: a path that returns to its start takes no twist, and equal scales at its ends")
    points, along = _subdivided(points, _growth(profile, factors, turn), tolerance)
    right, up, forward, mitre, closing = _frames(points, ring)
    size = bernstein([[factor] for factor in factors], along)
    angle = (turn - closing) * along[:, None]
    cos, sin = size * np.cos(angle), size * np.sin(angle)
    x, y = profile.points.T
    u, v = cos * x - sin * y, sin * x + cos * y
    across = u[..., None] * right[:, None] + v[..., None] * up[:, None]
    slant = np.einsum("kpd,kd->kp", across, mitre) / np.einsum("kd,kd->k", forward, mitre)[:, None]
    stack = points[:, None] + across - slant[..., None] * forward[:, None]
    return skin(profile, stack[:-1] if ring else stack, ring)


def _growth(profile: Section, factors: Sequence[float], turn: float) -> Floats:
    """(S, 1, 3): how the outermost point of a section moves across the path, at even steps along it."""
    t = np.linspace(0.0, 1.0, 65)
    reach = float(np.linalg.norm(profile.points, axis=1).max()) * bernstein([[factor] for factor in factors], t)[:, 0]
    return np.stack([reach * np.cos(turn * t), reach * np.sin(turn * t), np.zeros_like(t)], axis=1)[:, None]


def _subdivided(points: Floats, growth: Floats, tolerance: float) -> tuple[Floats, Floats]:
    """The path with points added where growth curves, and the part of its length at each point."""
    slack = positive("sweep", "tolerance", tolerance) * float(np.ptp(points, axis=0).max())
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    along = lengths / lengths[-1]
    new = [t for t in knots(growth, slack) if np.abs(along - t).min() > 1e-3]
    every = np.sort(np.concatenate([along, new]))
    line = np.stack([np.interp(every, along, points[:, d]) for d in range(3)], axis=1)
    line[np.searchsorted(every, along)] = points
    return line, every


def _frames(points: Floats, ring: bool) -> tuple[Floats, Floats, Floats, Floats, float]:
    """At each point of a path: right, up and forward (N, 3) of the stretch before it, the normal of its mitre (N, 3).

    The frame turns no more than the path does (parallel transport); the last value is the angle by which that turns it
    from the start to the end of a ring.
    """
    steps = np.diff(points, axis=0)
    steps /= np.linalg.norm(steps, axis=1)[:, None]
    first = steps[0]
    upright = np.array([0.0, 0.0, 1.0]) if abs(first[1]) > 0.999 else np.array([0.0, 1.0, 0.0])
    right = np.cross(first, upright)
    frame = right / np.linalg.norm(right)
    frames = [frame]
    for before, after in zip(steps, [*steps[1:], first] if ring else steps[1:], strict=False):
        if 1.0 + before @ after < 1e-3:
            raise ValueError("sweep: the path turns straight back")
        middle = before + after
        frame = frame - middle * (2.0 * (frame @ middle) / (middle @ middle))
        frames.append(frame)
    rights = np.stack([frames[0], *frames[: len(steps)]])
    forward = np.concatenate([steps[:1], steps])
    mitre = np.concatenate([steps[:1], steps[:-1] + steps[1:], steps[-1:]])
    ups = np.cross(rights, forward)
    if not ring:
        return rights, ups, forward, mitre, 0.0
    mitre[0] = mitre[-1] = steps[-1] + first
    return rights, ups, forward, mitre, math.atan2(float(frame @ ups[0]), float(frame @ rights[0]))


def skin(outline: Section, stack: Floats, ring: bool = False, at: Vector = ORIGIN) -> Solid:
    """The solid between copies of a section: stack (K, P, 3), its points in each copy.

    ring: the last copy is joined to the first; otherwise both are closed by a cap.
    """
    copies, size = len(stack), len(outline.points)
    points = (stack + np.asarray(at)).reshape(-1, 3)
    edges = outline.edges
    before = np.arange(copies if ring else copies - 1)
    after = (before + 1) % copies
    a, b = (before[:, None] * size + edges[:, 0]).ravel(), (before[:, None] * size + edges[:, 1]).ravel()
    c, d = (after[:, None] * size + edges[:, 1]).ravel(), (after[:, None] * size + edges[:, 0]).ravel()
    faces = [_quads(points, a, b, c, d)]
    if not ring:
        cap = outline.triangles()
        faces += [cap[:, ::-1], cap + size * (copies - 1)]
    return solid_of(points, np.concatenate(faces))


def _quads(points: Floats, a: Ints, b: Ints, c: Ints, d: Ints) -> Ints:
    """Two triangles for each quadrilateral a b c d, along its shorter diagonal."""
    first = np.square(points[a] - points[c]).sum(axis=1) <= np.square(points[b] - points[d]).sum(axis=1) * (1 + 1e-9)
    near = np.where(first[:, None], np.stack([a, b, c], axis=1), np.stack([a, b, d], axis=1))
    far = np.where(first[:, None], np.stack([a, c, d], axis=1), np.stack([b, c, d], axis=1))
    return np.concatenate([near, far])


def _matched(rings: Sequence[Floats]) -> list[Floats]:
    """The same outlines with equally many points, which are joined in order."""
    if len({len(ring) for ring in rings}) == 1:
        return list(rings)
    middles = [(ring.min(axis=0) + ring.max(axis=0)) / 2.0 for ring in rings]
    turned = [_from_the_right(ring - middle) for ring, middle in zip(rings, middles, strict=True)]
    angles = np.sort(np.concatenate([_angles(ring) for ring in turned]))
    angles = angles[np.diff(angles, prepend=-1.0) > _SAME_ANGLE]
    return [middle + _at_angles(ring, angles) for ring, middle in zip(turned, middles, strict=True)]


def _from_the_right(ring: Floats) -> Floats:
    """The ring, begun at its first point past the x axis. Raises ValueError where it is not seen from the origin."""
    start = int(_angles(ring).argmin())
    ring = np.roll(ring, -start, axis=0)
    if (np.diff(_angles(ring)) <= 0.0).any():
        raise ValueError("loft: sections of different numbers of points must each be seen whole from their middle")
    return ring


def _angles(ring: Floats) -> Floats:
    angles = np.arctan2(ring[:, 1], ring[:, 0])
    return np.asarray(np.where(angles < -_SAME_ANGLE, angles + 2.0 * math.pi, np.maximum(angles, 0.0)))


def _at_angles(ring: Floats, angles: Floats) -> Floats:
    """Where rays from the origin at these angles meet the ring; its own points where the angles are theirs."""
    own = _angles(ring)
    after = np.searchsorted(own, angles) % len(ring)
    before = after - 1
    ray = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    edge = ring[after] - ring[before]
    cross = ring[before, 0] * edge[:, 1] - ring[before, 1] * edge[:, 0]
    result = ray * (cross / (ray[:, 0] * edge[:, 1] - ray[:, 1] * edge[:, 0]))[:, None]
    rays, corners = np.nonzero(np.abs(angles[:, None] - own) <= _SAME_ANGLE)
    result[rays] = ring[corners]
    return np.asarray(result)
