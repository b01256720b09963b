"""Collections of references: the shapes that a procedure is to replicate."""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from shapewright.references import sources
from shapewright.references.errors import CollectionError, UnreadableError
from shapewright.references.orientation import QUARTER_TURNS, AxesBy, Orientation
from shapewright.references.readers import formats as files
from shapewright.shapes import Drawing, Floats, Mesh, Points, ReferenceShape, Transform, shape_digest
from shapewright.shapes.conversion import as_reference
from shapewright.storage import printable

_REASONS = 5


@dataclass(frozen=True, eq=False)
class Reference:
    """One shape to replicate.

    Attributes:
        name: unique in its collection.
        path: its file, of one in an archive the paths of the archive and inside of it; None for a shape made in memory.
        shape: the mesh or points, Y up, front towards +Z, or the drawing; the bounding box is centred and its largest
            side is 1.
        transform: how it was centred and scaled, after it was turned.
        orientation: how a mesh or points were turned.
        notes: what of the file was left out.
        axes_by: who says that it is to be turned so.
        unit: that of the file, in metres, where the file or its format states it; else None.
    """

    name: str
    path: Path | None
    shape: ReferenceShape
    transform: Transform
    orientation: Orientation = field(default_factory=Orientation)
    notes: tuple[str, ...] = ()
    axes_by: AxesBy = "default"
    unit: float | None = None

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
        return original if isinstance(self.shape, Drawing) else self.orientation.invert(original)

    def turned(self, quarters: int) -> Reference:
        """The same shape after a number of quarter turns about the up axis, from the front towards the right.

        A drawing stays as it is.
        """
        if isinstance(self.shape, Drawing):
            return self
        turn = QUARTER_TURNS[quarters % 4]
        transform = Transform(tuple(turn @ self.transform.centre), self.transform.scale)
        return replace(
            self,
            shape=self.shape.transformed(turn),
            transform=transform,
            orientation=self.orientation.turned(quarters),
        )

    def __repr__(self) -> str:
        match self.shape:
            case Mesh():
                size = f"{len(self.shape.faces)} faces"
            case Points():
                size = f"{len(self.shape)} points"
            case Drawing():
                size = "drawing"
        return f"Reference({self.name!r}, {size})"


@dataclass(frozen=True, eq=False)
class Collection:
    """The references to replicate, in natural order of their names: ``len``, iteration, ``refs["name"]``.

    All are meshes or points, or all are drawings. Raises CollectionError for a mixture.

    Attributes:
        references: the shapes.
        skipped: reasons by file, for the files that could not be read.
        source: where the collection comes from, in words.
        origins: absolute paths or patterns to load it from again; empty for one made in memory.
        up: the axis of the files that points up.
        front: the axis of the files that points to the front; None for the usual one.
    """

    references: tuple[Reference, ...]
    skipped: Mapping[Path, str] = field(default_factory=dict)
    source: str = "memory"
    origins: tuple[str, ...] = ()
    up: str = "y"
    front: str | None = None

    def __post_init__(self) -> None:
        drawings = [reference.name for reference in self if isinstance(reference.shape, Drawing)]
        if 0 < len(drawings) < len(self):
            raise CollectionError(
                f"{len(self) - len(drawings)} meshes or points and {len(drawings)} drawings ({drawings[0]}, ...) in "
                "one collection; load one kind, for example with a pattern such as '*.svg'"
            )

    @classmethod
    def load(
        cls,
        source: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
        *,
        up: str = "y",
        front: str | None = None,
    ) -> Collection:
        """Read a collection from a folder, an archive, a glob pattern, a CSV manifest, a file, or a list of these.

        It reads meshes in OBJ, PLY, STL, OFF, GLB, glTF, 3MF and COLLADA, and drawings in SVG and pictures.
        ``sources.find`` says which files a source stands for and how they are named. A file that cannot be read is
        listed in ``skipped`` with its reason. Raises CollectionError, which says what to do, where nothing can be read.

        Args:
            source: one source or several.
            up: the axis of the mesh files that points up, among x, y, z, -x, -y, -z. A file whose format says which
                axis that is, as 3MF does, goes by its format where this is y.
            front: the axis that points to the front; by default z, or -y where up is z or -z, as in Blender and CAD.
        """
        origins = [source] if isinstance(source, str | os.PathLike) else list(source)
        references: list[Reference] = []
        skipped: dict[Path, str] = {}
        for file in sources.find(origins, up, front):
            try:
                references.append(read_reference(file))
            except UnreadableError as error:
                skipped[file.place] = printable(str(error))
        if not references:
            raise CollectionError(_nothing_readable(skipped))
        more = f" and {len(origins) - 1} more" if len(origins) > 1 else ""
        again = tuple(str(Path(origin).expanduser().absolute()) for origin in origins)
        return cls(tuple(references), skipped, os.fspath(origins[0]) + more, again, up, front)

    @classmethod
    def of(cls, shapes: Mapping[str, Any], *, up: str = "y", front: str | None = None) -> Collection:
        """A collection of named shapes in memory: Points, a point cloud, or what procedures return, such as a trimesh.

        ``up`` and ``front`` as for ``load``. Raises CollectionError for a shape that cannot be used.
        """
        orientation = Orientation.of(up, front)
        if not shapes:
            raise CollectionError("no shapes given; a collection needs at least one")
        references = [_in_memory(name, shapes[name], orientation) for name in sorted(shapes, key=sources.natural_key)]
        return cls(tuple(references))

    def turned(self, quarters: Sequence[int]) -> Collection:
        """The collection with every reference turned about the up axis: see ``Reference.turned``."""
        return replace(self, references=tuple(r.turned(q) if q else r for r, q in zip(self, quarters, strict=True)))

    @cached_property
    def _by_name(self) -> dict[str, Reference]:
        return {reference.name: reference for reference in self.references}

    @property
    def kind(self) -> type[Mesh] | type[Drawing]:
        """What a procedure has to make: drawings for drawings, meshes for meshes and points."""
        return Drawing if isinstance(self.references[0].shape, Drawing) else Mesh

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self._by_name)

    def __len__(self) -> int:
        return len(self.references)

    def __iter__(self) -> Iterator[Reference]:
        return iter(self.references)

    def __contains__(self, name: object) -> bool:
        """Whether there is a reference of this name."""
        return name in self._by_name

    def __getitem__(self, name: str) -> Reference:
        if name not in self._by_name:
            similar = difflib.get_close_matches(name, self.names) or self.names[:3]
            raise KeyError(f"no reference {name!r} among {len(self)}; there is {', '.join(similar)}")
        return self._by_name[name]

    def __repr__(self) -> str:
        skipped = f", {len(self.skipped)} skipped" if self.skipped else ""
        return f"Collection({len(self)} references from {self.source}{skipped})"


def read_reference(source: sources.Source) -> Reference:
    """One file of those that ``sources.find`` lists. Raises UnreadableError, with the reason."""
    if source.refusal:
        raise UnreadableError(source.refusal)
    found = files.contents(source.path)
    by_format = found.up is not None and not source.by_author
    orientation = Orientation.of(found.up) if found.up and by_format else source.orientation
    by: AxesBy = "author" if source.by_author else "format" if by_format else "default"
    reference = _normalised(source.name, source.place, found.shape, orientation, found.notes)
    return replace(reference, axes_by=by, unit=found.unit)


def _normalised(
    name: str, path: Path | None, shape: ReferenceShape, orientation: Orientation, notes: tuple[str, ...]
) -> Reference:
    turned = shape if isinstance(shape, Drawing) else shape.transformed(orientation.matrix)
    return Reference(name, path, turned.normalised(), turned.normalisation(), orientation, notes)


def _in_memory(name: str, value: Any, orientation: Orientation) -> Reference:
    try:
        shape = as_reference(value)
        shape, notes = files.sound(shape.vertices, shape.faces) if isinstance(shape, Mesh) else (shape, ())
    except TypeError as error:
        which = f"{type(value).__name__} is no shape; give a Mesh, a trimesh, (vertices, faces), Points or a Drawing"
        raise CollectionError(f"{name}: {which}") from error
    except ValueError as error:
        raise CollectionError(f"{name}: {error}") from error
    return _normalised(name, None, shape, orientation, notes)


def _nothing_readable(skipped: Mapping[Path, str]) -> str:
    reasons = [f"{path}: {reason}" for path, reason in list(skipped.items())[:_REASONS]]
    if len(skipped) > _REASONS:
        reasons.append(f"and {len(skipped) - _REASONS} more")
    counted = f"none of the {len(skipped)} files can be read" if len(skipped) > 1 else "the only file cannot be read"
    return "\n  ".join([f"{counted}:", *reasons])
