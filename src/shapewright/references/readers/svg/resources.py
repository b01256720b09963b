"""What elements refer to: paints, patterns, markers, clips and masks, as what they paint in the element's place."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from shapewright.references.readers.svg import coordinates, figures, servers
from shapewright.references.readers.svg.coordinates import Viewport, apply, inverse, matrix
from shapewright.references.readers.svg.document import Document, Element, link, name
from shapewright.references.readers.svg.figures import SHAPES, Place
from shapewright.references.readers.svg.lines import outlines
from shapewright.references.readers.svg.lines.paths import Path
from shapewright.references.readers.svg.painting import layers
from shapewright.references.readers.svg.painting.layers import Area, Fill, Item, Layer, Mask
from shapewright.references.readers.svg.painting.paints import Solid
from shapewright.references.readers.svg.servers import attribute, boxed, fraction
from shapewright.references.readers.svg.styles import Cascade
from shapewright.shapes import Floats

_URL = re.compile(r"""url\(\s*['"]?\s*([^'")]*?)\s*['"]?\s*\)\s*(.*)""", re.DOTALL)
_BLACK = Solid((0.0, 0.0, 0.0))
_NOTHING = Layer(())
_CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]])
_UNIT = Viewport(1.0, 1.0)
_SIDES = {"left": 0.0, "top": 0.0, "center": 0.5, "right": 1.0, "bottom": 1.0}
_USUAL = {"x": "-10%", "y": "-10%", "width": "120%", "height": "120%"}
"""Of a mask (CSS Masking)."""


def rectangle(frame: Floats, box: Floats) -> Area:
    """A box (2, 2) of a space, on the page."""
    return Area((apply(frame, box[0] + _CORNERS * (box[1] - box[0])),))


def cut(items: tuple[Item, ...], frame: Floats, box: Floats) -> tuple[Item, ...]:
    """Items as far as they are in a box (2, 2) of a space that a matrix moves to the page."""
    extent = layers.extent(items)
    if extent is None:
        return items
    corners = apply(inverse(frame), extent[0] + _CORNERS * (extent[1] - extent[0]))
    slack = 1e-9 * (box[1] - box[0])
    if (corners >= box[0] - slack).all() and (corners <= box[1] + slack).all():
        return items
    return (Layer(items, clip=Layer((Fill(rectangle(frame, box), _BLACK),))),)


class Resources:
    """Finds what is referred to.

    Args:
        document: where.
        cascade: of its styles.
        notes: takes what is left out.
        show: what the elements inside one paint, in a place.
    """

    def __init__(
        self,
        document: Document,
        cascade: Cascade,
        notes: Counter[str],
        show: Callable[[Element, Place], tuple[Item, ...]],
    ) -> None:
        self._document, self._cascade, self._notes, self._show = document, cascade, notes, show
        self._clips: dict[tuple[Element, bytes, bytes], Layer] = {}

    def painted(self, key: str, area: Area, place: Place, box: Floats) -> tuple[Item, ...]:
        """An area with the paint of ``fill`` or ``stroke``; ``box`` (2, 2) is around the shape, in its own space."""
        style, outline = place.style, key == "stroke"
        value = style.get(key, "none" if outline else "black")
        opacity = fraction(style.get(f"{key}-opacity"))
        match = _URL.match(value)
        if match is not None:
            server = self._element(match[1], "linearGradient", "radialGradient", "pattern")
            if server is not None:
                found = self._served(server, area, place, box, opacity, outline)
                if found is not None:
                    return found
            value = match[2] or "none"
        if value.startswith("context-"):
            if place.context is None:
                return () if outline else (Fill(area, None),)
            (other, around), own = place.context, value.removeprefix("context-")
            faded = {**other.style, f"{own}-opacity": str(opacity)}
            found = self.painted(own, area, replace(other, style=faded, shown=place.shown), around)
            return tuple(replace(item, outline=outline) if isinstance(item, Fill) else item for item in found)
        paint = servers.solid(value, style, opacity)
        return (Fill(area, paint, outline),) if paint is not None or not outline else ()

    def markers(self, path: Path, place: Place, box: Floats) -> tuple[Item, ...]:
        """The markers at the vertices of a path."""
        found = {which: self._marker(place.style.get(f"marker-{which}", "none")) for which in ("start", "mid", "end")}
        if not any(one is not None and one not in place.shown for one in found.values()):
            return ()
        width = figures.length(place.style.get("stroke-width", "1"), "", place, self._notes)
        items: list[Item] = []
        for which, vertex, angle in outlines.vertices(path):
            marker = found[which]
            if marker is not None and marker not in place.shown:
                turned = replace(place, context=(place, box), matrix=place.matrix @ matrix(e=vertex[0], f=vertex[1]))
                items += self._marked(marker, turned, angle, which == "start", width or 0.0)
        return tuple(items)

    def clip(self, value: str, place: Place, items: Sequence[Item]) -> Layer | None:
        """The layer that cuts items; None where nothing is cut."""
        if value == "none":
            return None
        match = _URL.match(value)
        target = self._element(match[1], "clipPath") if match else None
        if target is None:
            if match is None:
                self._notes["clip-path that is no clipPath"] += 1
            return None
        if target in place.shown:
            self._notes["clip-path that clips itself"] += 1
            return None
        own = replace(place, style=self._cascade.style(target, self._cascade.inherited(target)))
        turned = replace(own, matrix=figures.moved(target, own, self._notes), shown=(*place.shown, target))
        frame, _ = self._frame(target, "clipPathUnits", "userSpaceOnUse", place, turned.matrix, items)
        if frame is None:
            return _NOTHING
        key = (target, frame.tobytes(), repr(place.view).encode())
        if key not in self._clips:
            inside = replace(turned, matrix=frame)
            shapes = tuple(item for child in target for item in self._clipping(child, inside))
            again = self.clip(own.style.get("clip-path", "none"), replace(turned, matrix=place.matrix), items)
            self._clips[key] = Layer(shapes, clip=again)
        return self._clips[key]

    def mask(self, value: str, place: Place, items: Sequence[Item]) -> Mask | None:
        """How much of items shows; None where all does."""
        if value == "none":
            return None
        match = _URL.match(value)
        target = self._element(match[1], "mask") if match else None
        if target is None or target in place.shown:
            if match is None or target is not None:
                self._notes["mask that is not understood"] += 1
            return None
        style = self._cascade.style(target, self._cascade.inherited(target))
        frame, view = self._frame(target, "maskContentUnits", "userSpaceOnUse", place, place.matrix, items)
        outer, unit = self._frame(target, "maskUnits", "objectBoundingBox", place, place.matrix, items)
        if frame is None or outer is None:
            return Mask(_NOTHING)
        inside = replace(place, matrix=frame, view=view, style=style, shown=(*place.shown, target))
        left, top, width, height = (
            figures.length(target.get(key, usual), axis, replace(place, view=unit), self._notes) or 0.0
            for (key, usual), axis in zip(_USUAL.items(), "xyxy", strict=True)
        )
        shown = cut(self._show(target, inside), outer, np.array([[left, top], [left + width, top + height]]))
        again = self.mask(style.get("mask", "none"), replace(place, shown=(*place.shown, target)), items)
        kind = style.get("mask-type", "luminance")
        return Mask(Layer(shown, mask=again), kind != "alpha", style.get("color-interpolation") == "linearRGB")

    def _element(self, address: str, *kinds: str) -> Element | None:
        """What an address of the document stands for, if it is of one of some kinds."""
        if not address.startswith("#"):
            self._notes["reference to another file"] += 1
            return None
        found = self._document.by_id.get(address[1:])
        return found if found is not None and name(found) in kinds else None

    def _frame(
        self, element: Element, key: str, usual: str, place: Place, matrix: Floats, items: Sequence[Item]
    ) -> tuple[Floats | None, Viewport]:
        """The space of a clip or mask and what percentages are of there; None where its box has no area."""
        if element.get(key, usual) != "objectBoundingBox":
            return matrix, place.view
        box = layers.local_extent(items, inverse(place.matrix))
        unit = boxed(box)
        return None if unit is None else matrix @ unit, _UNIT

    def _served(
        self, server: Element, area: Area, place: Place, box: Floats, opacity: float, outline: bool
    ) -> tuple[Item, ...] | None:
        """An area with a gradient or pattern; None where it has none, so that the fallback is painted."""
        chain = list(servers.templates(self._document, server))
        kinds = ("pattern",) if name(server) == "pattern" else ("linearGradient", "radialGradient")
        chain = [one for one in chain if name(one) in kinds]
        try:
            if name(server) == "pattern":
                return self._tiled(chain, area, place, box, opacity, outline)
            paint = servers.gradient(chain, self._cascade, box, place.matrix, place.view)
        except ValueError:
            self._notes["gradient or pattern that is not understood"] += 1
            return (Fill(area, _BLACK.faded(opacity), outline),)
        return None if paint is None else (Fill(area, paint.faded(opacity), outline),)

    def _tiled(
        self, chain: Sequence[Element], area: Area, place: Place, box: Floats, opacity: float, outline: bool
    ) -> tuple[Item, ...] | None:
        pattern, owner = chain[0], next((one for one in chain if len(one)), chain[0])
        if pattern in place.shown:
            self._notes["pattern inside itself"] += 1
            return None
        own = replace(place, style=self._cascade.style(pattern, self._cascade.inherited(pattern)))
        frame = figures.moved(pattern, own, self._notes, attribute(chain, "patternTransform"))
        tiling = servers.tiling(chain, frame, place.view, box, area.bounds)
        if tiling is None:
            return None
        if len(tiling.places) > servers.MOST_TILES:
            self._notes["pattern of too many tiles, read as black"] += 1
            return (Fill(area, _BLACK.faded(opacity), outline),)
        style = self._cascade.style(owner, self._cascade.inherited(owner))
        inside = replace(place, style=style, shown=(*place.shown, pattern))
        tiles: list[Item] = []
        if tiling.places:
            first = tiling.places[0]
            shown = self._show(owner, replace(inside, matrix=first @ tiling.content))
            if style.get("overflow") not in ("visible", "auto"):
                shown = cut(shown, first, np.array([[0.0, 0.0], tiling.size]))
            for at in tiling.places:
                tiles += layers.shifted(shown, at[:2, 2] - first[:2, 2])
        return (Fill(area, None, outline), Layer(tuple(tiles), opacity, Layer((Fill(area, _BLACK),))))

    def _marker(self, value: str) -> Element | None:
        match = _URL.match(value) if value != "none" else None
        return self._element(match[1], "marker") if match else None

    def _marked(self, marker: Element, at: Place, angle: float, first: bool, stroke: float) -> tuple[Item, ...]:
        """What a marker paints at a vertex where the path has an angle in degrees."""
        style = self._cascade.style(marker, self._cascade.inherited(marker))
        own = replace(at, style=style, shown=(*at.shown, marker))
        orient = marker.get("orient", "0").strip()
        scale = 1.0 if marker.get("markerUnits") == "userSpaceOnUse" else stroke
        turn = f"{angle + 180.0 * (first and orient != 'auto')!r}" if orient.startswith("auto") else orient
        try:
            frame = at.matrix @ coordinates.transform(f"rotate({turn}) scale({scale!r})")
        except ValueError:
            self._notes["marker whose orient is not understood"] += 1
            frame = at.matrix @ coordinates.transform(f"scale({scale!r})")
        width, height = (
            figures.length(marker.get(key, "3"), axis, own, self._notes) or 0.0
            for key, axis in (("markerWidth", "x"), ("markerHeight", "y"))
        )
        box = coordinates.view_box(marker.get("viewBox"))
        if not (width > 0.0 and height > 0.0 and scale > 0.0) or (box is None and marker.get("viewBox")):
            return ()
        inner = coordinates.fitted(box, width, height, marker.get("preserveAspectRatio")) if box else np.eye(3)
        view = Viewport(*box[2:]) if box else Viewport(width, height)
        own = replace(own, view=view)
        x, y = apply(inner, np.array([self._reference(marker, key, box, at, view) for key in ("refX", "refY")]))
        frame = frame @ matrix(e=-x, f=-y)
        items = self._show(marker, replace(own, matrix=frame @ inner))
        if style.get("overflow") in ("visible", "auto"):
            return items
        return cut(items, frame, np.array([[0.0, 0.0], [width, height]]))

    def _reference(
        self, marker: Element, key: str, box: tuple[float, float, float, float] | None, at: Place, view: Viewport
    ) -> float:
        """Where on one axis, in a marker's own space, its vertex is."""
        text, axis = marker.get(key, "0").strip(), key[-1].lower()
        if text in _SIDES:
            start, size = (0.0 if box is None else box[axis == "y"]), (view.height if axis == "y" else view.width)
            return start + _SIDES[text] * size
        return figures.length(text, axis, at, self._notes) or 0.0

    def _clipping(self, child: Element, place: Place) -> tuple[Item, ...]:
        """What a child of a clip keeps."""
        style = self._cascade.style(child, place.style)
        here = replace(place, style=style)
        here = replace(here, matrix=figures.moved(child, here, self._notes))
        if style.get("display") == "none":
            return ()
        kind, items = name(child), tuple[Item, ...]()
        if kind in SHAPES and here.visible:
            path = figures.path(child, here, self._notes)
            area = figures.filled(path, here, "clip-rule") if path else None
            items = (Fill(area, _BLACK),) if area else ()
        elif kind == "use":
            target = self._element(link(child) or "", *SHAPES, "text")
            if target is not None:
                x, y = (figures.length(style.get(key), key, here, self._notes) or 0.0 for key in "xy")
                items = self._clipping(target, replace(here, matrix=here.matrix @ matrix(e=x, f=y)))
        elif kind == "text" and here.visible:
            self._notes["text in a clip"] += 1
        clip = self.clip(style.get("clip-path", "none"), here, items) if items else None
        return items if clip is None else (Layer(items, clip=clip),)
