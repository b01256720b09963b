"""How long to search for parameters, and how: moves, one after the other."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from shapewright.search.moves import (
    BuildingMove,
    Continue,
    Move,
    Probe,
    Return,
    Scan,
    Step,
    SwitchChoices,
    UseScale,
    evaluations,
)

SPREAD = 0.1
"""Of the first random points, encoded. By trial on tables."""
_FINE = 0.01
"""Probes of drawings at the finest scale, whose pictures change within a pixel. By trial on drawings."""


@dataclass(frozen=True)
class Budget:
    """How long to search."""

    moves: tuple[Move, ...]  # the first is a Scan, but for a UseScale before it
    simple: int = 0  # first combinations that are not predicted: the defaults, then those but for one choice
    patience: int | None = None  # rounds in a row without progress that end a search, from the third round on
    spread: float = SPREAD  # standard deviation of the first random points around the best, encoded

    @property
    def combinations(self) -> int:
        """How many combinations a search starts with."""
        return next(move.combinations for move in self.moves if isinstance(move, Scan))

    @property
    def rounds(self) -> int:
        """How often shapes are built."""
        return sum(isinstance(move, BuildingMove) for move in self.moves)

    def evaluations(self, scalars: int) -> int:
        """Shapes built for each reference, at most, where this many scalars are free."""
        return sum(evaluations(move, scalars) for move in self.moves)

    def within(self, most: float, scalars: int) -> Budget:
        """The first moves that fit in this many shapes, up to one that builds; at least one combination of a Scan."""
        fit = int((np.cumsum([evaluations(move, scalars) for move in self.moves]) <= most).sum())
        while fit and not isinstance(self.moves[fit - 1], BuildingMove):
            fit -= 1
        if not fit:
            return Budget((Scan(max(1, min(self.combinations, int(most)))),))
        return replace(self, moves=self.moves[:fit])


def _exactly(size: float, times: int = 1) -> tuple[Move, ...]:
    """A new model of the best combination from both sides of each scalar, and three steps along it, some times."""
    return (Probe(1, size, both=True, again=True), Step(1, 3)) * times


# Eight combinations are built, three get a model and follow it. The best one is then followed exactly: long probes see
# what a thin wall changes, which is less than a sample of a picture is wide. With its scalars each single other choice
# shows what it is worth; the best two are followed beside it where they cost little more, since its scalars suit its
# own choices. Two, since the best one often changes next to nothing. After the next exact turn other choices are looked
# at again: a small hole shows once the rest lies right. It is explored further where a reference is incompatible by
# less than 40 %, and where the procedure seems to make the reference, since the cost still falls. Chosen on furniture
# chairs and tables and on shapes of the procedures themselves, reported on other collections (docs/benchmarks.md,
# "Longer probes" and "A second look at choices").
QUICK = Budget(
    (
        *(Scan(8), Probe(3, 0.08), Step(3, 3), *_exactly(0.1)),
        *(SwitchChoices("single"), Scan(16), Return(keep=2), Probe(3, 0.08, rival=1.3), Step(3, 3, rival=1.3)),
        *(Continue(), *_exactly(0.05), SwitchChoices("single"), Scan(16), Return(keep=2)),
        *(*(Step(1, scatter=4, near=1.4),) * 2, Continue(0.8)),
        *(Probe(2, 0.05, rival=1.5), Step(2, 3, rival=1.5), *_exactly(0.05), Continue(0.8), *_exactly(0.03)),
    )
)

# Where a procedure has choices and counts alone no slope leads anywhere: one of them is changed after the other, while
# that brings something. Of trays of five counts, predicted one or two off, 53 % come back; of 30 others a turn in place
# of 60 find 42 %, the search above 27 %.
CHOSEN = Budget(
    (
        Scan(16),
        Continue(),
        *(SwitchChoices("single"), Scan(60), Return(keep=1), Continue(0.999)) * 8,
    )
)

# Other choices with the scalars found by then. Late, the right choice is better at once; where it is not, its rivals
# are followed only while they cost little more.
_OTHERS: tuple[Move, ...] = (
    *(SwitchChoices("likely"), Scan(24)),
    *(Probe(4, rival=4.0), Step(4, 3, rival=4.0), Step(3, scatter=2, rival=2.5)),
    Probe(2, 0.05, both=True, again=True, rival=2.0),
    *(Step(2, 3, rival=2.0),) * 2,
    *(Return(keep=2), Step(2, scatter=4)),
)

# A wide search first. Then the best combination is followed exactly, from shorter and shorter probes, and other choices
# are tried after each turn: five times, chosen while looking at chairs (docs/benchmarks.md, "What more samples and a
# thorough search find").
THOROUGH = Budget(
    (
        *(Scan(24), Probe(8), Step(6, scatter=4), Step(4, scatter=4), Step(3, scatter=6), *(Step(2, scatter=8),) * 4),
        *(*_exactly(0.06, 3), *_OTHERS),
        *(*_exactly(0.06, 2), *_OTHERS),
        *(*_exactly(0.04, 2), *_exactly(0.025, 2), *_OTHERS),
        *(*_exactly(0.025, 2), *_OTHERS) * 2,
        *(*_exactly(0.025, 2), *_exactly(0.015, 3)),
    )
)


# What a scan does not show makes a network less sure of choices, so other choices get a turn of their own. Chosen on
# scans of 140 shapes of four categories (docs/benchmarks.md, "Scans").
SCANNED = Budget(
    (
        *(Scan(12), Probe(4, 0.08), Step(3, 3), *_exactly(0.1), *_exactly(0.05)),
        *(*_OTHERS, *_exactly(0.1), *_exactly(0.05)),
        *(Step(1, scatter=4, near=1.4),) * 2,
    )
)


def _followed(combinations: int, turns: int = 1, size: float = 0.04) -> tuple[Move, ...]:
    """New models and three steps along them, some times."""
    return (Probe(combinations, size, again=True), Step(combinations, 3)) * turns


def _finer(scale: int, combinations: tuple[int, ...], turns: int) -> tuple[Move, ...]:
    """From new starts at one scale by finer and finer ones, with fewer combinations at each."""
    moves: tuple[Move, ...] = (Probe(combinations[0]), Step(combinations[0], 3), *_followed(combinations[0], turns))
    for finer, count in enumerate(combinations[1:], scale + 1):
        moves += (UseScale(finer, keep=count), *_followed(count, turns))
    return moves


_SINGLE: tuple[Move, ...] = (SwitchChoices("single", scale=1), Scan(20))

# Drawings are built and measured quickly, but what pictures say changes more from place to place. Lines that are thin
# overlap nothing at first, so a search goes by one scale of blur after the other. A part too many or too few changes
# too little for the predicted choices to be trusted, so others are tried, and the simple forms too. Chosen on the worst
# of the real drawings of docs/benchmarks.md.
DRAWN = Budget(
    (
        *(Scan(16), *_finer(0, (4, 3, 2, 1), turns=1)),
        *(*_SINGLE, *_finer(1, (4, 2, 2), turns=1)),
        *_followed(1, 2, _FINE),
    ),
    simple=6,
)

# The same for longer, and the simple forms with the best choices: twice, the best one alone and then all beside it.
DRAWN_THOROUGH = Budget(
    (
        *(Scan(22), *_finer(0, (5, 3, 2, 2), turns=2)),
        *(SwitchChoices("defaults", scale=0), Scan(1), *_finer(0, (1, 1, 1, 2), turns=2)),
        *(*_SINGLE, *_finer(1, (5, 3, 2), turns=2)),
        *(SwitchChoices("defaults", scale=0), Scan(20), *_finer(0, (8, 3, 2, 2), turns=2)),
        *(*_SINGLE, *_finer(1, (5, 3, 2), turns=2)),
        *(UseScale(2, keep=1), *_followed(1, 2)),
        *(UseScale(3, keep=1), *_followed(1, 4), *_followed(1, 4, _FINE)),
    ),
    simple=10,
)


# A mesh seen in a picture: the camera is found anew for each shape, which costs more than building most. The network
# errs in choices that show little, so the single other ones are tried with the best scalars. Chosen on tables and
# chairs of docs/benchmarks.md, "Pictures of objects".
VIEWED = Budget(
    (
        *(UseScale(1, keep=14), Scan(14), Probe(2), Step(2), UseScale(2, keep=2), Step(2)),
        *(SwitchChoices("single"), Scan(16), Probe(1), Step(1), Return(keep=1)),
        *(UseScale(3, keep=1), Probe(1, again=True), Step(1), Step(1), *(Step(1, scatter=2),) * 2),
    )
)
VIEWED_THOROUGH = Budget(
    (
        *(UseScale(1, keep=24), Scan(24), Probe(4), Step(4), UseScale(2, keep=3), Probe(3, again=True), Step(3)),
        *(SwitchChoices("likely"), Scan(24), Probe(3), Step(3), Return(keep=2), Probe(2, again=True), Step(2, 3)),
        *(SwitchChoices("single"), Scan(24), Probe(3), Step(3), Return(keep=2)),
        *(UseScale(3, keep=2), Probe(2, again=True), Step(2, 3), *_exactly(0.03, 3)),
        *(Step(1, scatter=4),) * 4,
    )
)


Sought: TypeAlias = Literal["meshes", "scans", "views", "drawings"]
"""What a search is for: references that are meshes, points, or pictures of objects; or a procedure that draws."""


def whole(sought: Sought, thorough: bool, numbers: bool = True) -> Budget:
    """The budget where no time is short. numbers: whether any parameter is one."""
    match sought:
        case "drawings":
            return DRAWN_THOROUGH if thorough else DRAWN
        case "views":
            return VIEWED_THOROUGH if thorough else VIEWED
        case "scans":
            return THOROUGH if thorough else SCANNED
    if not numbers:
        return CHOSEN
    return THOROUGH if thorough else QUICK
