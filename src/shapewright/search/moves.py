"""The moves that a search is made of.

Scan, Probe and Step build shapes, for all references at once. A combination of choices may not be ready for a move.
Then the missing work comes first: a combination that was never measured is built with its scalars unchanged, and one
without a model is probed. A combination that has what the move would give takes steps instead.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

PROBE = 0.04
"""How far a probe moves a scalar, encoded: pixels make the slope of shorter moves too coarse. By trial on tables."""
STEPS = 2
"""Steps along a model, of different length, where a move says nothing else. By trial on tables."""


@dataclass(frozen=True)
class Scan:
    """Build combinations of choices that were not built yet, with their scalars unchanged."""

    combinations: int  # how many, the likeliest first


@dataclass(frozen=True)
class Probe:
    """Move each scalar of the best combinations a little, which gives a linear model of the residuals."""

    combinations: int  # how many of the best
    size: float = PROBE  # how far each scalar is moved, encoded
    both: bool = False  # to both sides, for a model that is exact enough for the search to end at the least cost
    again: bool = False  # also where there is a model, because it has aged
    rival: float = np.inf  # only combinations whose cost is at most this many times the best's


@dataclass(frozen=True)
class Step:
    """Follow the models of the best combinations, and scatter random points around their best."""

    combinations: int  # how many of the best
    steps: int = STEPS  # shapes along the model of each, each step shorter than the one before
    scatter: int = 0  # random points around the best of each, which keep it from resting in kinks
    rival: float = np.inf  # only combinations whose cost is at most this many times the best's
    near: float | None = None  # only for incompatible references, at a cost of at most this many times the goal


@dataclass(frozen=True)
class SwitchChoices:
    """Go on from other choices, while the best combination rests until it returns.

    "single" are the combinations that differ from the best one in one choice, or in a count by one or two. "likely"
    are these and the likeliest ones; "defaults" are the single ones and the best one, all with their scalars at the
    defaults.
    """

    to: Literal["single", "likely", "defaults"]
    scale: int | None = None  # of the residuals, by which they are compared, see ``UseScale``; by default the present


@dataclass(frozen=True)
class Return:
    """Let the best combination, which has rested, come back beside the best of the others."""

    keep: int  # how many of the others


@dataclass(frozen=True)
class UseScale:
    """Go by another part of the residuals; models are kept. At the last scale the best combination returns, too."""

    scale: int  # index of the part, coarse to fine; the last where there are fewer
    keep: int  # how many combinations go on, the best by the scale before


@dataclass(frozen=True)
class Continue:
    """Go on where the cost falls: end the searches that have more left than a share of it since the last such move."""

    share: float = 1.0  # of the cost at the last such move; the first one ends nothing


BuildingMove: TypeAlias = Scan | Probe | Step
Move: TypeAlias = BuildingMove | SwitchChoices | Return | UseScale | Continue


def evaluations(move: Move, scalars: int) -> int:
    """Shapes that a move builds for each reference, at most, where this many scalars are free."""
    match move:
        case Scan():
            return move.combinations
        case Probe():
            return move.combinations * scalars * (2 if move.both else 1)
        case Step():
            return move.combinations * (move.steps + move.scatter)
    return 0
