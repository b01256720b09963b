"""Thumbnails of a run's references and replicas: drawn, or read from its folder."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from shapewright.rendering.thumbnails import seen_from, thumbnail
from shapewright.runs import packed
from shapewright.runs.result import Result
from shapewright.shapes import Mesh
from shapewright.shapes.shelf import fresh
from shapewright.threads import in_threads

Pair: TypeAlias = tuple[bytes, bytes | None]
"""Thumbnails (PNG) of a reference and of its replica, None where it has none."""
Pictures: TypeAlias = Mapping[str, Pair]


def draw_pictures(results: Sequence[Result], threads: int | None = None) -> Pictures:
    """Thumbnails (PNG) of every reference and replica, by name."""
    drawn = in_threads(_drawn, [result for result in results if result.reference is not None], threads)
    return dict(zip([result.name for result in results], drawn, strict=True))


def _drawn(result: Result) -> Pair:
    assert result.reference is not None
    reference, replica = thumbnail(fresh(result.reference)), result.replica
    if isinstance(replica, Mesh) and result.places:
        return reference, seen_from(replica, [np.array(place) for place in result.places])
    return reference, None if replica is None else thumbnail(replica)


class KeptPictures(Mapping[str, Pair]):
    """The thumbnails of a run that is on disk, each read when it is asked for."""

    def __init__(self, folder: Path, entries: Sequence[Mapping[str, Any]]) -> None:
        self._folder, self._slugs = folder, {entry["name"]: entry["slug"] for entry in entries}

    def __len__(self) -> int:
        return len(self._slugs)

    def __iter__(self) -> Iterator[str]:
        return iter(self._slugs)

    def __getitem__(self, name: str) -> Pair:
        return _read_pictures(self._folder, self._slugs[name])


def pictures_of(folder: Path, entries: Iterable[Mapping[str, Any]]) -> Iterator[tuple[str, Pair]]:
    return ((entry["name"], _read_pictures(folder, entry["slug"])) for entry in entries)


def _read_pictures(folder: Path, slug: str) -> Pair:
    reference, replica = (packed.read(folder, f"thumbnails/{slug}.{kind}.png") for kind in ("reference", "replica"))
    if reference is None:
        raise FileNotFoundError(f"{folder}: the run has lost the picture of {slug}")
    return reference, replica
