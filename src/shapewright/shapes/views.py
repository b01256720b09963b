"""Views: pictures of one object, as cameras saw it of which nobody knows where they stood."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapewright.shapes.arrays import Bytes, Floats, Transform

SIDE = 320
"""Pixels along the side of a picture."""
REACH = 1.0 / 1.06
"""Share of a picture's side that the longer side of the silhouette's box takes: as a drawing does of its page."""


@dataclass(frozen=True, eq=False)
class View:
    """What one picture shows of an object, framed by its silhouette.

    Attributes:
        mask: (SIDE, SIDE) uint8, row 0 at the top: how much of each pixel the object covers, 0 to 255. Its box is in
            the middle, and the longer side of that takes REACH of the picture's.
        picture: (SIDE, SIDE, 3) uint8, the same part of the picture in its colours; None where there is none to show.

    Raises ValueError for another form, and for a mask that shows nothing.
    """

    mask: Bytes
    picture: Bytes | None = None

    def __post_init__(self) -> None:
        for field, form in (("mask", (SIDE, SIDE)), ("picture", (SIDE, SIDE, 3))):
            if (pixels := getattr(self, field)) is not None and (pixels.shape != form or pixels.dtype != np.uint8):
                raise ValueError(f"the {field} has the form {pixels.shape} of {pixels.dtype}, not {form} of uint8")
        if not self.mask.any():
            raise ValueError("the mask shows nothing")


@dataclass(frozen=True, eq=False)
class Views:
    """One object in one or several pictures. It can be a reference; a procedure makes meshes and drawings alone.

    Attributes:
        views: at least one. Raises ValueError for none.
    """

    views: tuple[View, ...]

    def __post_init__(self) -> None:
        if not self.views:
            raise ValueError("there are no views")

    @property
    def bounds(self) -> Floats:
        """(2, 2): the corners of the page that pictures show, as of a drawing whose longer side is 1."""
        half = 0.5 / REACH
        return np.array([[-half, -half], [half, half]])

    def normalisation(self) -> Transform:
        """None is needed: views are framed as they are read."""
        return Transform((0.0, 0.0), 1.0)

    def normalised(self) -> Views:
        return self

    def __len__(self) -> int:
        return len(self.views)

    def __repr__(self) -> str:
        return f"Views({len(self)} view{'s' if len(self) > 1 else ''})"
