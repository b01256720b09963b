"""Gradients and patterns as the file describes them: with units, templates and stops."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.references.readers.svg import coordinates
from shapewright.references.readers.svg.coordinates import Viewport, apply, inverse, matrix
from shapewright.references.readers.svg.document import Document, Element, link, name
from shapewright.references.readers.svg.painting.paints import Gradient, Paint, Solid
from shapewright.references.readers.svg.styles import Cascade, colour
from shapewright.shapes import Floats

_UNIT = Viewport(1.0, 1.0)
MOST_TILES = 2000
"""Of a pattern, as many as it has on a page of 1,000 pixels with tiles of 22."""


def templates(document: Document, element: Element) -> Iterator[Element]:
    """A gradient or pattern and those that it refers to, each for what the ones before do not say."""
    seen: list[Element] = []
    while element is not None and element not in seen:
        seen.append(element)
        yield element
        target = link(element) or ""
        element = document.by_id.get(target[1:]) if target.startswith("#") else None


def attribute(chain: Sequence[Element], key: str, default: str = "") -> str:
    """What the first of some templates says."""
    return next((str(value) for one in chain if (value := one.get(key)) is not None), default)


def boxed(box: Floats | None) -> Floats | None:
    """The matrix from the unit square to a bounding box; None where the box has no area."""
    if box is None or not (np.ptp(box, axis=0) > 0.0).all():
        return None
    (left, top), (width, height) = box[0], box[1] - box[0]
    return matrix(width, 0.0, 0.0, height, left, top)


def fraction(text: str | None, default: float = 1.0) -> float:
    """A number or a percentage, from 0 to 1; the default where it is neither."""
    try:
        value = float(text[:-1]) / 100.0 if text and text.endswith("%") else float(text or default)
    except ValueError:
        return default
    return min(max(value, 0.0), 1.0) if np.isfinite(value) else default


def solid(value: str, style: Mapping[str, str], opacity: float) -> Solid | None:
    """A plain colour, ``currentColor`` among them; None for none."""
    found = colour(value)
    if found is not None and found[0] < 0.0:
        found = colour(style.get("color", "black"))
        found = (0.0, 0.0, 0.0, 1.0) if found is None or found[0] < 0.0 else found
    return None if found is None else Solid(found[:3], found[3] * opacity)


def gradient(
    chain: Sequence[Element], cascade: Cascade, box: Floats | None, page: Floats, view: Viewport
) -> Paint | None:
    """The paint of a gradient; None where it paints nothing.

    Args:
        chain: its templates.
        cascade: tells the styles of its stops.
        box: (2, 2), the element's bounding box in its own space.
        page: (3, 3), from that space to the page.
        view: what percentages refer to in that space.

    Raises ValueError for lengths or transforms that are not understood.
    """
    offsets, colours = _stops(chain, cascade)
    if not len(offsets):
        return None
    kind, units = name(chain[0]), attribute(chain, "gradientUnits", "objectBoundingBox")
    frame = page
    if units != "userSpaceOnUse":
        unit = boxed(box)
        if unit is None:
            return None
        frame, view = page @ unit, _UNIT
    frame = frame @ coordinates.transform(attribute(chain, "gradientTransform"))
    if not abs(np.linalg.det(frame)) > 0.0:
        return None
    last = Solid((float(colours[-1, 0]), float(colours[-1, 1]), float(colours[-1, 2])), float(colours[-1, 3]))
    if len(offsets) == 1:
        return last

    def length(key: str, axis: str, default: str) -> float:
        own = [one for one in chain if name(one) == kind]  # a radial one takes no x1 of a linear one
        return view.length(attribute(own, key, default), axis)

    spread = attribute(chain, "spreadMethod", "pad")
    if kind == "linearGradient":
        x, y = length("x1", "x", "0%"), length("y1", "y", "0%")
        dx, dy = length("x2", "x", "100%") - x, length("y2", "y", "0%") - y
        if dx == dy == 0.0:
            return last
        frame = frame @ matrix(dx, dy, -dy, dx, x, y)
        return Gradient(offsets, colours, inverse(frame), spread)
    cx, cy, r = length("cx", "x", "50%"), length("cy", "y", "50%"), length("r", "", "50%")
    fx, fy, fr = (
        length(key, axis, str(value)) for key, axis, value in (("fx", "x", cx), ("fy", "y", cy), ("fr", "", 0.0))
    )
    if not r > 0.0:
        return last
    fr = max(fr, 0.0)
    away = np.hypot(fx - cx, fy - cy)
    if away + fr > r * 0.999:  # a focus outside is moved to the rim (SVG 1.1)
        share = max(r * 0.999 - fr, 0.0) / max(away, 1e-12)
        fx, fy = cx + (fx - cx) * min(share, 1.0), cy + (fy - cy) * min(share, 1.0)
    return Gradient(offsets, colours, inverse(frame), spread, (fx, fy, fr, cx, cy, r))


@dataclass(frozen=True)
class Tiling:
    """Where the tiles of a pattern lie.

    Attributes:
        places: (3, 3) each, from a tile whose corner is at (0, 0) to the page.
        size: width and height of a tile.
        content: (3, 3), from the space of the pattern's elements to a tile.
    """

    places: Sequence[Floats]
    size: tuple[float, float]
    content: Floats


def tiling(chain: Sequence[Element], frame: Floats, view: Viewport, box: Floats, bounds: Floats) -> Tiling | None:
    """The tiles of a pattern that are needed; None where it paints nothing.

    Args:
        chain: its templates.
        frame: (3, 3), from its space to the page.
        view: what percentages refer to in the space of the element that has it.
        box: (2, 2), the element's bounding box in its own space.
        bounds: (2, 2), around what is to be covered on the page.

    Raises ValueError for lengths that are not understood.
    """
    unit = boxed(box)
    units = attribute(chain, "patternUnits", "objectBoundingBox")
    within = attribute(chain, "patternContentUnits", "userSpaceOnUse")
    relative = units != "userSpaceOnUse"
    view_box = coordinates.view_box(attribute(chain, "viewBox"))
    x, y, width, height = (
        (_UNIT if relative else view).length(attribute(chain, key, "0"), axis)
        for key, axis in (("x", "x"), ("y", "y"), ("width", "x"), ("height", "y"))
    )
    content = np.eye(3)
    if unit is not None:
        if relative:
            (x, y), (width, height) = apply(unit, np.array([x, y])), np.diag(unit)[:2] * [width, height]
        if within == "objectBoundingBox":
            content = matrix(a=unit[0, 0], d=unit[1, 1])
    elif relative or within == "objectBoundingBox":
        return None
    if not (width > 0.0 and height > 0.0 and abs(np.linalg.det(frame)) > 0.0):
        return None
    if view_box:
        content = coordinates.fitted(view_box, width, height, attribute(chain, "preserveAspectRatio"))
    corners = apply(inverse(frame), np.array([[a, b] for a in bounds[:, 0] for b in bounds[:, 1]]))
    low = np.floor((corners.min(axis=0) - [x, y]) / [width, height]).astype(int)
    high = np.ceil((corners.max(axis=0) - [x, y]) / [width, height]).astype(int)
    steps = ((column, row) for row in range(low[1], high[1]) for column in range(low[0], high[0]))
    some = itertools.islice(steps, MOST_TILES + 1)
    places = [frame @ matrix(e=x + column * width, f=y + row * height) for column, row in some]
    return Tiling(places, (width, height), content)


def _stops(chain: Sequence[Element], cascade: Cascade) -> tuple[Floats, Floats]:
    """Offsets (S,), ascending, and colours (S, 4)."""
    owner = next((one for one in chain if any(name(child) == "stop" for child in one)), None)
    offsets: list[float] = []
    colours: list[tuple[float, ...]] = []
    for stop in owner if owner is not None else ():
        if name(stop) != "stop":
            continue
        own = cascade.style(stop, cascade.inherited(stop))
        paint = solid(own.get("stop-color", "black"), own, fraction(own.get("stop-opacity")))
        offsets.append(max(fraction(stop.get("offset"), 0.0), *offsets[-1:], 0.0))
        colours.append((*paint.rgb, paint.alpha) if paint else (0.0, 0.0, 0.0, 0.0))
    return np.array(offsets), np.array(colours).reshape(-1, 4)
