"""The project's references, as the bench holds them: read when they are looked at, the last few kept in memory."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Generic, TypeVar

from shapewright.procedures import Facts
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import CLOUDS, MESHES
from shapewright.references.readers.pictures import KINDS
from shapewright.references.reading import Readers
from shapewright.references.reference import Reference
from shapewright.references.views import as_views
from shapewright.rendering.thumbnails import thumbnail
from shapewright.settings import Settings
from shapewright.shapes import Drawing, Mesh, Points, ReferenceShape, Shape
from shapewright.storage import remove_leftovers, whole_file
from shapewright.studio.project.listing import PICTURE, PICTURES, Listing, kept_picture
from shapewright.survey.preparation import without_extras

Item = TypeVar("Item")
_MEMORY = 32 * 2**20


class Shelf(Generic[Item]):
    """The things that were used last, as many as fit into ``most`` bytes, at least one."""

    def __init__(self, most: int, size: Callable[[Item], int]) -> None:
        self._items: OrderedDict[str, tuple[Item, int]] = OrderedDict()
        self._most, self._size, self._held = most, size, 0

    def get(self, key: str) -> Item | None:
        """The thing of this name, if it is still there."""
        if key not in self._items:
            return None
        self._items.move_to_end(key)
        return self._items[key][0]

    def put(self, key: str, item: Item) -> Item:
        """Put a thing there that was not, and return it."""
        self._items[key] = (item, self._size(item))
        self._held += self._items[key][1]
        while self._held > self._most and len(self._items) > 1:
            self._held -= self._items.popitem(last=False)[1][1]
        return item


class Gallery:
    """The references of a listing, as they stand beside what a procedure builds.

    cache: a folder for their pictures, None for none.
    readers: read them.
    facts: of the procedure: its axes are those of files that say nothing of theirs, and sizes may count.
    """

    def __init__(self, listed: Listing, cache: Path | None, readers: Readers, facts: Facts | None = None) -> None:
        self.listed = listed
        self.facts = facts or Facts()
        self._readers = readers
        self._cache = cache
        if cache:  # once, not with every picture: the folder holds those of all projects
            remove_leftovers(cache / PICTURES)
        self._shelf: Shelf[Reference] = Shelf(_MEMORY, lambda reference: shape_bytes(reference.shape))

    def __getitem__(self, slug: str) -> Reference:
        """Without what stands around its shape, as fits leave it out.

        Raises KeyError for a slug that is not known, UnreadableError for a file that cannot be read.
        """
        known = self._shelf.get(slug)
        if known:
            return known
        source = self.listed.sources[slug]
        (read,) = self._readers.read([source])
        if isinstance(read, UnreadableError):
            reason = read
            (read,) = self._readers.read(as_views([source]))  # a photograph is no drawing
            if isinstance(read, UnreadableError):
                raise reason
        read = without_extras(read.standing(self.facts.up) if self.facts.up != "y" else read, Settings())
        return self._shelf.put(slug, read.sized(self.facts.metres) if self.facts.size == "given" else read)

    def view(self, slug: str) -> Reference:
        """The same reference as an object in a picture. Raises as ``[]`` does."""
        (read,) = self._readers.read(as_views([self.listed.sources[slug]]))
        if isinstance(read, UnreadableError):
            raise read
        return read

    def unlike(self, slug: str, replica: Shape) -> str | None:
        """What is to be done where a replica cannot be compared with a reference, by the kind of its file alone."""
        suffix = self.listed.sources[slug].path.suffix.lower()
        if isinstance(replica, Drawing) and suffix in (*MESHES, *CLOUDS):
            return "the procedure draws, and the reference is a mesh or points: give it drawings, or build a mesh"
        if isinstance(replica, Mesh) and suffix not in (*MESHES, *CLOUDS, *KINDS):
            return "the procedure builds a mesh, and the reference is a drawing: give it meshes, or return a drawing"
        return None

    def picture(self, slug: str) -> bytes:
        """PNG of a reference. As its file has it, it is kept in the cache from now on. Raises as ``[]`` does."""
        drawn = thumbnail(self[slug].shape, PICTURE)
        kept = kept_picture(self._cache, self.listed.sources[slug]) if self._cache and self.facts.up == "y" else None
        if kept:
            kept.parent.mkdir(parents=True, exist_ok=True)
            with whole_file(kept) as partial:
                partial.write_bytes(drawn)
        return drawn


def in_turn(slugs: Iterable[str], first: Callable[[], list[str]]) -> Iterator[str]:
    """Each slug once, those before all others that are ``first`` when the next one is taken."""
    remaining = dict.fromkeys(slugs)
    while remaining:
        slug = next((seen for seen in first() if seen in remaining), None) or next(iter(remaining))
        del remaining[slug]
        yield slug


def shape_bytes(shape: ReferenceShape | None) -> int:
    """About what a shape takes in memory, with what is made of it."""
    if shape is None:
        return 0
    match shape:
        case Mesh():
            return 4 * (shape.vertices.nbytes + shape.faces.nbytes)
        case Points():
            return 8 * shape.positions.nbytes
        case _:
            return 2**16
