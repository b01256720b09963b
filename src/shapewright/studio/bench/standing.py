"""How the references of a gallery stand, where that is to be found: worked out between requests, shape by shape."""

from __future__ import annotations

import time
from collections.abc import Generator
from dataclasses import dataclass

from shapewright.axes.finding import SAMPLES, Kind
from shapewright.axes.looks import Looks
from shapewright.references.errors import UnreadableError
from shapewright.references.orientation import AxesBy, Orientation
from shapewright.references.standing import found, is_free, told
from shapewright.shapes import Mesh, Points
from shapewright.studio.bench.gallery import Gallery, Stance
from shapewright.studio.bench.workshop import Broken, Workshop
from shapewright.studio.project.listing import version_of
from shapewright.studio.wire.values import Slug

_SECONDS = 5.0
"""For which shapes of the procedure are built to learn from: all pictures wait for them."""


@dataclass(frozen=True, eq=False)
class Seen:
    """What is seen of one reference as its file holds it.

    axes: those of the file that point up and to the front then, and who says so.
    looks: of one shape.
    """

    axes: tuple[Orientation, AxesBy]
    looks: Looks


class Standing:
    """Finds up and front as a fit does; what was seen of a file is kept while the file stays as it is.

    taught: whether shapes of a procedure decided the last time.
    """

    def __init__(self) -> None:
        self.taught = False
        self._seen: dict[str, Seen | None] = {}

    def find(self, gallery: Gallery, workshop: Workshop, seed: int) -> Generator[None, None, dict[Slug, Stance]]:
        """One shape a step; returns how references stand: as a run recorded it, and what is found of the others.

        seed: of the samples.
        """
        known: dict[str, Seen] = {}  # by version of a file, which may hold several references
        files: dict[Slug, str] = {}
        for slug in sorted(gallery.listed.free):
            version = version_of(gallery.listed.files.get(slug) or gallery.listed.sources[slug])
            seen = self._look(gallery, slug, version) if version else None
            if version and seen:
                files[slug], known[version] = version, seen
            yield
        self.taught = False
        if not known:
            return gallery.recorded
        kind = None
        if workshop.open:
            kind = Kind.taught((yield from _samples(workshop, seed)), 1)
            self.taught = kind is not None
        front = told(gallery.listed.origin.up, gallery.listed.origin.front)[1]
        looks = Looks.joined([seen.looks for seen in known.values()])
        findings = found([seen.axes for seen in known.values()], looks, front, kind)
        told_of = dict(zip(known, findings, strict=True))
        return {**{slug: told_of[version] for slug, version in files.items()}, **gallery.recorded}

    def _look(self, gallery: Gallery, slug: Slug, version: str) -> Seen | None:
        """None of what cannot be read, and of what is not to be turned."""
        if version not in self._seen:
            self._seen[version] = None
            try:
                reference = gallery.given(slug)
            except UnreadableError:
                return None
            if is_free(reference) and isinstance(reference.shape, Mesh | Points):
                self._seen[version] = Seen((reference.orientation, reference.axes_by), Looks.of([reference.shape], 1))
        return self._seen[version]


def _samples(workshop: Workshop, seed: int) -> Generator[None, None, list[Mesh]]:
    """Random shapes of the procedure, as many as time allows; they stand right."""
    shapes: list[Mesh] = []
    end = time.monotonic() + _SECONDS
    try:
        for values in workshop.sample(SAMPLES, seed):
            built = workshop.build(values)
            if built is None or time.monotonic() > end:
                break
            if isinstance(built.build.shape, Mesh):
                shapes.append(built.build.shape)
            yield
    except Broken:  # whoever builds the next shape is told
        pass
    return shapes
