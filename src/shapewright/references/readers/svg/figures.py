"""One shape of a document: its measures, its path and the pen that draws it, by its attributes and its style."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass

import numpy as np

from shapewright.references.readers.svg import coordinates
from shapewright.references.readers.svg.coordinates import ROOT_FONT, Viewport, apply, matrix
from shapewright.references.readers.svg.document import Element, name
from shapewright.references.readers.svg.lines import outlines
from shapewright.references.readers.svg.lines.paths import Path
from shapewright.references.readers.svg.lines.strokes import Stroke, stroked
from shapewright.references.readers.svg.painting import layers
from shapewright.references.readers.svg.painting.layers import Area
from shapewright.references.readers.svg.styles import Style
from shapewright.shapes import Floats

SHAPES = {"path", "rect", "circle", "ellipse", "line", "polyline", "polygon"}


@dataclass(frozen=True)
class Place:
    """Where an element is shown, and what it takes from there.

    Attributes:
        matrix: (3, 3), from its space to the page.
        view: what percentages refer to.
        style: of itself, or of its parent before its own is known.
        shown: the uses, patterns, masks, clips and markers that show it, outermost first.
        context: the place of the shape or ``use`` whose paints ``context-fill`` and ``context-stroke`` are, and the
            bounding box (2, 2) there.
        depth: of elements around it.
    """

    matrix: Floats
    view: Viewport
    style: Style
    shown: tuple[Element, ...] = ()
    context: tuple[Place, Floats] | None = None
    depth: int = 0

    @property
    def font(self) -> float:
        """The size of letters, in user units."""
        return float(self.style.get("font-size", ROOT_FONT))

    @property
    def visible(self) -> bool:
        return self.style.get("visibility", "visible") not in ("hidden", "collapse")


def length(text: str | None, axis: str, place: Place, notes: Counter[str]) -> float | None:
    """A length in user units; None where there is none, or "auto". One that is not understood is noted."""
    if text is None or text.strip() in ("", "auto"):
        return None
    try:
        value = place.view.length(text, axis, place.font, float(place.style.get("rem", ROOT_FONT)))
    except ValueError:
        value = np.nan
    if np.isfinite(value):
        return value
    notes["length that is not understood"] += 1
    return None


def path(element: Element, place: Place, notes: Counter[str]) -> Path | None:
    """The outline of a shape in its own space; None where it has none."""

    def measure(key: str, axis: str) -> float | None:
        return length(place.style.get(key, element.get(key)), axis, place, notes)

    kind = name(element)
    found, clean = outlines.outline(kind, measure, element.get("d" if kind == "path" else "points", ""))
    if not clean:
        notes["broken outline, drawn up to where it breaks"] += 1
    if found is None or not len(found.cubics):
        return None
    if not np.isfinite(found.cubics).all():
        notes["outline whose coordinates are not finite"] += 1
        return None
    return found


def filled(found: Path, place: Place, rule: str) -> Area | None:
    """The area inside a path, on the page; ``rule`` is the property that tells how."""
    lines = [apply(place.matrix, line) for line, _ in found.polylines]
    return layers.closed(lines, place.style.get(rule) == "evenodd")


def drawn(element: Element, found: Path, place: Place, notes: Counter[str]) -> Area | None:
    """The area of a path's stroke, on the page; None where the stroke has no width."""
    style = place.style
    width = length(style.get("stroke-width", "1"), "", place, notes)
    width = 1.0 if width is None else width
    if not width > 0.0:
        return None
    join, cap = style.get("stroke-linejoin", "miter"), style.get("stroke-linecap", "butt")
    if join in ("arcs", "miter-clip"):
        notes[f"stroke-linejoin {join}"] += 1
    try:
        limit = float(style.get("stroke-miterlimit", "4"))
    except ValueError:
        limit = 4.0
    stroke = Stroke(
        width,
        "round" if cap == "round" else "square" if cap == "square" else "butt",
        "round" if join == "round" else "bevel" if join == "bevel" else "miter",
        limit if limit >= 1.0 else 4.0,
        *_dashes(element, found, place, notes),
    )
    lines = found.polylines
    if style.get("vector-effect") == "non-scaling-stroke":
        moved = [(apply(place.matrix, line), closed) for line, closed in lines]
        return layers.united(stroked(moved, stroke), matrix())
    return layers.united(stroked(lines, stroke), place.matrix)


def _dashes(element: Element, found: Path, place: Place, notes: Counter[str]) -> tuple[tuple[float, ...], float]:
    """The lengths of dashes and gaps, an even number of them, and the offset; () for a whole line."""
    text = place.style.get("stroke-dasharray", "none")
    if text == "none":
        return (), 0.0
    lengths = [length(one, "", place, notes) for one in re.split(r"[\s,]+", text.strip()) if one]
    sound = [one for one in lengths if one is not None and one >= 0.0]
    if len(sound) != len(lengths) or not sum(sound) > 0.0:
        return (), 0.0
    offset = length(place.style.get("stroke-dashoffset"), "", place, notes) or 0.0
    scale, told = 1.0, element.get("pathLength")
    if told is not None and (given := length(told, "", place, notes)) is not None and given > 0.0:
        scale = found.length() / given
    return tuple(one * scale for one in sound * (1 + len(sound) % 2)), offset * scale


def moved(element: Element, place: Place, notes: Counter[str], usual: str = "none") -> Floats:
    """The matrix from an element's space to the page, with its own transform, or else the usual one."""
    text = place.style.get("transform", usual)
    if text == "none" or not text:
        return place.matrix
    try:
        own = coordinates.transform(text)
    except ValueError:
        notes["transform that is not understood"] += 1
        return place.matrix
    origin = place.style.get("transform-origin")
    if origin is not None:
        x, y = _origin(origin, place, notes)
        own = matrix(e=x, f=y) @ own @ matrix(e=-x, f=-y)
    result: Floats = place.matrix @ own
    return result


_SIDES = {"left": "0%", "top": "0%", "center": "50%", "right": "100%", "bottom": "100%"}


def _origin(text: str, place: Place, notes: Counter[str]) -> tuple[float, float]:
    words = text.split()[:2]
    if len(words) == 2 and (words[0] in ("top", "bottom") or words[1] in ("left", "right")):
        words.reverse()
    if len(words) == 1:
        words = ["center", words[0]] if words[0] in ("top", "bottom") else [words[0], "center"]
    x, y = (length(_SIDES.get(word, word), axis, place, notes) for word, axis in zip(words, "xy", strict=True))
    return x or 0.0, y or 0.0
