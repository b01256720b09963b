"""The light field distance: how much two shapes differ to the eye, over all rotations (Chen et al. 2003).

Two scales, never mixed: *raw* distances are the whole numbers of the original program, normalised ones are
raw / ``RAW_SCALE``, the scale of the paper's threshold. Every function without "raw" in its name is normalised.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shapewright.comparison.light_field.cache import described_once
from shapewright.comparison.light_field.description import Descriptor, describe
from shapewright.comparison.light_field.dodecahedra import alignments, upright_rotations
from shapewright.comparison.light_field.least_cost import Weighted, least_of_all, least_of_some
from shapewright.settings import Align, Settings
from shapewright.shapes import Floats, Mesh
from shapewright.threads import in_threads

THRESHOLD = Settings.threshold
"""Shapes are compatible up to this normalised distance (paper section 4.3), with ART coefficients of 4 bits."""
RAW_SCALE = 15_000
"""Raw distance over normalised distance: the paper's code divides by it, so 0.18 is a raw distance of 2,700."""

_ALIGNMENTS = alignments()
_UPRIGHT = upright_rotations()


def descriptor(shape: Mesh, bits: int = 4, cache: str | PathLike[str] | None = None) -> Descriptor:
    """The light field descriptor of a shape.

    bits: 4, to which ``THRESHOLD`` belongs, or 8 as in an older version of the original. cache: a folder that keeps
    descriptors by geometry. Raises ValueError for a shape without faces, without size, or that no view shows.
    """
    return describe(shape, bits) if cache is None else described_once(shape, Path(cache), bits)


def descriptors(
    shapes: Iterable[Mesh | Descriptor],
    threads: int | None = None,
    cache: str | PathLike[str] | None = None,
    bits: int = 4,
) -> list[Descriptor]:
    """The descriptors of many shapes, in their order; those that are descriptors already stay as they are.

    threads: all cores by default; cache, bits: see ``descriptor``. Raises ValueError, with the number of the shape, as
    ``descriptor`` does.
    """

    def describe_one(numbered: tuple[int, Mesh | Descriptor]) -> Descriptor:
        number, shape = numbered
        if isinstance(shape, Descriptor):
            return shape
        try:
            return descriptor(shape, bits, cache)
        except ValueError as error:
            raise ValueError(f"shape {number}: {error}") from error

    return in_threads(describe_one, enumerate(shapes), threads)


def distance(a: Mesh | Descriptor, b: Mesh | Descriptor, align: Align = "free") -> float:
    """The normalised distance: 0 for equal shapes, at most ``THRESHOLD`` for compatible ones.

    align: "free" tries 6,000 rotations of one shape against the other, as the original does; "upright" only those of
    them that keep the Y axis within 12 degrees, for shapes that are known to stand: the result is never less.
    Raises ValueError as ``descriptor`` does, and for descriptors of different bits.
    """
    return raw_distance(a, b, align) / RAW_SCALE


def raw_distance(a: Mesh | Descriptor, b: Mesh | Descriptor, align: Align = "free") -> int:
    """The distance on the original's scale, a whole number: see ``distance``."""
    return int(raw_distances([a], [b], align, threads=1)[0, 0])


def distances(
    shapes: Sequence[Mesh | Descriptor],
    others: Sequence[Mesh | Descriptor] | None = None,
    align: Align = "free",
    threads: int | None = None,
) -> Floats:
    """Normalised distances (N, M) of N shapes to M others, or to each other: see ``distance``. threads: all cores."""
    return raw_distances(shapes, others, align, threads) / RAW_SCALE


def raw_distances(
    shapes: Sequence[Mesh | Descriptor],
    others: Sequence[Mesh | Descriptor] | None = None,
    align: Align = "free",
    threads: int | None = None,
) -> NDArray[np.int32]:
    """Distances (N, M) on the original's scale: see ``distances``. They are symmetric to the bit."""
    if align not in ("free", "upright"):
        raise ValueError(f'align is "free" or "upright", not {align!r}')
    rows = descriptors(shapes, threads)
    columns = rows if others is None else descriptors(others, threads)
    if len({each.bits for each in [*rows, *columns]}) > 1:
        raise ValueError("descriptors with ART coefficients of 4 and of 8 bits cannot be compared")
    raw = np.zeros((len(rows), len(columns)), dtype=np.int32)
    if not raw.size:
        return raw
    first = _table(rows, align)
    second = first if others is None else _table(columns, align)

    def fill_row(n: int) -> None:
        start = n + 1 if others is None else 0
        if align == "free":
            least_of_all(first[n], second[start:], _ALIGNMENTS, raw[n, start:])
        else:
            least_of_some(first[n], second[start:], _ALIGNMENTS, _UPRIGHT, raw[n, start:])

    in_threads(fill_row, range(len(rows)), threads)
    if others is None:
        raw += raw.T
    return raw


def _table(items: Sequence[Descriptor], align: Align) -> Weighted:
    return np.stack([item.by_coefficient if align == "free" else item.by_view for item in items])
