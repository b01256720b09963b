"""Thumbnails of many references: drawn some at a time, and kept on disk."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache, partial

import msgspec

from shapewright.fitting.keeping.unfinished import Form, Unfinished
from shapewright.progress import Stages
from shapewright.runs.folder import RunError
from shapewright.runs.pictures import Pair, Pictures, draw_pictures
from shapewright.runs.result import Result

_AT_ONCE = 500
"""References whose thumbnails are in memory at the same time: 10 kB each."""


def _write(pictures: Pictures) -> tuple[bytes, Iterable[bytes]]:
    return msgspec.msgpack.encode(dict(pictures)), ()


def _read(head: bytes, _: memoryview) -> Pictures:
    return msgspec.msgpack.decode(head, type=dict[str, Pair])


PICTURES: Form[Pictures] = Form(_write, _read)


class DrawnPictures(Mapping[str, Pair]):
    """The thumbnails of all results, drawn when this is made."""

    def __init__(self, results: Sequence[Result], unfinished: Unfinished, stages: Stages, threads: int | None) -> None:
        self._unfinished = unfinished
        self._piece: dict[str, str] = {}
        for start in range(0, len(results), _AT_ONCE):
            some, name = results[start : start + _AT_ONCE], f"pictures-{start:06d}"
            self._piece |= {result.name: name for result in some}
            unfinished.piece(name, PICTURES, partial(draw_pictures, some, threads), always=True)
            stages.step(start + len(some), len(results))
        self._last = lru_cache(maxsize=1)(self._kept)

    def __len__(self) -> int:
        return len(self._piece)

    def __iter__(self) -> Iterator[str]:
        return iter(self._piece)

    def __getitem__(self, name: str) -> Pair:
        return self._last(self._piece[name])[name]

    def _kept(self, piece: str) -> Pictures:
        pictures = self._unfinished.known(piece, PICTURES)
        if pictures is None:
            raise RunError("what this fit has kept on disk is gone: fit again")
        return pictures
