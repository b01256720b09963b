"""How a length is divided: by lengths and weights, into equal parts, into as many as fit."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from types import EllipsisType
from typing import TypeAlias

ROUNDING = 1e-9  # how far sizes may exceed the whole, as a part of it: more than sums of decimal fractions are off


@dataclass(frozen=True, slots=True)
class share:  # noqa: N801 - written like a number in a list of sizes
    """A weighted part of what the other sizes of a split leave; ``...`` is ``share(1)``."""

    weight: float


Size: TypeAlias = float | share | EllipsisType


def split(whole: float, sizes: tuple[Size, ...]) -> list[tuple[float, float]]:
    """Start and end of each piece: lengths as given, shares of what these leave by weight.

    Raises ValueError for a negative size, and for lengths that come to more than the whole.
    """
    weights = [1.0 if size is ... else size.weight if isinstance(size, share) else 0.0 for size in sizes]
    lengths = [size if isinstance(size, int | float) else 0.0 for size in sizes]
    if any(not (math.isfinite(number) and number >= 0.0) for number in (*lengths, *weights)):
        raise ValueError(f"the sizes {_spell(sizes)} must be finite, and none negative")
    rest = whole - sum(lengths)
    if rest < -ROUNDING * whole:
        raise ValueError(f"the sizes {_spell(sizes)} are {-rest:.4g} more than the {whole:.4g} that there are")
    unit = max(rest, 0.0) / sum(weights) if any(weights) else 0.0
    cuts = [0.0]
    for length, weight in zip(lengths, weights, strict=True):
        cut = cuts[-1] + length + weight * unit
        cuts.append(whole if abs(cut - whole) <= ROUNDING * whole else cut)
    return list(itertools.pairwise(cuts))


def repeat(whole: float, count: int | None, size: float | None, gap: float | None) -> list[tuple[float, float]]:
    """Start and end of equal pieces with equal gaps between them that fill the whole; see ``Box.repeat``.

    Raises ValueError when no size above 0 and gap from 0 up fit, or when count, size and gap are all given.
    """
    if None not in (count, size, gap):
        raise ValueError("of count, size and gap give two: the third follows")
    if count is not None and size is not None:
        number, length = count, float(size)
        space = (whole - count * length) / (count - 1) if count > 1 else 0.0
    elif count is not None:
        number, space = count, gap or 0.0
        length = (whole - (number - 1) * space) / max(number, 1)
    elif size is not None:
        space = gap or 0.0
        number = max(round((whole + space) / (size + space)), 1) if size > 0.0 else 0
        number -= number > 1 and (number - 1) * space >= whole  # all gap
        length = (whole - (number - 1) * space) / max(number, 1)
    else:
        raise ValueError("it takes a count, or a size, or two of count, size and gap")
    if number < 1 or not length > 0.0 or space < -ROUNDING * whole:
        raise ValueError(
            f"count={count}, size={size}, gap={gap} would divide {whole:.4g} into {number} pieces of {length:.4g} "
            f"with gaps of {space:.4g}"
        )
    starts = [i * (length + max(space, 0.0)) for i in range(number)]
    ends = [start + length for start in starts]
    ends[-1] = whole if abs(ends[-1] - whole) <= ROUNDING * whole else ends[-1]
    return list(zip(starts, starts[1:] + ends[-1:] if space <= 0.0 else ends, strict=True))


def _spell(sizes: tuple[Size, ...]) -> str:
    return ", ".join(
        "..." if size is ... else f"share({size.weight:g})" if isinstance(size, share) else f"{size:.4g}"
        for size in sizes
    )
