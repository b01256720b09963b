"""A drawing of filled regions in the plane."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapewright.shapes.arrays import Floats, Transform

if TYPE_CHECKING:
    import shapely


@dataclass(frozen=True, eq=False)
class Drawing:
    """Filled regions in the plane, black on white.

    Attributes:
        geometry: a shapely polygon or several, y up. Raises ValueError for one without area.
    """

    geometry: shapely.Polygon | shapely.MultiPolygon

    def __post_init__(self) -> None:
        if self.geometry.is_empty or not self.geometry.area > 0.0:
            raise ValueError("a drawing needs an area; give lines a width, for example with .buffer(0.01)")

    @property
    def bounds(self) -> Floats:
        """(2, 2): the least and the greatest corner."""
        return np.asarray(self.geometry.bounds, dtype=np.float64).reshape(2, 2)

    def normalisation(self) -> Transform:
        size = float((self.bounds[1] - self.bounds[0]).max())
        return Transform(tuple(self.bounds.mean(axis=0)), 1.0 / size)

    def normalised(self) -> Drawing:
        import shapely

        transform = self.normalisation()
        return Drawing(shapely.transform(self.geometry, transform.apply))

    def __repr__(self) -> str:
        return f"Drawing({self.geometry.geom_type}, area {self.geometry.area:.4g})"
