"""What the judge says of a replica: how likely a person calls it the same as its reference, and where it is not."""

from __future__ import annotations

import math
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


@dataclass(frozen=True)
class Standing:
    """How near a replica is to its reference."""

    distance: float  # by the paper's measure; NaN where it cannot be measured
    field: int  # the light field in which the two differ least
    fidelity: float  # NaN by the paper's judge
    apart: float  # from a perfect replica: at most 1 is replicated; NaN where it cannot be measured


_PERFECT = 0.99  # a fidelity that is as good as 1
_LEAST = 1e-30  # of a fidelity, so that its odds are finite


def apart_of(value: float, settings: Judging) -> float:
    """How far a fidelity is from a perfect one: 0 from 0.99 on, 1 at the cut of the replicated, and more beyond it.

    It goes by log odds, whose logarithm counts beyond the cut: they tell which of two poor replicas is the better one.
    """
    perfect, cut = max(_PERFECT, (1.0 + settings.replicated) / 2.0), settings.replicated
    if math.isnan(value) or value >= perfect:
        return 0.0 if value >= perfect else math.nan
    away = (_log_odds(perfect) - _log_odds(value)) / (_log_odds(perfect) - _log_odds(cut))
    return away if away <= 1.0 else 1.0 + math.log(away)


def _log_odds(value: float) -> float:
    value = max(value, _LEAST)
    return math.log(value / (1.0 - value))


def grade_by(settings: Judging, value: float, compatible: bool) -> Grade:
    """The grade by the judge of the settings: by a fidelity, or by whether the paper's measure calls it compatible."""
    if settings.judge == "paper":
        return "replicated" if compatible else "different"
    return grade_of(value, settings)


def grade_of(value: float, settings: Judging) -> Grade:
    """The grade of a fidelity, by the two cuts of the settings; NaN is different."""
    if value >= settings.replicated:
        return "replicated"
    return "close" if value >= settings.close else "different"
