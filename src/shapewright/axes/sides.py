"""A shape from six sides, stretched to fill a cube: what it looks like apart from its proportions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from shapewright.axes.turns import SOURCES, TURNS
from shapewright.rendering.splats import discs
from shapewright.rendering.surround import EMPTY, SIZE, Surround
from shapewright.shapes import Floats, Mesh, Points

_THINNEST = 1e-3  # of the largest extent: what is thinner is stretched as if it were so thick
_POOL = 4  # pixels along the side of a cell in which two pictures are compared


@dataclass(frozen=True, eq=False)
class Sides:
    """What is seen of a mesh, or of points as discs that lie in the surface.

    Attributes:
        nearness: (6, SIZE, SIZE) float32, from 0 at the far side of its box to 1 at the near one; below 0 where empty.
        extent: (3,), of its box, in units of the largest.
        centre: (3,), of its surface, in parts of the box from its middle, -0.5 to 0.5.
    """

    nearness: Any
    extent: Floats
    centre: Floats

    @classmethod
    def of(cls, shape: Mesh | Points) -> Sides:
        """Raises ValueError for a shape of no size."""
        mesh = discs(shape) if isinstance(shape, Points) else shape
        box = mesh.extent
        if not box.max() > 0.0:
            raise ValueError("a shape of no size has no sides")
        box = np.maximum(box, _THINNEST * box.max())
        stretched = Mesh((mesh.vertices - mesh.bounds.mean(axis=0)) / box, mesh.faces)
        seen = Surround.of(stretched, slice(0, 6)).nearness
        corners = mesh.triangles
        areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        middles = stretched.vertices[mesh.faces].mean(axis=1)
        centre = areas @ middles / max(areas.sum(), np.finfo(float).tiny)
        return cls(np.where(seen > EMPTY / 2.0, seen + np.float32(0.5), np.float32(-1.0)), box / box.max(), centre)

    def apart(self) -> Floats:
        """(2, 24): by how much the mesh looks other after each of TURNS; 0 for the same.

        First without its proportions: the share of what either covers, in the mean of the six sides, that only one
        covers, or at another depth, that weighs as much as it lies apart. Then with them: at least the logarithm of how
        much longer a side of its box is.
        """
        covered = self.nearness >= 0.0
        both = np.stack([covered, np.where(covered, self.nearness, 0.0)])
        cells = both.reshape(2, 6, SIZE // _POOL, _POOL, SIZE // _POOL, _POOL).mean(axis=(3, 5))
        rotated = np.stack([np.rot90(cells, quarters, axes=(2, 3)) for quarters in range(4)])
        apart = np.empty((2, len(TURNS)))
        for number, turn in enumerate(TURNS):
            turned = np.stack([rotated[quarters, :, view] for view, quarters in SOURCES[number]], axis=1)
            either = np.maximum(cells[0], turned[0]).sum()
            longer = np.abs(np.log(np.abs(turn) @ self.extent / self.extent)).max()
            apart[0, number] = np.abs(cells - turned).sum() / max(either, 1e-9)
            apart[1, number] = max(apart[0, number], longer)
        return apart
