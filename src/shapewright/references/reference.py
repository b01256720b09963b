"""One shape of a collection: read, turned Y up, centred and scaled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from shapewright.references import sources
from shapewright.references.errors import UnreadableError
from shapewright.references.manifests.rows import Switches
from shapewright.references.orientation import QUARTER_TURNS, AxesBy, Orientation
from shapewright.references.readers import formats as files
from shapewright.references.scans.cleaning import cleaned
from shapewright.references.scans.floor import up_by_floor
from shapewright.references.scans.steps import Kept
from shapewright.shapes import Drawing, Floats, Ints, Mesh, Points, ReferenceShape, Transform, Views, shape_digest

if TYPE_CHECKING:
    from shapewright.axes.finding import Finding


@dataclass(frozen=True, eq=False)
class Reference:
    """One shape to replicate.

    Attributes:
        name: unique in its collection.
        path: its file, of one in an archive the paths of the archive and inside of it; None for a shape made in memory.
        shape: the mesh or points, Y up, front towards +Z, or the drawing; the bounding box is centred and its largest
            side is 1. Or the object in views.
        transform: how it was centred and scaled, after it was turned.
        orientation: how a mesh or points were turned.
        notes: what of the file was left out.
        axes_by: who says that it is to be turned so.
        finding: how its up and front were looked for; None where they were not.
        given_by: who said how it is turned before they were found.
        unit: that of the file, in metres, where the file or its format states it; else None.
        extent: the longest side that its replicas are to have, in the procedure's unit; None where proportions count
            alone.
        part_of: the name of the reference that it is one of several objects of; None for a whole file.
        switches: what a manifest says of its file alone.
    """

    name: str
    path: Path | None
    shape: ReferenceShape
    transform: Transform
    orientation: Orientation = field(default_factory=Orientation)
    notes: tuple[str, ...] = ()
    axes_by: AxesBy = "default"
    unit: float | None = None
    extent: float | None = None
    part_of: str | None = None
    finding: Finding | None = None
    given_by: AxesBy = "default"
    switches: Switches = field(default_factory=Switches)

    @cached_property
    def digest(self) -> str:
        """A key for the normalised geometry."""
        return shape_digest(self.shape)

    @property
    def size(self) -> Floats:
        """(3,): width, height and depth as it stands, of a drawing (2,), in metres; in the file's units where ``unit``
        is None."""
        size = (self.shape.bounds[1] - self.shape.bounds[0]) / self.transform.scale
        return np.asarray(size * (self.unit or 1.0))

    def to_original(self, points: ArrayLike) -> Floats:
        """Points (..., 3), of a drawing (..., 2), in the frame of ``shape``, back in the file's own units and axes."""
        original = self.transform.invert(points)
        return original if isinstance(self.shape, Drawing | Views) else self.orientation.invert(original)

    def sized(self, metres: float | None) -> Reference:
        """With the extent of its file, in a unit of so many metres.

        A file that states no unit has the procedure's, and a procedure that has none takes the numbers of the file.
        Views of an object have no size in space.
        """
        if isinstance(self.shape, Views):
            return self
        side = float(self.size.max())
        return replace(self, extent=side / (metres or self.unit or 1.0) if self.unit else side)

    def standing(self, up: str) -> Reference:
        """Turned for this axis of its file to point up, where neither its author nor its format says which one does.

        One that is found to stand right as it is stays so.
        """
        if isinstance(self.shape, Drawing | Views) or self.axes_by != "default" or self.orientation != Orientation():
            return self
        if self.finding is not None and self.finding.sure:
            return self
        orientation = Orientation.of(up)
        transform = Transform(tuple(orientation.matrix @ self.transform.centre), self.transform.scale)
        shape = self.shape.transformed(orientation.matrix)
        return replace(self, shape=shape, transform=transform, orientation=orientation)

    def turned(self, quarters: int) -> Reference:
        """The same shape after a number of quarter turns about the up axis, from the front towards the right.

        A drawing stays as it is, and so do views.
        """
        return self.after(QUARTER_TURNS[quarters % 4])

    def after(self, turn: Floats) -> Reference:
        """The same shape after a rotation (3, 3) by quarter turns about any axes; drawings and views stay so."""
        if isinstance(self.shape, Drawing | Views):
            return self
        transform = Transform(tuple(turn @ self.transform.centre), self.transform.scale)
        shape, orientation = self.shape.transformed(turn), self.orientation.then(turn)
        return replace(self, shape=shape, transform=transform, orientation=orientation)

    def stood(self, orientation: Orientation) -> Reference:
        """The same shape in another orientation of its file."""
        return self.after(orientation.matrix @ self.orientation.matrix.T)

    def of_faces(self, faces: Ints) -> Reference:
        """The same mesh of some of its faces alone, centred and scaled anew. faces: indices, at least one.

        Raises ValueError where these faces have no size.
        """
        assert isinstance(self.shape, Mesh)
        used, corners = np.unique(self.shape.faces[faces], return_inverse=True)
        some = self.shape.remade(self.shape.vertices[used], corners.reshape(-1, 3), faces)
        inner, outer = some.normalisation(), self.transform
        transform = Transform(tuple(outer.invert(inner.centre)), outer.scale * inner.scale)
        extent = None if self.extent is None else self.extent / inner.scale
        return replace(self, shape=some.normalised(), transform=transform, extent=extent)

    def __repr__(self) -> str:
        match self.shape:
            case Mesh():
                size = f"{len(self.shape.faces)} faces"
            case Points():
                size = f"{len(self.shape)} points"
            case Drawing():
                size = "drawing"
            case Views():
                size = f"{len(self.shape)} views" if len(self.shape) > 1 else "1 view"
        return f"Reference({self.name!r}, {size})"


def read_reference(source: sources.Source) -> Reference:
    """One file of those that ``sources.find`` lists. Raises UnreadableError, with the reason."""
    if source.refusal:
        raise UnreadableError(source.refusal)
    found = files.contents(source.path, source.view, source.mask)
    by_format = found.up is not None and not source.by_author
    orientation = Orientation.of(found.up) if found.up and by_format else source.orientation
    by: AxesBy = "author" if source.by_author else "format" if by_format else "default"
    reference = normalised(source.name, source.place, found.shape, orientation, found.notes, by, source.keep)
    return replace(reference, unit=source.switches.unit or found.unit, switches=source.switches)


def normalised(
    name: str,
    path: Path | None,
    shape: ReferenceShape,
    orientation: Orientation,
    notes: tuple[str, ...] = (),
    by: AxesBy = "default",
    keep: Sequence[Kept] = (),
) -> Reference:
    """A reference of a shape that stands as its file holds it.

    Points are cleaned; where nobody says which axis of theirs points up, their floor does. by: who says it. keep: what
    is left in points.
    """
    if isinstance(shape, Points) and by == "default" and "floor" not in keep and (up := up_by_floor(shape.positions)):
        notes = (*notes, *(() if up == orientation.up else (f"{up} points up: the floor says so",)))
        orientation, by = orientation if up == orientation.up else Orientation.of(up), "floor"
    turned = shape if isinstance(shape, Drawing | Views) else shape.transformed(orientation.matrix)
    if isinstance(turned, Points):
        turned, told = cleaned(turned, keep)
        notes = (*notes, *told)
    return Reference(name, path, turned.normalised(), turned.normalisation(), orientation, notes, by)
