"""A drawing in an SVG file as the area of what it paints dark."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
import shapely

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.svg import coordinates, servers
from shapewright.references.readers.svg.coordinates import Viewport, matrix
from shapewright.references.readers.svg.document import Document, parse
from shapewright.references.readers.svg.figures import Place
from shapewright.references.readers.svg.painting import cells, layers
from shapewright.references.readers.svg.painting.layers import Fill, Item, Layer
from shapewright.references.readers.svg.painting.paints import LUMA
from shapewright.references.readers.svg.resources import cut, rectangle
from shapewright.references.readers.svg.scene import Scene
from shapewright.shapes import Drawing, Floats

_WITHOUT_SIZE = Viewport(100.0, 100.0)
"""What percentages refer to in a file that tells neither a size nor a view box."""


def read_svg(data: bytes) -> tuple[Drawing, tuple[str, ...]]:
    """The dark area of a vector drawing, in its own units, y up, with notes on what was left out.

    It is what a viewer shows on white paper, inside the page, where that is darker than half. A drawing of light
    shapes on a page that is dark all over is read the other way round, with a note. Raises UnreadableError, with the
    reason, where nothing dark remains or the file is no SVG.
    """
    document = parse(data)
    scene = Scene(document)
    frame, page, view = _page(document)
    root = Place(frame, view, {})
    style = scene.cascade.style(document.root, {})
    items = scene.root(document.root, root)
    back = servers.solid(style.get("background-color", style.get("background", "none")), style, 1.0)
    if back is not None and page is not None:
        items = (Fill(rectangle(matrix(), page), back), *items)
    notes = [f"{count} x {what}{'' if ',' in what else ' left out'}" for what, count in scene.notes.items()]
    try:
        ink, more = _ink(items, page)
    except UnreadableError as error:
        raise UnreadableError(f"{error}{'; ' * bool(notes)}{', '.join(notes)}") from None
    scale = frame[0, 0]
    own = coordinates.inverse(frame) if scale == frame[1, 1] else matrix()
    geometry = shapely.transform(ink, lambda points: coordinates.apply(own, points) * [1.0, -1.0])
    return Drawing(cast("shapely.Polygon | shapely.MultiPolygon", geometry)), (*notes, *more)


def _page(document: Document) -> tuple[Floats, Floats | None, Viewport]:
    """The matrix from the drawing's space to the page, in pixels; the page (2, 2), if it has a size; and its view."""
    root = document.root
    box = coordinates.view_box(root.get("viewBox"))
    sides: list[float | None] = []
    for key in ("width", "height"):
        text = root.get(key, "auto").strip()
        try:
            sides.append(None if text == "auto" or text.endswith("%") else _WITHOUT_SIZE.length(text, "x"))
        except ValueError:
            sides.append(None)
    if any(side is not None and not side > 0.0 for side in sides):
        raise UnreadableError("its page has no size: its width or its height is not above 0")
    width, height = sides
    if box is None:
        if width is None or height is None:
            return matrix(), None, Viewport(width or _WITHOUT_SIZE.width, height or _WITHOUT_SIZE.height)
        return matrix(), np.array([[0.0, 0.0], [width, height]]), Viewport(width, height)
    if width is None:
        width = box[2] if height is None else box[2] * height / box[3]
    if height is None:
        height = box[3] * width / box[2]
    frame = coordinates.fitted(box, width, height, root.get("preserveAspectRatio"))
    return frame, np.array([[0.0, 0.0], [width, height]]), Viewport(*box[2:])


def _ink(items: tuple[Item, ...], page: Floats | None) -> tuple[Any, list[str]]:
    """The dark area on the page, and notes on how it was found."""
    extent = layers.extent(items)
    if extent is None:
        raise UnreadableError(_NOTHING)
    shown = extent if page is None else np.stack([np.maximum(extent[0], page[0]), np.minimum(extent[1], page[1])])
    if not (shown[1] > shown[0]).all():
        raise UnreadableError("nothing in it is dark on its page: it draws outside of it")
    if page is not None:
        items = cut(items, matrix(), page)
    fills = list(layers.fills(items))
    if not any(fill.paint is not None for fill in fills):
        raise UnreadableError(_NOTHING)
    parts = cells.divided(fills, shown)
    ink = parts.dark(layers.composed(items, parts))
    notes = []
    if isinstance(parts, cells.Grid):
        notes.append(f"so many lines that it is read as a picture of {cells.MOST} pixels")
    whole = extent if page is None else page
    if _dark_page(items, whole):
        rest = shapely.box(*whole.ravel()).difference(ink)
        if _LEAST_LIGHT < rest.area / np.ptp(whole, axis=0).prod() < 0.5:  # beyond a half it is the paper in a frame
            return rest, [*notes, "light on a dark page, read as dark on light"]
    polygons = [part for part in shapely.get_parts(ink) if part.area > 0.0]
    if not polygons:
        raise UnreadableError(_NOTHING)
    return (polygons[0] if len(polygons) == 1 else shapely.MultiPolygon(polygons)), notes


def _dark_page(items: tuple[Item, ...], page: Floats) -> bool:
    """Whether the first thing that is painted is dark and covers the page."""
    for item in items:
        if isinstance(item, Layer):
            return item.mask is None and item.opacity == 1.0 and _dark_page(item.items, page)
        if item.paint is not None:
            middle = page.mean(axis=0)
            inner = shapely.box(*(middle + (page - middle) * 0.99).ravel())
            colours, alpha = item.paint.at(shapely.get_coordinates(inner))
            dark = (alpha * (1.0 - colours @ LUMA) > 0.5).all()
            return bool(dark) and len(item.area.rings) == 1 and shapely.Polygon(item.area.rings[0]).covers(inner)
    return False


_LEAST_LIGHT = 1e-4
"""Of a dark page: less is what rounding leaves at its rim."""
_NOTHING = "nothing in it is dark: a drawing is dark on white"
