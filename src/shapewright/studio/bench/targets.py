"""What replicas are measured against: targets of the references that were asked for lately."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from shapewright.judging.judge import target_of
from shapewright.judging.target import Target
from shapewright.references.errors import UnreadableError
from shapewright.search.sizes import likeness
from shapewright.settings import Settings
from shapewright.shapes import Drawing, Mesh, Shape
from shapewright.studio.bench.gallery import Gallery, Shelf, shape_bytes
from shapewright.studio.wire.values import Slug

_MEMORY = 24 * 2**20


class Targets:
    """Of the references of a gallery.

    references: the gallery, once it is known what they are and how they stand.
    cache: a folder for descriptors.
    """

    def __init__(self, references: Callable[[], Gallery], settings: Settings, cache: Path | None) -> None:
        self._references, self._settings, self._cache = references, settings, cache
        self._shelf: Shelf[Target] = Shelf(_MEMORY, lambda target: 3 * shape_bytes(target.shape))

    def of(self, slug: Slug, view: bool = False) -> Target | None:
        """None for a reference that is not there or cannot be read. view: a picture as one of an object."""
        key = f"{slug} in view" if view else slug
        try:
            if known := self._shelf.get(key):
                return known
            references = self._references()
            shape = (references.view(slug) if view else references[slug]).shape
            return self._shelf.put(key, target_of(shape, self._settings, None if view else self._cache))
        except (KeyError, UnreadableError):
            return None

    def suited(self, slug: Slug, replica: Shape) -> Target | None:
        """The target of a replica: pictures are views of an object to a mesh."""
        target = self.of(slug)
        if target and isinstance(target.shape, Drawing) and isinstance(replica, Mesh):
            return self.of(slug, view=True)
        return target

    def measure(self, slug: Slug, shape: Shape) -> tuple[float, float] | None:
        """Distance and fidelity of a replica; None for a reference that is not there or cannot be read."""
        target = self.suited(slug, shape)
        if target is None:
            return None
        replica = shape.normalised()
        return target.nearest(replica)[0], target.fidelity(replica) * self.same(slug, shape)

    def same(self, slug: Slug, replica: Shape) -> float:
        """How like the sizes of reference and replica are; 1 where proportions count alone."""
        extent = self._references()[slug].extent
        return likeness(replica, extent) if extent else 1.0
