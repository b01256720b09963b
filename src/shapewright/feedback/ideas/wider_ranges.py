"""Wider Ranges, where several misfits rest on the same ends."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

from shapewright.feedback.ideas.proposal import Interval, Misfit, Proposal, Ranges, listed
from shapewright.feedback.writing.change import FileChange, NewLimits
from shapewright.feedback.writing.piece_code import number
from shapewright.feedback.writing.source import EditError
from shapewright.parameters import Integer, Parameter, Parameters, ParameterSpace, Scalar

# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_SHARE, _FEWEST = 0.05, 2  # of the misfits, that rest on an end which may move, at least
_COMMONEST, _ENDS = 8, 6  # ends that are looked at, and that move at most
_HELPED, _PRICE = 0.6, 0.1  # of a misfit that a longer Range may help; what each end is worth less for being changed


def wider_ranges(source: str, procedure: str, space: ParameterSpace, misfits: Sequence[Misfit]) -> Iterator[Proposal]:
    """A longer Range for each end that several misfits rest on, and one proposal for all these ends."""
    pressed = {misfit.row: space.pressed(misfit.nearest.parameters) for misfit in misfits}
    ends = Counter(end for row in pressed for end in sorted(pressed[row]))
    least = max(_FEWEST, _SHARE * len(misfits))
    often = [end for end, count in ends.most_common(_COMMONEST) if count >= least]
    common = [(name, side) for name, side in often if _can_be_longer(space[name], side)][:_ENDS]
    for chosen in dict.fromkeys([*((end,) for end in common), tuple(common)]) if common else ():
        names = tuple(dict.fromkeys(name for name, _ in chosen))
        wide = {name: _longer(space[name], {side for other, side in chosen if other == name}) for name in names}
        change = partial(_widened, procedure, space)
        try:
            change(wide).written(source)
        except EditError:
            continue
        starts: dict[int, Parameters] = {row: {} for row, its in pressed.items() if its & set(chosen)}
        worth = _HELPED * len(starts) - _PRICE * len(chosen)
        yield Proposal("range", _title(names), source, change, wide, starts, worth, ends=chosen)


def of_longer(proposal: Proposal, space: ParameterSpace, ranges: Ranges) -> tuple[Proposal, Ranges]:
    """A proposal of wider Ranges, and the Ranges, without those that an author reads as before."""
    longer = {name: ends for name, ends in ranges.items() if _reads_longer(space[name], *ends[:2])}
    ends = tuple(end for end in proposal.ends if end[0] in longer)
    return replace(proposal, title=_title(tuple(longer)) if longer else proposal.title, ends=ends), longer


def _title(names: Sequence[str]) -> str:
    return f"A wider Range of {listed(names)}"


def _reads_longer(parameter: Parameter, low: float, high: float) -> bool:
    """Whether a Range is longer in the digits that an author reads."""
    assert isinstance(parameter, Scalar | Integer)
    return (number(low), number(high)) != (number(parameter.low), number(parameter.high))


def _can_be_longer(parameter: Parameter, side: str) -> bool:
    """Whether a Range may move that end: one that starts at 0 does not start earlier."""
    low, high, _ = _longer(parameter, {side})
    assert isinstance(parameter, Scalar | Integer)
    return low < parameter.low or high > parameter.high


def _widened(procedure: str, space: ParameterSpace, ranges: Ranges) -> FileChange:
    limits = []
    for name, (low, high, _) in ranges.items():
        parameter = space[name]
        if isinstance(parameter, Scalar | Integer) and parameter.whole:
            limits.append(NewLimits(name, str(round(low)), str(round(high)), None))
        elif isinstance(parameter, Scalar):
            new = number(low) if low < parameter.low else None, number(high) if high > parameter.high else None
            ends = (float(new[0] or parameter.low), float(new[1] or parameter.high))
            limits.append(NewLimits(name, *new, _steps(parameter, *ends)))
    return FileChange(procedure, tuple(limits))


def _steps(parameter: Scalar, low: float, high: float) -> str | None:
    """As many steps as keep the old distance between them; listed ones with the new ends."""
    if isinstance(parameter.steps, int):
        apart = (parameter.high - parameter.low) / (parameter.steps - 1)
        return str(max(2, round((high - low) / apart) + 1))
    if parameter.steps is None:
        return None
    return f"({', '.join(f'{step:g}' for step in sorted({*parameter.steps, low, high}))})"


def _longer(parameter: Parameter, sides: set[str]) -> Interval:
    """Low, high and default of a Range that is longer on these sides."""
    assert isinstance(parameter, Scalar | Integer)
    longer = parameter.widened()
    return (
        longer.low if "low" in sides else parameter.low,
        longer.high if "high" in sides else parameter.high,
        parameter.default,
    )
