"""The moves that a search is made of.

Scan, Probe and Step build shapes, all references' at once. What a combination of choices is not ready for is made up
for: one that was never measured is built with its scalars unchanged, one without a model is probed. One that is ahead
of the move, because there were no other choices to switch to, takes steps instead.
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
    """Build combinations of choices that were not built yet, with their scalars unchanged.

    combinations: how many, the likeliest first.
    """

    combinations: int


@dataclass(frozen=True)
class Probe:
    """Move each scalar of the best combinations a little, which gives a linear model of the residuals.

    combinations: how many of the best.
    size: how far each scalar is moved, encoded.
    both: to both sides, for a model that is exact enough for the search to end at the least cost.
    again: also where there is a model, because it has aged.
    rival: only combinations whose cost is at most this many times the best's.
    """

    combinations: int
    size: float = PROBE
    both: bool = False
    again: bool = False
    rival: float = np.inf


@dataclass(frozen=True)
class Step:
    """Follow the models of the best combinations, and scatter random points around their best.

    combinations: how many of the best.
    steps: shapes along the model of each, each step shorter than the one before.
    scatter: random points around the best of each, which keep it from resting in kinks.
    rival: only combinations whose cost is at most this many times the best's.
    near: only for references that are incompatible, at a cost of at most this many times the goal.
    """

    combinations: int
    steps: int = STEPS
    scatter: int = 0
    rival: float = np.inf
    near: float | None = None


@dataclass(frozen=True)
class SwitchChoices:
    """Go on from other choices, while the best combination rests until it returns.

    to: "single" for the combinations that differ from the best one in one choice; "likely" for these and the likeliest
        ones; "defaults" for these of one choice and the best one, all with their scalars at the defaults.
    scale: of the residuals, by which they are compared, see ``UseScale``; by default the present one.
    """

    to: Literal["single", "likely", "defaults"]
    scale: int | None = None


@dataclass(frozen=True)
class Return:
    """Let the best combination, which has rested, come back beside the best of the others.

    keep: how many of the others.
    """

    keep: int


@dataclass(frozen=True)
class UseScale:
    """Go by another part of the residuals; models are kept. At the last scale the best combination returns, too.

    scale: index of the part, coarse to fine; the last where there are fewer.
    keep: how many combinations go on, the best by the scale before.
    """

    scale: int
    keep: int


BuildingMove: TypeAlias = Scan | Probe | Step
Move: TypeAlias = BuildingMove | SwitchChoices | Return | UseScale


def evaluations(move: Move, scalars: int) -> int:
    """Shapes that a move builds for each reference, at most, where so many scalars are free."""
    match move:
        case Scan():
            return move.combinations
        case Probe():
            return move.combinations * scalars * (2 if move.both else 1)
        case Step():
            return move.combinations * (move.steps + move.scatter)
    return 0
