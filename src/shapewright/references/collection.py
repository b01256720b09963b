"""Collections of references: the shapes that a procedure is to replicate."""

from __future__ import annotations

import contextlib
import difflib
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from shapewright.references import sources
from shapewright.references.errors import CollectionError, UnreadableError
from shapewright.references.orientation import AxesBy, Orientation
from shapewright.references.origins.lists import lasting
from shapewright.references.readers import formats as files
from shapewright.references.readers.pictures import KINDS as PICTURES
from shapewright.references.reading import Readers
from shapewright.references.reference import Reference, normalised
from shapewright.references.scans.steps import Kept, kept
from shapewright.references.standing import AUTO, stood, told
from shapewright.references.views import Pictures, as_views, joined
from shapewright.shapes import Drawing, Mesh, Points, Views
from shapewright.shapes.conversion import as_reference
from shapewright.shapes.shelf import fresh, shelved
from shapewright.storage import printable

_REASONS = 5
_AT_ONCE = 1000
"""Files that are read before their shapes are put aside."""


@dataclass(frozen=True, eq=False)
class Collection:
    """The references to replicate, in natural order of their names: ``len``, iteration, ``refs["name"]``.

    All are meshes or points, or all are drawings, or all are objects in views. Raises CollectionError for a mixture.

    Attributes:
        references: the shapes.
        skipped: reasons by file, for the files that could not be read.
        source: where the collection comes from, in words.
        origins: absolute paths or patterns to load it from again; empty for one made in memory.
        up: the axis of the files that points up; "auto" where it was found, see ``stood``.
        front: the axis of the files that points to the front; None for the usual one.
        keep: what was left in points.
        pictures: what pictures were read as.
        left_out: reasons by name, for the references that were left out on request.
        taught: whether up and front were found with the help of a procedure.
    """

    references: tuple[Reference, ...]
    skipped: Mapping[Path, str] = field(default_factory=dict)
    source: str = "memory"
    origins: tuple[str, ...] = ()
    up: str = "y"
    front: str | None = None
    keep: tuple[Kept, ...] = ()
    pictures: Pictures = "drawings"
    left_out: Mapping[str, str] = field(default_factory=dict)
    taught: bool = False

    def __post_init__(self) -> None:
        drawings = [reference.name for reference in self if isinstance(reference.shape, Drawing)]
        views = [reference.name for reference in self if isinstance(reference.shape, Views)]
        if 0 < len(views) < len(self):
            raise CollectionError(
                f"{len(views)} objects in views ({views[0]}, ...) among other shapes in one collection; load one kind"
            )
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
        keep: Iterable[str] = (),
        pictures: Pictures = "drawings",
    ) -> Collection:
        """Read a collection from a folder, an archive, a glob pattern, a CSV manifest, a file, or a list of these.

        Each may be an address as well, ``s3://bucket/chairs`` or ``https://host/chairs.zip``; ``@list.txt`` lists some.

        It reads meshes in OBJ, PLY, STL, OFF, GLB, glTF, 3MF, DAE, FBX, USD, STEP and IGES, and drawings in SVG, DXF
        and pictures.
        ``sources.find`` says which files a source stands for and how they are named. A file that cannot be read is
        listed in ``skipped`` with its reason. Raises CollectionError, which says what to do, where nothing can be read.

        Args:
            source: one source or several.
            up: the axis of the mesh files that points up, among x, y, z, -x, -y, -z. A file whose format says which
                axis that is, as 3MF does, goes by its format where this is y. "auto" finds it, see ``stood``.
            front: the axis that points to the front; by default z, or -y where up is z or -z, as in Blender and CAD;
                where up is "auto", the one that is found.
            keep: what is left in points, of floor, density and strays: see docs/howto.md. By default a floor is taken
                off, points are left out where they are much denser than elsewhere, and so are stray ones.
            pictures: whether pictures are drawings, or views of objects for a procedure that makes meshes. Where no
                file is a drawing, as with photographs, they are views.
        """
        origins = [source] if isinstance(source, str | os.PathLike) else list(source)
        skipped: dict[Path, str] = {}
        steps = kept(keep)
        auto, front = told(up, front)
        found = sources.find(origins, keep=steps) if auto else sources.find(origins, up, front, steps)
        if pictures == "views":
            found = as_views(found)
        left_out = {one.name: "left out by the manifest" for one in found if one.switches.leave_out}
        found = [one for one in found if not one.switches.leave_out]
        if not found:
            raise CollectionError(f"{os.fspath(origins[0])} leaves out all its files; leave fewer out")
        files_read: list[sources.Source] = []

        def read() -> Iterator[Reference]:
            with Readers() as readers:
                for start in range(0, len(found), _AT_ONCE):
                    some = found[start : start + _AT_ONCE]
                    for file, result in zip(some, readers.read(some), strict=True):
                        if isinstance(result, UnreadableError):
                            skipped[file.place] = printable(str(result))
                        else:
                            files_read.append(file)
                            yield result

        references: Sequence[Reference] = shelved(read())
        if pictures == "views":
            references = joined(files_read, references)
        elif not references and any(file.path.suffix.lower() in PICTURES for file in found):
            with contextlib.suppress(CollectionError):
                return cls.load(origins, up=up, front=front, keep=steps, pictures="views")
        if not references:
            raise CollectionError(_nothing_readable(skipped))
        more = f" and {len(origins) - 1} more" if len(origins) > 1 else ""
        again = tuple(map(lasting, origins))
        up = AUTO if auto else up
        whole = cls(
            tuple(references), skipped, os.fspath(origins[0]) + more, again, up, front, steps, pictures, left_out
        )
        return whole.stood() if auto else whole

    @classmethod
    def of(
        cls, shapes: Mapping[str, Any], *, up: str = "y", front: str | None = None, keep: Iterable[str] = ()
    ) -> Collection:
        """A collection of named shapes in memory: Points, a point cloud, or what procedures return, such as a trimesh.

        ``up``, ``front`` and ``keep`` as for ``load``. Raises CollectionError for a shape that cannot be used.
        """
        auto, front = told(up, front)
        orientation = Orientation() if auto else Orientation.of(up, front)
        if not shapes:
            raise CollectionError("no shapes given; a collection needs at least one")
        by: AxesBy = "author" if not auto and sources.is_authors(up, front) else "default"
        names, steps = sorted(shapes, key=sources.natural_key), kept(keep)
        references = [_in_memory(name, shapes[name], orientation, by, steps) for name in names]
        whole = cls(tuple(references), keep=steps, up=AUTO if auto else "y", front=front if auto else None)
        return whole.stood() if auto else whole

    def as_views(self) -> Collection:
        """The references as objects in pictures, for a procedure that makes meshes; files are read again.

        Drawings in memory are silhouettes. Raises CollectionError where nothing can be read so.
        """
        from shapewright.references.readers.views.reader import view_of  # numba loads slowly

        if self.origins:
            return Collection.load(self.origins, up=self.up, front=self.front, keep=self.keep, pictures="views")
        shapes = [(r, Views((view_of(r.shape),)) if isinstance(r.shape, Drawing) else r.shape) for r in self]
        return replace(self, references=tuple(replace(r, shape=shape) for r, shape in shapes), pictures="views")

    def stood(
        self,
        taught: Sequence[Mesh] = (),
        threads: int | None = None,
        recorded: Mapping[str, Mapping[str, Any]] | None = None,
    ) -> Collection:
        """The collection with up and front of its meshes found, but of those whose author tells them.

        They are found by what the shapes look like, by what most of them share, and by shapes of a procedure that
        stand right (``taught``). What is not sure stays as the file or its format has it. What a run has found before
        (``recorded``) stays so. ``Reference.finding`` says what was found, ``Reference.orientation``
        which axes of the file these are.
        """
        found = stood(self.references, self.front, taught, threads, recorded)
        return replace(self, references=found, taught=bool(taught or recorded))

    def oriented(self, orientations: Mapping[str, Orientation]) -> Collection:
        """The collection with these orientations of its files, by the names of references."""
        each = (r.stood(orientations[r.name]) if r.name in orientations else r for r in self)
        return replace(self, references=shelved(each))

    def turned(self, quarters: Sequence[int]) -> Collection:
        """The collection with every reference turned about the up axis: see ``Reference.turned``."""
        return replace(self, references=shelved(r.turned(q) if q else r for r, q in zip(self, quarters, strict=True)))

    def standing(self, up: str) -> Collection:
        """The collection for a procedure that builds with this axis up: see ``Reference.standing``."""
        return replace(self, references=shelved(reference.standing(up) for reference in self))

    def sized(self, metres: float | None = None) -> Collection:
        """The collection for a procedure whose lengths, in a unit of so many metres, mean what they say."""
        return replace(self, references=tuple(reference.sized(metres) for reference in self))

    def part(self, rows: Iterable[int]) -> Collection:
        """The collection of some of its references, by their places. Those on disk come into memory."""
        some = [self.references[int(row)] for row in rows]
        return replace(self, references=tuple(replace(r, shape=fresh(r.shape)) for r in some))

    @property
    def extents(self) -> tuple[float | None, ...]:
        """The longest side that the replicas of each are to have; None where proportions count alone."""
        return tuple(reference.extent for reference in self)

    @cached_property
    def _by_name(self) -> dict[str, Reference]:
        return {reference.name: reference for reference in self.references}

    @property
    def kind(self) -> type[Mesh] | type[Drawing]:
        """What a procedure has to make: drawings for drawings, meshes for all else."""
        return Drawing if isinstance(self.references[0].shape, Drawing) else Mesh

    @property
    def in_views(self) -> bool:
        """Whether the references are objects in pictures, see ``Views``."""
        return isinstance(self.references[0].shape, Views)

    @property
    def has_points(self) -> bool:
        """Whether any reference is points."""
        return any(isinstance(reference.shape, Points) for reference in self.references)

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


def _in_memory(name: str, value: Any, orientation: Orientation, by: AxesBy, keep: Sequence[Kept]) -> Reference:
    try:
        shape = as_reference(value)
        shape, notes = files.sound(shape.vertices, shape.faces) if isinstance(shape, Mesh) else (shape, ())
    except TypeError as error:
        which = f"{type(value).__name__} is no shape; give a Mesh, a trimesh, (vertices, faces), Points or a Drawing"
        raise CollectionError(f"{name}: {which}") from error
    except ValueError as error:
        raise CollectionError(f"{name}: {error}") from error
    return normalised(name, None, shape, orientation, notes, by, keep)


def _nothing_readable(skipped: Mapping[Path, str]) -> str:
    reasons = [f"{path}: {reason}" for path, reason in list(skipped.items())[:_REASONS]]
    if len(skipped) > _REASONS:
        reasons.append(f"and {len(skipped) - _REASONS} more")
    counted = f"none of the {len(skipped)} files can be read" if len(skipped) > 1 else "the only file cannot be read"
    return "\n  ".join([f"{counted}:", *reasons])
