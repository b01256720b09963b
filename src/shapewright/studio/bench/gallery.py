"""The project's references, as the bench holds them: read when they are looked at, the last few kept in memory."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Generic, TypeAlias, TypeVar

from shapewright.axes.finding import Finding
from shapewright.procedures import Facts
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import CLOUDS, MESHES
from shapewright.references.readers.pictures import KINDS
from shapewright.references.reading import Readers
from shapewright.references.reference import Reference
from shapewright.references.standing import is_free, recalled, turned
from shapewright.references.views import as_views
from shapewright.rendering.thumbnails import thumbnail
from shapewright.settings import Settings
from shapewright.shapes import Drawing, Mesh, Points, ReferenceShape, Shape
from shapewright.storage import remove_leftovers, whole_file
from shapewright.studio.project.listing import PICTURE, PICTURES, Listing
from shapewright.studio.wire.collection import Axes
from shapewright.survey.preparation import objects_in, without_extras

Item = TypeVar("Item")
Stance: TypeAlias = Finding | Mapping[str, Any]
"""How a reference stands: as it was found to, or as a run recorded that."""
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
    stances: how references stand where that was to be found, by slug: a finding, or what a run recorded.
    """

    def __init__(
        self,
        listed: Listing,
        cache: Path | None,
        readers: Readers,
        facts: Facts | None = None,
        stances: Mapping[str, Stance] | None = None,
    ) -> None:
        self.listed = listed
        self.facts = facts or Facts()
        self.stances = stances or {}
        self._readers = readers
        self._cache = cache
        if cache:  # once, not with every picture: the folder holds those of all projects
            remove_leftovers(cache / PICTURES)
        self._shelf: Shelf[Reference] = Shelf(_MEMORY, lambda reference: shape_bytes(reference.shape))
        self._read_for: dict[str, Path | None] = {}  # where shapes are kept of files as they were when they were read

    @property
    def recorded(self) -> dict[str, Stance]:
        """How a run found references to stand."""
        return {slug: stance for slug, stance in self.stances.items() if not isinstance(stance, Finding)}

    @property
    def unsettled(self) -> set[str]:
        """References of which no run says how they stand, where that is to be found."""
        return self.listed.free - self.recorded.keys()

    @property
    def uncertain(self) -> set[str]:
        """References that do not stand as a picture that is kept may show them."""
        return self.unsettled if self.facts.up == "y" else {*self.listed.sources}

    def __getitem__(self, slug: str) -> Reference:
        """Without what stands around its shape, as fits leave it out.

        Raises KeyError for a slug that is not known, UnreadableError for a file that cannot be read.
        """
        known = self._shelf.get(slug)
        if known:
            return known
        self._read_for[slug] = self._place(slug)
        read, stance = self.given(slug), self.stances.get(slug)
        if stance is not None and is_free(read):
            read = turned(read, stance) if isinstance(stance, Finding) else recalled(read, stance)
        read = read.standing(self.facts.up) if self.facts.up != "y" else read
        if slug not in self.listed.files:
            return self._shelved(slug, without_extras(read, Settings()))
        # A file is read and taken apart once for all objects in it.
        parts, file = {part.name: part for part in reversed(objects_in(read, Settings()))}, self.listed.files[slug]
        for other in (one for one, whole in self.listed.files.items() if whole == file and one != slug):
            part = parts.get(self.listed.sources[other].name)
            if part and self._shelf.get(other) is None:
                self._shelved(other, part)
        return self._shelved(slug, parts.get(self.listed.sources[slug].name, read))

    def _shelved(self, slug: str, read: Reference) -> Reference:
        return self._shelf.put(slug, read.sized(self.facts.metres) if self.facts.size == "given" else read)

    def given(self, slug: str) -> Reference:
        """As its file holds it, all objects in it. Raises as ``[]`` does."""
        source = self.listed.files.get(slug) or self.listed.sources[slug]
        (read,) = self._readers.read([source])
        if isinstance(read, UnreadableError):
            reason = read
            (read,) = self._readers.read(as_views([source]))  # a photograph is no drawing
            if isinstance(read, UnreadableError):
                raise reason
        return read

    def parted(self, slug: str, names: Sequence[str]) -> Gallery:
        """With the objects in a file in its place; they stand as it does."""
        listed, stances = self.listed.parted(slug, names), dict(self.stances)
        if slug in stances:
            stances |= dict.fromkeys(listed.files.keys() - self.listed.files.keys(), stances[slug])
        return Gallery(listed, self._cache, self._readers, self.facts, stances)

    def objects(self, slug: str) -> list[str]:
        """The names of what a file is split into; one where it stays whole. Raises as ``[]`` does."""
        return [part.name for part in objects_in(self.given(slug), Settings())]

    def axes(self, slug: str) -> Axes | None:
        """Which axes of its file point up and to the front, where these are to be found. Raises as ``[]`` does."""
        reference = self[slug]
        if not self.listed.origin.auto or not isinstance(reference.shape, Mesh | Points):
            return None
        return Axes.of(reference.orientation, reference.axes_by)

    def kept_shape(self, slug: str) -> Path | None:
        """Where the message of a large mesh is kept.

        None where nothing is, where its axes are still a guess, and where the file is another one than was read.
        """
        place = self._place(slug)
        return place if place == self._read_for.get(slug) else None

    def _place(self, slug: str) -> Path | None:
        stance = self.stances.get(slug)
        if self._cache is None or slug not in self.listed.sources or isinstance(stance, Finding):
            return None
        return self.listed.kept_shape(self._cache, slug, stance, self.facts.up)

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
        """PNG of a reference. Raises as ``[]`` does.

        As its file has it, or as it was found to stand, it is kept in the cache from now on.
        """
        reference = self[slug]
        drawn = thumbnail(reference.shape, PICTURE)
        found, kept = reference.orientation if slug in self.stances else None, None
        if self._cache and (found or self.facts.up == "y"):
            kept = self.listed.kept_picture(self._cache, slug, found)
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
