"""What form a piece of a surface has: a bar, a plate, a ring, a block; how large, and how many are alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from shapewright.feedback.surfaces.residuals import Region
from shapewright.feedback.surfaces.visible_surface import filled
from shapewright.shapes import Floats, Mesh

FormKind = Literal["bar", "plate", "ring", "bow", "block", "shell"]
Lie = Literal["upright", "lying", "sloping"]

# Chosen by hand on pieces of chairs, lamps and cups.
_THIN = 0.3  # of the longest side, that a thin one has at most
_FLAT = 0.5  # of the same, how thick a ring is at most
_ALIKE = 1.5  # ratio of the sides of two boxes up to which they are copies
_SLACK = 0.02  # added to sides before they are compared
_MIRRORED = 0.05  # how far from its mirror image a copy may be
_TURNED = 0.94  # cosine of the angle off an axis, below which something slopes
_BINS, _RING, _BOW = 12, 11, 6  # directions around a middle; of these filled by a ring, and by a bow at least
_HOLLOW, _INNER = 0.05, 0.5  # share of points within this part of the way to the sides, that a ring has at most
_FILLED = 0.5  # points inside, as a share of those on the surface, that a block has at least
_POINTS = 400  # of a piece, that tell whether it is filled


@dataclass(frozen=True)
class Form:
    """The form of one piece, and of those that are like it."""

    kind: FormKind
    lie: Lie
    size: tuple[float, float, float]  # along its own axes, in units of the reference's largest extent
    copies: int = 1  # pieces that are alike, with itself
    symmetric: bool = False  # whether these are their own mirror image, left for right

    @property
    def words(self) -> str:
        """Such as "4 upright bars, 0.06 x 0.40 x 0.06 each"."""
        size = " x ".join(f"{side:.2f}" for side in self.size)
        kind = self.kind if self.kind in ("block", "shell", "bow") else f"{self.lie} {self.kind}"
        if self.copies > 1:
            return f"{self.copies} {kind}s of about {size} each"
        return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind} of {size}"


def form_of(chief: Region, regions: Sequence[Region], mesh: Mesh | None = None) -> Form:
    """The form of a region, which is among the others of its side.

    mesh: the normalised shape that it is of, for telling a block from a shell; without it all are blocks.
    """
    alike = copies_of(chief, regions)
    centres = np.array([region.box.centre for region in alike])
    images = centres * [-1.0, 1.0, 1.0]
    apart = np.linalg.norm(images[:, None] - centres[None], axis=2).min(axis=1)
    size = tuple(float(side) for side in chief.box.size)
    kind, lie = _kind(chief, mesh), _lie(chief)
    return Form(kind, lie, (size[0], size[1], size[2]), len(alike), bool((apart < _MIRRORED).all()))


def copies_of(chief: Region, regions: Sequence[Region]) -> list[Region]:
    """The regions of the same side whose boxes are about as large, with the region itself."""
    return [r for r in regions if r.side == chief.side and (r is chief or _same(r.box.size, chief.box.size))]


def _same(a: Floats, b: Floats) -> bool:
    ratio = (np.sort(a) + _SLACK) / (np.sort(b) + _SLACK)
    return bool(np.maximum(ratio, 1.0 / ratio).max() < _ALIKE)


def _kind(region: Region, mesh: Mesh | None) -> FormKind:
    size = region.box.size
    longest = float(size.max())
    order = np.argsort(size)
    filled_ways = _around(region, order)
    if filled_ways >= _RING and size[order[1]] > _THIN * longest and size[order[0]] < _FLAT * longest:
        return "ring"
    if size[order[1]] < _THIN * longest:
        return "bar"
    if filled_ways >= _BOW and size[order[0]] < _THIN * longest:
        return "bow"
    if size[order[0]] < _THIN * longest:
        return "plate"
    if mesh is None:
        return "block"
    some = region.points[:: max(1, len(region.points) // _POINTS)]
    return "block" if len(filled(mesh, some)) > (1.0 + _FILLED) * len(some) else "shell"


def _around(region: Region, order: NDArray[np.intp]) -> int:
    """Into how many directions of its two longer axes points lie, where there are none in the middle; 0 otherwise."""
    places = (region.points - region.box.centre) @ region.box.axes.T
    flat = places[:, order[1:]] / (region.box.size[order[1:]] / 2.0 + 1e-9)
    if (np.linalg.norm(flat, axis=1) < _INNER).mean() > _HOLLOW:
        return 0
    angle = np.arctan2(flat[:, 1], flat[:, 0]) / (2.0 * np.pi) + 0.5
    return len(np.unique((angle * _BINS).astype(int) % _BINS))


def _lie(region: Region) -> Lie:
    """Of the longest axis, of a plate or ring the plane of the two longer ones."""
    size, axes = region.box.size, region.box.axes
    long, normal = int(size.argmax()), int(size.argmin())
    slim = np.sort(size)[1] < _THIN * size.max()
    up = abs(float(axes[long if slim else normal, 1]))
    if np.abs(axes).max(axis=1).min() < _TURNED:
        return "sloping"
    return "upright" if (up > 0.5) == slim else "lying"
