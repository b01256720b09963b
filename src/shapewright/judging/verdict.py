"""What the judge says of a replica: how likely a person calls it the same as its reference, and where it is not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

from shapewright.settings import Judging

Grade: TypeAlias = Literal["replicated", "close", "different"]
Corner: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True)
class Region:
    """A connected piece of one surface, or of one drawing, that the other does not explain."""

    size: float  # the longest side of its box, as a share of the shape's largest extent
    low: Corner  # of its box, in the frame of the normalised reference; z is 0 for a drawing
    high: Corner  # the opposite corner
    share: float  # of the visible surface or of the area, 0 to 1


@dataclass(frozen=True)
class Evidence:
    """What the judge finds when it lays a replica beside its reference."""

    value: float  # the probability that a person calls the two the same, 0 to 1; NaN where they cannot be compared
    missing: tuple[Region, ...] = ()  # of the reference, without a counterpart; the largest first
    surplus: tuple[Region, ...] = ()  # of the replica, without a counterpart; the largest first


@dataclass(frozen=True)
class Verdict:
    """What is said of a replica and its reference."""

    value: float  # fidelity: the probability that a person calls the two the same, 0 to 1
    grade: Grade
    missing: tuple[Region, ...]  # of the reference, without a counterpart; the largest first
    surplus: tuple[Region, ...]  # of the replica, without a counterpart; the largest first
    measures: Mapping[str, float]  # by name, see ``Measures``; NaN for what cannot be measured


def grade_of(value: float, settings: Judging) -> Grade:
    """The grade of a fidelity, by the two cuts of the settings; NaN is different."""
    if value >= settings.replicated:
        return "replicated"
    return "close" if value >= settings.close else "different"
