"""How long to search for the parameters of drawings.

They are built and measured quickly, but what pictures say changes more from place to place. Lines that are thin overlap
nothing at first, so a search goes by one scale of blur after the other. A part too many or too few changes too little
for the predicted choices to be trusted, so others are tried, and the simple forms too.
"""

from __future__ import annotations

from shapewright.search.budgets import Budget, Round

_FINE = 0.01


def _down(part: int, combinations: int, turns: int = 1, probe: float = 0.04) -> tuple[Round, ...]:
    """Models made afresh and followed, so often, by one part of the residuals."""
    return (Round(combinations, afresh=True, probe=probe, part=part), Round(combinations, 3, part=part)) * turns


def _from(part: int, *combinations: int, turns: int) -> tuple[Round, ...]:
    """From new starts by finer and finer parts, with so many combinations at each."""
    rounds: tuple[Round, ...] = (Round(combinations[0], part=part), Round(combinations[0], 3, part=part))
    for finer, count in enumerate(combinations):
        rounds += _down(part + finer, count, turns)
    return rounds


_CHOICE = Round(20, other="choice", part=1)
DRAWN = Budget(
    (Round(16), *_from(0, 4, 3, 2, 1, turns=1), _CHOICE, *_from(1, 4, 2, 2, turns=1), *_down(3, 1, 2, _FINE)), simple=6
)
DRAWN_THOROUGH = Budget(
    (
        Round(22),
        *_from(0, 5, 3, 2, 2, turns=2),
        *(Round(1, other="plain"), *_from(0, 1, 1, 1, 2, turns=2)),
        *(_CHOICE, *_from(1, 5, 3, 2, turns=2)),
        *(Round(20, other="plain"), *_from(0, 8, 3, 2, 2, turns=2)),
        *(_CHOICE, *_from(1, 5, 3, 2, turns=2)),
        *(*_down(2, 1, 2), *_down(3, 1, 4), *_down(3, 1, 4, _FINE)),
    ),
    simple=10,
)
