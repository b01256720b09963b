"""The elements of a document, one after the other, as what they paint on its page."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.svg import coordinates, figures, lettering, resources
from shapewright.references.readers.svg.coordinates import Viewport, inverse, matrix
from shapewright.references.readers.svg.document import Document, Element, link, name
from shapewright.references.readers.svg.figures import SHAPES, Place
from shapewright.references.readers.svg.lines.paths import Path
from shapewright.references.readers.svg.painting import layers
from shapewright.references.readers.svg.painting.layers import Item, Layer
from shapewright.references.readers.svg.resources import Resources
from shapewright.references.readers.svg.servers import fraction
from shapewright.references.readers.svg.styles import Cascade

_GROUPS = {"g", "a"}
_FRAMES = {"svg", "symbol"}
_MARKED = {"path", "line", "polyline", "polygon"}
_LEFT_OUT = {"image", "foreignObject"}
_SILENT = {
    "title",
    "desc",
    "metadata",
    "defs",
    "style",
    "linearGradient",
    "radialGradient",
    "pattern",
    "clipPath",
    "mask",
    "marker",
    "symbol",
    "filter",
    "script",
    "view",
    "cursor",
    "font",
    "font-face",
    "color-profile",
    "solidcolor",
    "animate",
    "animateTransform",
    "animateMotion",
    "animateColor",
    "set",
}
_DEEPEST = 100
"""Elements inside one another; real files have some ten."""
_MOST = 20_000
"""Elements that are shown by uses, beyond those of the file: ten levels of ten uses would be 10^10."""
_FLATTEST = 1e-12
"""Of a matrix's determinant: what is flatter shows nothing."""
Size = tuple[float | None, float | None]


class Scene:
    """Walks over a document.

    Attributes:
        notes: how often each thing was left out, by name.
    """

    def __init__(self, document: Document) -> None:
        self.document = document
        self.cascade = Cascade(document)
        self.notes: Counter[str] = self.cascade.notes + Counter(document.notes)
        self._resources = Resources(document, self.cascade, self.notes, self.children)
        self._left = _MOST + document.count

    def items(self, element: Element, place: Place, size: Size | None = None) -> tuple[Item, ...]:
        """What an element paints in a place; ``size`` is the width and height that a ``use`` gives it."""
        kind = name(element)
        if not kind or (kind in _SILENT and not (kind == "symbol" and size is not None)):
            return ()
        self._left -= 1
        if self._left < 0:
            raise UnreadableError(f"it shows more than {_MOST:,} elements beyond its own, by uses of uses")
        here = replace(place, style=self.cascade.style(element, place.style), depth=place.depth + 1)
        opacity = fraction(here.style.get("opacity"))
        if here.style.get("display") == "none" or not _wanted(element):
            return ()
        if here.depth > _DEEPEST:
            self.notes["element more than 100 deep"] += 1
            return ()
        here = replace(here, matrix=figures.moved(element, here, self.notes))
        (a, c, _), (b, d, _), _ = here.matrix
        if not abs(a * d - b * c) > _FLATTEST:
            return ()
        return self._composed(here, self._content(kind, element, here, size), opacity)

    def root(self, element: Element, place: Place) -> tuple[Item, ...]:
        """What the outermost element paints in its own space."""
        here = replace(place, style=self.cascade.style(element, place.style))
        opacity = fraction(here.style.get("opacity"))
        if here.style.get("display") == "none":
            return ()
        here = replace(here, matrix=figures.moved(element, here, self.notes))
        return self._composed(here, self.children(element, here), opacity)

    def children(self, element: Element, place: Place) -> tuple[Item, ...]:
        """What the elements inside one paint, in the place of that one."""
        return tuple(item for child in element for item in self.items(child, place))

    def framed(self, element: Element, place: Place, size: Size = (None, None)) -> tuple[Item, ...]:
        """What a nested ``svg`` or a ``symbol`` paints."""

        def told(key: str, axis: str) -> float | None:
            return figures.length(place.style.get(key), axis, place, self.notes)

        x, y = told("x", "x") or 0.0, told("y", "y") or 0.0
        symbol = name(element) == "symbol"
        width, height = (
            given if given is not None else None if symbol else told(key, axis)
            for given, key, axis in zip(size, ("width", "height"), "xy", strict=True)
        )
        width, height = place.view.width if width is None else width, place.view.height if height is None else height
        if not (width > 0.0 and height > 0.0):
            return ()
        outer, box = place.matrix @ matrix(e=x, f=y), coordinates.view_box(element.get("viewBox"))
        inner = outer @ coordinates.fitted(box, width, height, element.get("preserveAspectRatio")) if box else outer
        view = Viewport(*box[2:]) if box else Viewport(width, height)
        items = self.children(element, replace(place, matrix=inner, view=view))
        if place.style.get("overflow") in ("visible", "auto"):
            return items
        return resources.cut(items, outer, np.array([[0.0, 0.0], [width, height]]))

    def _content(self, kind: str, element: Element, here: Place, size: Size | None) -> tuple[Item, ...]:
        if kind in _GROUPS:
            return self.children(element, here)
        if kind in SHAPES:
            shape = self._shape(element, here)
            return shape if here.visible else layers.unseen(shape)
        if kind == "text":
            return self._text(element, here) if here.visible else ()
        if kind in _FRAMES:
            return self.framed(element, here, size or (None, None))
        if kind == "use":
            return self._use(element, here)
        if kind == "switch":
            chosen = [child for child in element if name(child) not in ({""} | _SILENT) and _wanted(child)]
            drawn = [child for child in chosen if name(child) != "foreignObject"] or chosen
            return self.items(drawn[0], here) if drawn else ()
        if kind not in _LEFT_OUT:
            self.notes[f"<{kind}>"] += 1
        elif here.visible:
            self.notes[kind] += 1
        return ()

    def _use(self, element: Element, here: Place) -> tuple[Item, ...]:
        found = self._used(element, here)
        if found is None:
            return ()
        target, inside = found
        width, height = (
            figures.length(here.style.get(key), axis, here, self.notes)
            for key, axis in (("width", "x"), ("height", "y"))
        )
        items = self.items(target, inside, (width, height))
        if self.document.has_context and (box := layers.local_extent(items, inverse(inside.matrix))) is not None:
            items = self.items(
                target, replace(inside, context=(replace(here, matrix=inside.matrix), box)), (width, height)
            )
        return items

    def _used(self, element: Element, here: Place) -> tuple[Element, Place] | None:
        """What a ``use`` shows, and in which place."""
        where = link(element) or ""
        target = self.document.by_id.get(where[1:]) if where.startswith("#") else None
        if where and not where.startswith("#"):
            self.notes["use of another file"] += 1
        if target is None:
            return None
        shown = (*here.shown, element)
        if any(target is above for one in shown for above in one.iterancestors()):
            self.notes["use that shows itself"] += 1
            return None
        x, y = (figures.length(here.style.get(key), key, here, self.notes) or 0.0 for key in "xy")
        return target, replace(here, matrix=here.matrix @ matrix(e=x, f=y), shown=shown)

    def _shape(self, element: Element, here: Place) -> tuple[Item, ...]:
        """What a shape paints."""
        found = figures.path(element, here, self.notes)
        if found is None:
            return ()
        return self._painted(element, found, here)

    def _text(self, element: Element, here: Place) -> tuple[Item, ...]:
        """What a text paints, style after style."""
        found = lettering.runs(element, here, self.cascade.style, self.cascade.faces, self.notes)
        return tuple(
            item
            for run in found
            if len(run.outline.cubics) and run.place.visible
            for item in self._painted(run.element, run.outline, run.place)
        )

    def _painted(self, element: Element, found: Path, here: Place) -> tuple[Item, ...]:
        """What an outline paints: fill, stroke and markers, in the order that ``paint-order`` tells."""
        kind, box, style = name(element), found.bounds(), here.style
        painted: dict[str, tuple[Item, ...]] = {}
        inside = figures.filled(found, here, "fill-rule") if kind != "line" else None
        if inside is not None:
            painted["fill"] = self._resources.painted("fill", inside, here, box)
        if style.get("stroke", "none") != "none" and (along := figures.drawn(element, found, here, self.notes)):
            painted["stroke"] = self._resources.painted("stroke", along, here, box)
        if kind in _MARKED:
            painted["markers"] = self._resources.markers(found, here, box)
        order = [*style.get("paint-order", "").split(), "fill", "stroke", "markers"]
        return tuple(item for part in dict.fromkeys(order) for item in painted.get(part, ()))

    def _composed(self, here: Place, items: tuple[Item, ...], opacity: float) -> tuple[Item, ...]:
        """Items as a layer, where they are faded, clipped or masked together."""
        style = here.style
        if not items or opacity == 0.0:
            return layers.unseen(items)
        if style.get("filter", "none") != "none":
            self.notes["filter"] += 1
        if style.get("mix-blend-mode", "normal") != "normal":
            self.notes["blend mode"] += 1
        if style.get("clip", "auto") != "auto":
            self.notes["clip property"] += 1
        clip = self._resources.clip(style.get("clip-path", "none"), here, items)
        mask = self._resources.mask(style.get("mask", "none"), here, items)
        if clip is None and mask is None and opacity == 1.0:
            return items
        return (Layer(items, opacity, clip, mask),)


def _wanted(element: Element) -> bool:
    """Whether an element is for a reader of English without extensions."""
    if element.get("requiredExtensions") is not None:
        return False
    languages = element.get("systemLanguage")
    return languages is None or any(one.strip().lower().split("-")[0] == "en" for one in languages.split(","))
