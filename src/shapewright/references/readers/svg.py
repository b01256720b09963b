"""Drawings in SVG files: what their shapes and strokes paint dark, as an area."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from typing import Any, cast

import numpy as np
import shapely

from shapewright.references.errors import UnreadableError
from shapewright.shapes import Drawing, Floats

_STEPS = 16
"""Chords to a curve of a path: an arc of 90 degrees departs from them by 0.1 % of its radius."""
_CAPS = {"butt": "flat", "round": "round", "square": "square"}
_JOINS = {"miter": "mitre", "round": "round", "bevel": "bevel"}
_MITRE = 4.0
"""The limit of a mitre where none is given (SVG 2, "stroke-miterlimit")."""


def read_svg(data: bytes) -> tuple[Drawing, tuple[str, ...]]:
    """The dark area of a vector drawing, in its own units, y up, with notes on what was left out.

    Shapes are painted one over the other: dark ones add to the area, light ones cut from it. Text, pictures, clips,
    masks and filters are ignored. Raises UnreadableError where nothing dark remains.
    """
    from svgelements import SVG, Group, Image, Shape, Text

    parsed = SVG.parse(io.BytesIO(data), reify=True)
    ink: Any = shapely.Polygon()
    ignored: dict[str, int] = {}
    for element in parsed.elements():
        if isinstance(element, Text | Image):
            kind = type(element).__name__.lower()
            ignored[kind] = ignored.get(kind, 0) + 1
        if not isinstance(element, Shape) or isinstance(element, Group) or not _shown(element):
            continue
        for dark, area in _painted(element):
            ink = ink.union(area) if dark else ink.difference(area)
    parts = [part for part in shapely.get_parts(ink) if part.area > 0.0]
    if not parts:
        raise UnreadableError("nothing in it is dark: a drawing is dark on white")
    scale, left, top = _viewport(parsed)
    flipped = shapely.transform(shapely.union_all(parts), lambda points: (points - [left, top]) / [scale, -scale])
    notes = tuple(f"{count} x {kind} left out" for kind, count in ignored.items())
    return Drawing(cast("shapely.Polygon | shapely.MultiPolygon", flipped)), notes


def _viewport(parsed: Any) -> tuple[float, float, float]:
    """How the viewBox is shown: a scale, and the place of the origin. A stretched one counts as not scaled."""
    from svgelements import Matrix

    shown = Matrix(parsed.viewbox_transform or "")
    return (shown.a, shown.e, shown.f) if shown.a == shown.d and shown.a > 0.0 else (1.0, 0.0, 0.0)


def _shown(element: Any) -> bool:
    values = element.values
    hidden = values.get("display") == "none" or values.get("visibility") in ("hidden", "collapse")
    return not hidden and float(values.get("opacity") or 1.0) >= 0.5


def _painted(element: Any) -> Iterator[tuple[bool, Any]]:
    """Whether it is dark, and the area: of the fill, then of the stroke, where there is one."""
    values = element.values
    lines = list(_lines(element))
    fill, stroke = _is_dark(element.fill, values, "fill"), _is_dark(element.stroke, values, "stroke")
    rings = [line for line in lines if len(line) > 2]
    if fill is not None and rings:
        yield fill, _filled(rings, str(values.get("fill-rule", "nonzero")))
    width = float(element.stroke_width or 0.0)
    if stroke is not None and width > 0.0 and lines:
        cap, join = values.get("stroke-linecap", "butt"), values.get("stroke-linejoin", "miter")
        paths: list[Any] = [
            shapely.LinearRing(line) if len(line) > 3 and (line[0] == line[-1]).all() else shapely.LineString(line)
            for line in lines
            if len(line) > 1
        ]
        limit = float(values.get("stroke-miterlimit") or _MITRE)
        pen = {"cap_style": _CAPS.get(cap, "flat"), "join_style": _JOINS.get(join, "mitre"), "mitre_limit": limit}
        yield stroke, shapely.union_all([path.buffer(width / 2.0, **pen) for path in paths])


def _is_dark(colour: Any, values: Any, kind: str) -> bool | None:
    """Of a fill or stroke; None where nothing is painted. Patterns and gradients count as dark."""
    if str(values.get(kind, "")).startswith("url("):
        return True
    if colour is None or colour.value is None or colour.opacity * float(values.get(f"{kind}-opacity") or 1.0) < 0.5:
        return None
    return bool(0.299 * colour.red + 0.587 * colour.green + 0.114 * colour.blue < 128.0)  # luma of ITU-R BT.601


def _lines(element: Any) -> Iterator[Floats]:
    """Every part of a path as points (N, 2), without repeated ones."""
    from svgelements import Close, Line, Move, Path

    for part in Path(element).as_subpaths():
        points: list[tuple[float, float]] = []
        for segment in part:
            if isinstance(segment, Move | Line | Close):
                ends = [segment.end]
            else:
                ends = [segment.point(i / _STEPS) for i in range(1, _STEPS + 1)]
            points += [(float(end.x), float(end.y)) for end in ends if end is not None]
        line = np.array(points, dtype=np.float64).reshape(-1, 2)
        if not np.isfinite(line).all():
            raise UnreadableError("broken: some coordinates are not finite")
        if len(line):
            yield line[np.concatenate([[True], (np.diff(line, axis=0) != 0.0).any(axis=1)])]


def _filled(rings: Sequence[Floats], rule: str) -> Any:
    """The area in closed lines, which may cross, by the fill rule of SVG: "nonzero" or "evenodd"."""
    closed = [ring if (ring[0] == ring[-1]).all() else np.concatenate([ring, ring[:1]]) for ring in rings]
    if len(closed) == 1 and (simple := shapely.Polygon(closed[0])).is_valid:
        return simple
    lines = shapely.union_all([shapely.LineString(ring) for ring in closed])
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(lines)))
    inside = [face for face in faces if _counts(_winding(closed, face.representative_point()), rule)]
    return shapely.union_all(inside)


def _counts(winding: int, rule: str) -> bool:
    return winding % 2 == 1 if rule == "evenodd" else winding != 0


def _winding(rings: Sequence[Floats], point: Any) -> int:
    """How often closed lines go round a point, counter-clockwise."""
    total = 0
    for ring in rings:
        (x, y), (dx, dy) = (ring[:-1] - [point.x, point.y]).T, np.diff(ring, axis=0).T
        side = dx * -y - dy * -x
        upward, downward = (y <= 0.0) & (y + dy > 0.0), (y > 0.0) & (y + dy <= 0.0)
        total += int((upward & (side > 0.0)).sum() - (downward & (side < 0.0)).sum())
    return total
