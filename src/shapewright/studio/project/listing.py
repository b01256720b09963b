"""The project's references by name: what there is to read, listed without reading it, and where pictures are kept."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from shapewright.references.readers.formats import CLOUDS, MESHES
from shapewright.references.sources import Source, find
from shapewright.storage import file_names

PICTURE = 256
"""Pixels of a reference's thumbnail."""
PICTURES = "thumbnails"  # the folder in the cache
_PICTURE_FORMAT = 1
"""Part of every cached picture's name; raise it whenever the same file would get another picture."""
_OUTSIDE = "a link that leads out of the project folder; start the studio with --references to allow it"


@dataclass(frozen=True)
class Origin:
    """Where the references are."""

    source: str  # a folder, file or pattern
    up: str = "y"  # axis of the files
    front: str | None = None  # axis of the files; None for the usual one
    confine: str | None = None  # no file may lie outside this folder, links followed; None: the author named the source
    keep: tuple[str, ...] = ()  # what is left in scans


@dataclass(frozen=True)
class Listing:
    """The references of a source by slug, in natural order of their names; and paths that will not be read, and why."""

    sources: Mapping[str, Source]
    skipped: Mapping[Path, str]

    @property
    def dimension(self) -> Literal[2, 3]:
        """2 where all are drawings, else 3."""
        kinds = {source.path.suffix.lower() for source in self.sources.values()}
        return 2 if kinds and not kinds & {*MESHES, *CLOUDS} else 3


def listing(origin: Origin) -> Listing:
    """The references of a source, unread. Raises CollectionError as ``find`` does."""
    sources = find([origin.source], origin.up, origin.front, origin.keep)
    home = Path(origin.confine).resolve() if origin.confine else None
    skipped = {one.place: one.refusal for one in sources if one.refusal}
    skipped |= {one.place: "left out by the manifest" for one in sources if one.switches.leave_out}
    for one in sources:
        if home and not (one.archive or one.path).resolve().is_relative_to(home):
            skipped[one.place] = _OUTSIDE
    inside = [source for source in sources if source.place not in skipped]
    slugs = file_names(tuple(source.name for source in inside))
    return Listing({slugs[source.name]: source for source in inside}, skipped)


def kept_picture(cache: Path, source: Source) -> Path | None:
    """Where the thumbnail of a file, as it is now, is kept or is to be kept; None when the file is not there."""
    try:
        state = source.path.stat()
    except OSError:
        return None
    stands = (source.orientation, source.keep)
    named = (source.path.resolve(), state.st_mtime_ns, state.st_size, *stands, PICTURE, _PICTURE_FORMAT)
    digest = hashlib.blake2b(repr(named).encode(), digest_size=16).hexdigest()
    return cache / PICTURES / f"{digest}.png"
