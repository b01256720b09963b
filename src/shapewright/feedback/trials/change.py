"""A change that was tried: what it is, what it brings, and whether it is fit to be shown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from shapewright.building import Workers
from shapewright.feedback.ideas.needed_ranges import narrowed
from shapewright.feedback.ideas.proposal import Misfit, Proposal, Ranges
from shapewright.feedback.ideas.wider_ranges import of_longer
from shapewright.feedback.trials.attempt import LONG, outcome_of, turned_to
from shapewright.feedback.trials.outcome import Outcome
from shapewright.feedback.trials.random_shapes import RandomShapes, shows
from shapewright.feedback.writing.change import FileChange
from shapewright.feedback.writing.source import EditError
from shapewright.judging.judge import Judge
from shapewright.parameters import ParameterSpace
from shapewright.procedures import ProcedureError
from shapewright.shapes import Mesh

# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_NEARER = 0.25  # of the way to a replicated replica, that a reference has to come to be helped
_SLIGHTLY = 0.05  # of the same: nearer by chance is less. This and the next by hand, on chairs of benchmarks/hour.py
_MANY, _SEVERAL = 0.25, 4  # share and number of the misfits that have to come slightly nearer, where that is to count
_LEAST_VALUE = 0.6  # of a change to be shown: one reference nearly all the way, or some a part of it
_READING = 12  # lines of code that reading any suggestion costs as much as
_ANOTHER = 0.5  # of the ways of all misfits, that a change has to bring beyond those shown before. On vessels, by eye
_LOST = 0.1  # further apart with the final Ranges: worth another search


@dataclass(frozen=True, eq=False)
class Trials:
    """What proposals are tried with."""

    space: ParameterSpace  # of the procedure without any change
    crew: Workers  # workers that turn to one changed procedure after the other
    misfits: Sequence[Misfit]  # the references that need a change
    judge: Judge  # measures replicas
    plain: RandomShapes  # of the procedure without any change


@dataclass(frozen=True, eq=False)
class Change:
    """A proposal that is tried."""

    proposal: Proposal
    ranges: Ranges  # those that the references need
    edit: FileChange  # of the author's file, with these Ranges
    outcome: Outcome  # what it gives for the references
    helped: tuple[int, ...]  # rows of the references that come nearer, replicated ones with them
    value: float  # how many references it carries all the way, where two halves count as one

    @cached_property
    def source(self) -> str:
        """The changed text."""
        return self.edit.written(self.proposal.source)

    @property
    def worth(self) -> float:
        """The value per line of code that is to read."""
        return self.value / (_READING + self.lines)

    @property
    def lines(self) -> int:
        """Of code that are added, about."""
        return self.proposal.rule.lines if self.proposal.rule else 1


def change_of(trials: Trials, idea: Proposal, outcome: Outcome) -> Iterator[Change]:
    """The change where it brings enough, with the Ranges that the references need which it brings nearer."""
    helped = _helped({m.row: way(m, outcome) for m in trials.misfits})
    value = sum(done + 0.5 * max(1.0 - outcome.apart(row), 0.0) for row, done in helped.items())
    if value >= _LEAST_VALUE:
        ranges = narrowed(idea, trials.space, [outcome.parameters[row] for row in helped])
        if idea.rule is None:
            idea, ranges = of_longer(idea, trials.space, ranges)
        if idea.rule or ranges:
            yield Change(idea, ranges, idea.change(ranges), outcome, tuple(helped), value)


def _helped(ways: Mapping[int, float]) -> dict[int, float]:
    """The ways of those that come much nearer; where many come a little nearer, of all of these.

    A right step often carries nobody all the way: the back of a chair leans, but its legs are still another form.
    """
    much = {row: done for row, done in ways.items() if done >= _NEARER}
    some = {row: done for row, done in ways.items() if done >= _SLIGHTLY}
    return some if len(some) >= max(_SEVERAL, _MANY * len(ways)) else much


def way(misfit: Misfit, starts: Outcome) -> float:
    """How much of the way to a replicated replica a misfit has come, 0 to 1."""
    return misfit.way(starts.apart(misfit.row))


def worth_showing(trials: Trials, changes: Sequence[Change], limit: int) -> list[Change]:
    """Those to show, with the Ranges that their references need, judged with these."""
    needed = [change for change in changes if not any(_simpler(other, change) for other in changes)]
    shown: list[Change] = []
    for change in _ordered(needed):
        if len(shown) < limit and (not shown or _beyond(trials, change, shown) >= _ANOTHER):
            shown += _final(trials, change)
    return _ordered(shown)


def _ordered(changes: Sequence[Change]) -> list[Change]:
    return sorted(changes, key=lambda change: (-change.worth, len(change.ranges)))


def _beyond(trials: Trials, change: Change, shown: Sequence[Change]) -> float:
    """How much further a change brings misfits than what is shown before, summed over their ways.

    What does no more than a plainer change is no second suggestion: shelves fill a vessel as well as a thicker floor.
    """
    helped = [misfit for misfit in trials.misfits if misfit.row in change.helped]
    before = [max(way(m, other.outcome) if m.row in other.helped else 0.0 for other in shown) for m in helped]
    return sum(max(way(m, change.outcome) - most, 0.0) for m, most in zip(helped, before, strict=True))


def _simpler(one: Change, other: Change) -> bool:
    """Whether one makes fewer Ranges longer than the other, for as many references."""
    fewer = bool(one.proposal.ends) and set(one.proposal.ends) < set(other.proposal.ends)
    return fewer and len(one.helped) >= len(other.helped)


def _final(trials: Trials, change: Change) -> Iterator[Change]:
    """The same with its final text, and what that really gives; nothing if that is nothing, unsound or not seen."""
    idea, judge = change.proposal, trials.judge
    made = {row: change.outcome.parameters[row] for row in change.helped}
    try:
        with turned_to(change.source, trials.crew) as crew:
            shapes = trials.plain.changed(crew, idea.flag)
        if shapes.unsound > trials.plain.unsound:
            return
        if alone := idea.adding(change.edit):
            with turned_to(alone, trials.crew) as crew:
                shapes = shapes.adding(crew)
        branch = trials.plain.branch(shapes, list(made.values())) if idea.flag else None
        edit = change.edit.only_when(branch) if branch else change.edit
        with turned_to(edit.written(idea.source), trials.crew) as crew:
            outcome = outcome_of(crew, made, judge, None)
            lost = {row: made[row] for row in made if outcome.apart(row) > change.outcome.apart(row) + _LOST}
            outcome = outcome.joined(outcome_of(crew, lost, judge, LONG, sure=idea.flag).using(idea.uses))
        for final in change_of(trials, idea, outcome):
            if _shows(trials, replace(final, edit=edit)):
                yield replace(final, proposal=idea, ranges=change.ranges, edit=edit)
    except (EditError, ProcedureError):
        return


def _shows(trials: Trials, change: Change) -> bool:
    """Whether what the change adds is seen in most replicas that it helps."""
    before = {misfit.row: misfit.nearest.mesh for misfit in trials.misfits}
    added: dict[int, Mesh] = {}
    if alone := change.proposal.adding(change.edit):
        with turned_to(alone, trials.crew) as crew:
            builds = crew.build([change.outcome.parameters[row] for row in change.helped])
        added = {row: b.shape for row, b in zip(change.helped, builds, strict=True) if isinstance(b.shape, Mesh)}
    seen = [shows(before[row], change.outcome.replicas[row].mesh, added.get(row)) for row in change.helped]
    return 2 * sum(seen) > len(seen)
