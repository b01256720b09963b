"""The project's references by name: what there is to read, listed without reading it, and where pictures are kept."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

from shapewright.references.orientation import Orientation
from shapewright.references.readers.formats import CLOUDS, MESHES
from shapewright.references.sources import Source, find
from shapewright.references.standing import told
from shapewright.storage import file_names

PICTURE = 256
"""Pixels of a reference's thumbnail."""
PICTURES = "thumbnails"  # the folder in the cache
SHAPES = "shapes"  # the folder in the cache
SHAPE_FORMAT = 1
"""Part of the name of every message of a shape that is kept; raise it whenever the same file would get another one."""
_PICTURE_FORMAT = 2
"""Part of every cached picture's name; raise it whenever the same file would get another picture."""
_OUTSIDE = "a link that leads out of the project folder; start the studio with --references to allow it"


@dataclass(frozen=True)
class Origin:
    """Where the references are."""

    source: str  # a folder, file or pattern
    up: str = "y"  # axis of the files; "auto" where it is to be found
    front: str | None = None  # axis of the files; None for the usual one, or where it is to be found
    confine: str | None = None  # no file may lie outside this folder, links followed; None: the author named the source
    keep: tuple[str, ...] = ()  # what is left in scans

    @property
    def auto(self) -> bool:
        """Whether up and front are to be found."""
        return told(self.up, self.front)[0]


@dataclass(frozen=True)
class Listing:
    """The references of a source by slug, in natural order of their names; and paths that will not be read, and why."""

    sources: Mapping[str, Source]
    skipped: Mapping[Path, str]
    origin: Origin = field(default_factory=lambda: Origin(""))
    files: Mapping[str, Source] = field(default_factory=dict)  # by slug, of what is one of several objects in a file

    @property
    def whole(self) -> list[str]:
        """Slugs of files that are to be split, and are not yet."""
        split = ("apart", "names")
        return [slug for slug, one in self.sources.items() if one.switches.split in split and slug not in self.files]

    def parted(self, slug: str, names: Sequence[str]) -> Listing:
        """With the objects in a file in its place."""
        file, sources, files = self.sources[slug], dict[str, Source](), dict(self.files)
        taken = tuple(other for other in self.sources if other != slug)
        slugs = file_names((*taken, *names))
        for other, source in self.sources.items():
            for name in names if other == slug else ():
                sources[slugs[name]], files[slugs[name]] = replace(file, name=name), file
            if other != slug:
                sources[other] = source
        return replace(self, sources=sources, files=files)

    @property
    def free(self) -> set[str]:
        """Slugs of the references whose up and front are to be found: their author does not tell them."""
        return {slug for slug, one in self._solid.items() if not one.by_author}

    @property
    def told(self) -> dict[str, Orientation]:
        """What the author tells of the others, by slug."""
        return {slug: one.orientation for slug, one in self._solid.items() if one.by_author}

    @property
    def _solid(self) -> dict[str, Source]:
        """Those that have an up and a front to be found."""
        sources = self.sources.items() if self.origin.auto else ()
        return {slug: one for slug, one in sources if one.path.suffix.lower() in (*MESHES, *CLOUDS)}

    def kept_picture(self, cache: Path, slug: str, found: Orientation | None = None) -> Path | None:
        """See the function of this name. found: how its shape is turned, where that was found."""
        source = self.sources[slug]
        return kept_picture(cache, source, found, source.name if slug in self.files else None)

    def kept_shape(self, cache: Path, slug: str, stance: Mapping[str, Any] | None, up: str) -> Path | None:
        """Where the message of a large mesh is kept or is to be kept; None when its file is not there.

        stance: how a run found it to stand, where one did. up: the procedure's axis that points up.
        """
        standing = sorted(stance.items()) if stance is not None else None
        part = self.sources[slug].name if slug in self.files else None
        name = version_of(self.sources[slug], "shape", SHAPE_FORMAT, standing, up, part)
        return cache / SHAPES / f"{name}.mesh" if name else None

    @property
    def dimension(self) -> Literal[2, 3]:
        """2 where all are drawings, else 3."""
        kinds = {source.path.suffix.lower() for source in self.sources.values()}
        return 2 if kinds and not kinds & {*MESHES, *CLOUDS} else 3


def listing(origin: Origin) -> Listing:
    """The references of a source, unread. Raises CollectionError as ``find`` does."""
    up, front = ("y", None) if origin.auto else (origin.up, origin.front)
    sources = find([origin.source], up, front, origin.keep)
    home = Path(origin.confine).resolve() if origin.confine else None
    skipped = {one.place: one.refusal for one in sources if one.refusal}
    skipped |= {one.place: "left out by the manifest" for one in sources if one.switches.leave_out}
    for one in sources:
        if home and not (one.archive or one.path).resolve().is_relative_to(home):
            skipped[one.place] = _OUTSIDE
    inside = [source for source in sources if source.place not in skipped]
    slugs = file_names(tuple(source.name for source in inside))
    return Listing({slugs[source.name]: source for source in inside}, skipped, origin)


def version_of(source: Source, *more: object) -> str | None:
    """A name for a file as it is now, and for more that matters; None when the file is not there."""
    try:
        state = source.path.stat()
    except OSError:
        return None
    own = source.keep, source.switches.drop, source.switches.split
    read = (source.path.resolve(), state.st_mtime_ns, state.st_size, source.orientation, *own)
    return hashlib.blake2b(repr((*read, *more)).encode(), digest_size=16).hexdigest()


def kept_picture(cache: Path, source: Source, found: Orientation | None = None, part: str | None = None) -> Path | None:
    """Where the thumbnail of a file, as it is now, is kept or is to be kept; None when the file is not there.

    found: how its shape is turned, where that was found. part: the name of the object in it that is shown.
    """
    name = version_of(source, PICTURE, _PICTURE_FORMAT, found, part)
    return cache / PICTURES / f"{name}.png" if name else None
