"""How long to search for parameters, and how: the rounds of a refinement."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

_PROBE = 0.04


@dataclass(frozen=True)
class Round:
    """One round of the search: how many combinations of choices take part, and what is tried for each.

    A combination is first built as it is, then once with each scalar moved a little; only from its third round on are
    there ``steps`` along the model of its residuals, and ``strays``, random points around its best. near: only for
    references whose cost is above the goal but at most so many times it, and only while it is. afresh: instead of steps
    the scalars are each moved a little again, because the model has aged; by ``probe``, encoded, and to ``both`` sides
    where the model is to be exact enough for the search to end at the least cost. part: which of the parts of the
    residuals it goes by; models are kept where that changes, and combinations beyond those that take part are dropped.
    other: instead of all combinations those take part that differ from the best one in one choice ("choice"), these and
    the likeliest ("likely"), or these and its own with all scalars at their defaults ("plain"); the best one itself
    rests until the last part, or until a round that has it ``back``. rival: a combination takes part only while its
    cost is at most so many times the best's.
    """

    combinations: int
    steps: int = 2
    strays: int = 0
    near: float | None = None
    afresh: bool = False
    probe: float = _PROBE
    both: bool = False
    part: int = 0
    other: Literal["choice", "likely", "plain"] | None = None
    back: bool = False
    rival: float = np.inf


@dataclass(frozen=True)
class Budget:
    """How long to search. simple: so many starts are not predicted: the defaults, then these but for one choice.

    patience: after the first two rounds a search ends that so many rounds in a row have brought next to nothing.
    """

    rounds: tuple[Round, ...]
    simple: int = 0
    patience: int | None = None

    def evaluations(self, scalars: int) -> int:
        """Shapes built for each reference, at most, where so many scalars are free."""
        return int(np.sum(self._spent(scalars)))

    def within(self, evaluations: float, scalars: int) -> Budget:
        """The first rounds that fit in so many shapes, at least one combination of one."""
        fit = int((np.cumsum(self._spent(scalars)) <= evaluations).sum())
        if not fit:
            return Budget((Round(max(1, min(self.rounds[0].combinations, int(evaluations)))),))
        return replace(self, rounds=self.rounds[:fit])

    def _spent(self, scalars: int) -> list[int]:
        spent, fresh = [], True
        for i, r in enumerate(self.rounds):
            start = i == 0 or r.other is not None
            probes = scalars * (2 if r.both else 1)
            spent.append(r.combinations * (1 if start else probes if fresh or r.afresh else r.steps + r.strays))
            fresh = start
        return spent


def _exact(probe: float, times: int = 1) -> tuple[Round, ...]:
    """A model of the best combination made afresh from both sides, and followed, so often."""
    return (Round(1, afresh=True, probe=probe, both=True), Round(1, 3)) * times


_OTHERS = (
    Round(24, other="likely"),
    *(Round(4, rival=4.0), Round(4, 3, rival=4.0), Round(3, 2, 2, rival=2.5)),
    Round(2, afresh=True, both=True, probe=0.05, rival=2.0),
    *(Round(2, 3, rival=2.0),) * 2,
    Round(2, 2, 4, back=True),
)
"""Other choices tried with the scalars that were found; most soon cost far more than the best one."""
QUICK = Budget((Round(8), Round(3), Round(2, 2, 2), *_exact(0.05), *(Round(1, 2, 4, near=1.4),) * 8))
THOROUGH = Budget(
    (
        *(Round(24), Round(8), Round(6, 2, 4), Round(4, 2, 4), Round(3, 2, 6), *(Round(2, 2, 8),) * 4),
        *(*_exact(0.06, 3), *_OTHERS),
        *(*_exact(0.06, 2), *_OTHERS),
        *(*_exact(0.04, 2), *_exact(0.025, 2), *_OTHERS),
        *(*_exact(0.025, 2), *_OTHERS) * 2,
        *(*_exact(0.025, 2), *_exact(0.015, 3)),
    )
)
