"""What a drawing paints, in order: areas with paints, and layers of them that are cut or faded as a whole."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Protocol, TypeAlias

import numpy as np
import shapely
from numpy.typing import NDArray

from shapewright.references.readers.svg.coordinates import apply
from shapewright.references.readers.svg.painting.paints import LUMA, Paint
from shapewright.shapes import Floats

MASK = (0.2125, 0.7154, 0.0721)
"""Of red, green and blue in the luminance of a mask (CSS Masking, "Calculating mask values")."""


@dataclass(frozen=True, eq=False)
class Area:
    """What closed lines surround, on the page.

    Attributes:
        rings: each (N, 2), ends where it begins; they may cross.
        evenodd: the fill rule; without it what any line goes round on balance.
    """

    rings: tuple[Floats, ...]
    evenodd: bool = False

    @cached_property
    def bounds(self) -> Floats:
        """(2, 2): the least and the greatest corner."""
        points = np.concatenate(self.rings)
        return np.stack([points.min(axis=0), points.max(axis=0)])


@dataclass(frozen=True, eq=False)
class Fill:
    """An area and its paint; without one it shows nothing but has a size. ``outline``: it is a stroke."""

    area: Area
    paint: Paint | None
    outline: bool = False


@dataclass(frozen=True, eq=False)
class Mask:
    """What shows through: by the luminance of a layer, or by its alpha alone."""

    layer: Layer
    luminance: bool = True
    linear: bool = False


@dataclass(frozen=True, eq=False)
class Layer:
    """Items that are painted together.

    Attributes:
        items: in the order of painting.
        opacity: of the whole.
        clip: what of it is kept: where this paints anything.
        mask: how much of it shows.
    """

    items: tuple[Item, ...]
    opacity: float = 1.0
    clip: Layer | None = None
    mask: Mask | None = field(default=None)


Item: TypeAlias = Fill | Layer


class Cells(Protocol):
    """Pieces of the page that are painted evenly."""

    def points(self, where: NDArray[np.int64]) -> Floats: ...

    def inside(self, area: Area) -> NDArray[np.int64]: ...


def closed(lines: Sequence[Floats], evenodd: bool = False) -> Area | None:
    """The area in lines that are closed where they are open; None where it is nothing."""
    rings = [
        line if (line[0] == line[-1]).all() else np.concatenate([line, line[:1]]) for line in lines if len(line) > 2
    ]
    rings = [ring for ring in rings if len(ring) > 3]
    return Area(tuple(rings), evenodd) if rings else None


def united(polygons: Sequence[Any], frame: Floats) -> Area | None:
    """The union of valid polygons of a space that a matrix moves to the page; None where it is nothing."""
    if not polygons:
        return None
    rings = shapely.get_rings(shapely.orient_polygons(np.array(polygons, dtype=object)))
    return Area(tuple(apply(frame, shapely.get_coordinates(ring)) for ring in rings))


def fills(items: Sequence[Item]) -> Iterator[Fill]:
    """All areas that are painted or seen through, clips and masks among them."""
    for item in items:
        if isinstance(item, Fill):
            yield item
            continue
        yield from fills(item.items)
        if item.clip is not None:
            yield from fills((item.clip,))
        if item.mask is not None:
            yield from fills((item.mask.layer,))


def extent(items: Sequence[Item]) -> Floats | None:
    """(2, 2): the box around all that is painted, before it is cut."""
    boxes = [fill.area.bounds for fill in _painted(items) if fill.paint is not None]
    return np.stack([np.min(boxes, axis=0)[0], np.max(boxes, axis=0)[1]]) if boxes else None


def local_extent(items: Sequence[Item], frame: Floats) -> Floats | None:
    """(2, 2): the box around all shapes without their strokes, in the space to which a matrix moves the page."""
    rings = [ring for fill in _painted(items) if not fill.outline for ring in fill.area.rings]
    if not rings:
        return None
    points = apply(frame, np.concatenate(rings))
    return np.stack([points.min(axis=0), points.max(axis=0)])


def shifted(items: Sequence[Item], by: Floats) -> tuple[Item, ...]:
    """Items, moved on the page by (2,)."""
    result: list[Item] = []
    for item in items:
        if isinstance(item, Fill):
            area = Area(tuple(ring + by for ring in item.area.rings), item.area.evenodd)
            result.append(replace(item, area=area, paint=item.paint and item.paint.shifted(by)))
            continue
        clip = None if item.clip is None else Layer(shifted((item.clip,), by))
        mask = item.mask and replace(item.mask, layer=Layer(shifted((item.mask.layer,), by)))
        result.append(replace(item, items=shifted(item.items, by), clip=clip, mask=mask))
    return tuple(result)


def unseen(items: Sequence[Item]) -> tuple[Item, ...]:
    """The areas of items without their paints: they count in bounding boxes alone."""
    return tuple(replace(fill, paint=None) for fill in _painted(items))


def _painted(items: Sequence[Item]) -> Iterator[Fill]:
    for item in items:
        if isinstance(item, Fill):
            yield item
        else:
            yield from _painted(item.items)


Weights = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Painted:
    """What is on some cells.

    Attributes:
        where: (K,) the cells, ascending.
        light: (K,) luminance times alpha.
        alpha: (K,)
    """

    where: NDArray[np.int64]
    light: Floats
    alpha: Floats

    def on(self, where: NDArray[np.int64]) -> tuple[Floats, Floats]:
        """Light and alpha on other cells, ascending; 0 where nothing is painted."""
        at = np.minimum(np.searchsorted(self.where, where), max(len(self.where) - 1, 0))
        if not len(self.where):
            return np.zeros(len(where)), np.zeros(len(where))
        there = self.where[at] == where
        return np.where(there, self.light[at], 0.0), np.where(there, self.alpha[at], 0.0)


def composed(items: Sequence[Item], cells: Cells, weights: Weights = LUMA) -> Painted:
    """Items painted over one another on cells."""
    parts = [
        _filled(item, cells, weights) if isinstance(item, Fill) else _layered(item, cells, weights) for item in items
    ]
    parts = [part for part in parts if len(part.where)]
    if len(parts) == 1:
        return parts[0]
    found = np.concatenate([np.empty(0, dtype=np.int64), *(part.where for part in parts)])
    found.sort(kind="stable")  # merges what is sorted already; np.unique takes ten times as long
    where = found[np.diff(found, prepend=-1) > 0]
    light, alpha = np.zeros(len(where)), np.zeros(len(where))
    for part in parts:
        at = np.searchsorted(where, part.where)
        light[at] = part.light + light[at] * (1.0 - part.alpha)
        alpha[at] = part.alpha + alpha[at] * (1.0 - part.alpha)
    return Painted(where, light, alpha)


def _filled(fill: Fill, cells: Cells, weights: Weights) -> Painted:
    if fill.paint is None:
        return Painted(np.empty(0, dtype=np.int64), np.empty(0), np.empty(0))
    where = cells.inside(fill.area)
    colours, alpha = fill.paint.at(cells.points(where))
    return Painted(where, colours @ weights * alpha, alpha)


def _layered(layer: Layer, cells: Cells, weights: Weights) -> Painted:
    whole = composed(layer.items, cells, weights)
    where, light, alpha = whole.where, whole.light * layer.opacity, whole.alpha * layer.opacity
    if layer.clip is not None:
        kept = _layered(layer.clip, cells, weights).on(where)[1] > 0.5
        where, light, alpha = where[kept], light[kept], alpha[kept]
    if layer.mask is not None:
        through, cover = _layered(layer.mask.layer, cells, MASK).on(where)
        if layer.mask.linear:
            through = cover * _linear(through / np.maximum(cover, 1e-6))
        shown = through if layer.mask.luminance else cover
        light, alpha = light * shown, alpha * shown
    return Painted(where, light, alpha)


def _linear(value: Floats) -> Floats:
    """The luminance of a value of sRGB (IEC 61966-2-1)."""
    return np.where(value <= 0.04045, value / 12.92, ((np.maximum(value, 0.0) + 0.055) / 1.055) ** 2.4)
