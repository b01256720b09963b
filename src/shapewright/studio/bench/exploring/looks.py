"""How the references of a gallery look, in small pictures: which are alike, and which are the same shape twice."""

from __future__ import annotations

from collections import Counter
from collections.abc import Generator, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import overload

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.reference import Reference
from shapewright.shapes import Bytes, ReferenceShape, Views
from shapewright.storage import whole_file
from shapewright.studio.bench.gallery import Gallery
from shapewright.studio.wire.collection import Duplicate
from shapewright.studio.wire.values import Slug
from shapewright.survey.duplicates import sought
from shapewright.survey.likeness import differences, pictures

LOOKS = "looks"  # the folder in the cache


class Looks:
    """Small pictures (4, D) of references by slug, see ``survey.likeness``; those of files that stay as they are last.

    cache: a folder to keep them in, None for none.
    """

    def __init__(self, cache: Path | None) -> None:
        self._cache = cache
        self.seen: dict[Slug, Bytes] = {}

    def look(self, gallery: Gallery) -> Iterator[None]:
        """Look at all references of a gallery, one a step; what was seen of others is forgotten."""
        self.seen = {}
        for slug in [*gallery.listed.sources]:
            with suppress(UnreadableError, KeyError, ValueError, OSError):
                self.seen[slug] = self._look_at(gallery, slug)
            yield

    def _look_at(self, gallery: Gallery, slug: Slug) -> Bytes:
        """Raises UnreadableError, ValueError for a shape that has no such pictures, OSError."""
        kept = self._kept(gallery, slug)
        found = _read(kept) if kept else None
        if found is None:
            found = look_at(gallery[slug].shape)
            if kept:
                kept.parent.mkdir(parents=True, exist_ok=True)
                with whole_file(kept) as partial, partial.open("wb") as file:
                    np.save(file, found)
        return found

    def _kept(self, gallery: Gallery, slug: Slug) -> Path | None:
        if self._cache is None or (slug in gallery.uncertain and slug not in gallery.recorded):
            return None
        stance = gallery.recorded.get(slug)
        picture = gallery.listed.kept_picture(self._cache, slug)
        return self._cache / LOOKS / f"{picture.stem}{_turned(stance)}.npy" if picture else None

    def together(self) -> tuple[list[Slug], Bytes]:
        """The slugs of all that can be compared, and their pictures (N, 4, D): drawings and meshes cannot."""
        sizes = Counter(each.shape for each in self.seen.values())
        usual = sizes.most_common(1)[0][0] if sizes else (4, 0)
        slugs = [slug for slug, each in self.seen.items() if each.shape == usual]
        return slugs, np.stack([self.seen[slug] for slug in slugs]) if slugs else np.empty((0, *usual), np.uint8)

    def alike(self, slug: Slug) -> dict[Slug, float]:
        """How much all others differ from one, 0 to 1, the most alike first. Raises KeyError where it was not seen."""
        slugs, seen = self.together()
        if slug not in slugs:
            raise KeyError(f"{slug} has not been looked at yet; ask again in a moment")
        rows = np.arange(len(slugs))
        apart, _ = differences(seen, np.full(len(slugs), slugs.index(slug)), rows)
        order = np.argsort(apart, kind="stable")
        return {slugs[i]: round(float(apart[i]), 5) for i in order if slugs[i] != slug}

    def duplicates(self, gallery: Gallery) -> Generator[None, None, list[Duplicate]]:
        """The references that are like one before them, a step at a time; none where one cannot be read any more."""
        slugs, seen = self.together()
        try:
            found = yield from sought(_Named(gallery, slugs), seen)
        except (UnreadableError, KeyError, ValueError):
            return []
        return [Duplicate(slug=one.name, of=one.of, equal=one.is_equal, quarters=one.quarters) for one in found]


def look_at(shape: ReferenceShape) -> Bytes:
    """The small pictures (4, D) of one shape. Raises ValueError for an object in views, which has none."""
    if isinstance(shape, Views):
        raise ValueError("an object in views has no such pictures")
    return np.asarray(pictures([shape], 1)[0])


class _Named(Sequence[Reference]):
    """References under their slugs, read when they are asked for."""

    def __init__(self, gallery: Gallery, slugs: Sequence[Slug]) -> None:
        self._gallery, self._slugs = gallery, slugs

    def __len__(self) -> int:
        return len(self._slugs)

    @overload
    def __getitem__(self, row: int) -> Reference: ...
    @overload
    def __getitem__(self, row: slice) -> Sequence[Reference]: ...
    def __getitem__(self, row: int | slice) -> Reference | Sequence[Reference]:
        if isinstance(row, slice):
            return _Named(self._gallery, self._slugs[row])
        return replace(self._gallery[self._slugs[row]], name=self._slugs[row])


def _turned(stance: object) -> str:
    """How a run found a reference to stand, as a part of a file's name."""
    return f"-{stance['up']}{stance['front']}" if isinstance(stance, Mapping) else ""


def _read(path: Path) -> Bytes | None:
    try:
        return np.asarray(np.load(path, allow_pickle=False), np.uint8)
    except (OSError, ValueError, EOFError):
        return None
