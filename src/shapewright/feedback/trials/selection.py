"""Which proposals are worth showing: all are tried on a few misfits, the most promising on all of them.

Shapes of a proposal that are built before any search mostly say already what a change is worth. Searches go to the
leading proposals, and to the references that are near.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapewright.building import Workers
from shapewright.feedback.case import Replica
from shapewright.feedback.ideas.proposal import Misfit, Proposal
from shapewright.feedback.trials.attempt import (
    BRIEF,
    ENOUGH,
    FEW_SCALARS,
    LONG,
    OTHER_CHOICES,
    builds_the_same,
    nearest_starts,
    outcome_of,
    turned_to,
    with_borrowed_choices,
)
from shapewright.feedback.trials.change import Change, Trials, change_of, way, worth_showing
from shapewright.feedback.trials.outcome import PROMISING, Outcome
from shapewright.feedback.trials.random_shapes import RandomShapes
from shapewright.feedback.trials.tried import Tried
from shapewright.feedback.writing.source import EditError
from shapewright.judging.judge import Judge
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure, ProcedureError
from shapewright.search.budgets import Budget

# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_BUILT = 20  # proposals of which shapes are built, at most
_SAMPLED = 12  # misfits that these are built for
_LEADING, _SEARCHED = 8, 4  # proposals that are searched with before one is chosen, and misfits of each
_CONFIRMED, _LONGER = 7, 3  # proposals that are tried on all misfits, at most; of these with longer Ranges alone
_LEADING_SHARE = 0.3  # of all evaluations, for the leading proposals
_CONFIRMED_SHARE = 0.35  # of what is left, for each that is tried on all misfits
_BORROWED = 0.15  # of these, for the choices that suit others
_LITTLE = 0.05  # of the most that is promised, that is not worth a trial
_LEAST = 24  # evaluations that a search is worth beginning with
_FAR = 3.0  # what lies further apart is not searched for with longer Ranges, which may change much
_CLOSE = 0.4  # how little longer Ranges should leave apart, so that they are long enough


@dataclass(frozen=True, eq=False)
class _Prospect:
    """A proposal, where searches for some misfits may begin, and how many references it may make replicated."""

    proposal: Proposal
    starts: Outcome
    promise: float


def selected(
    procedure: Procedure,
    ideas: Sequence[Proposal],
    misfits: Sequence[Misfit],
    judge: Judge,
    known: Sequence[Replica],
    evaluations: int,
    limit: int,
) -> tuple[list[Change], list[Tried]]:
    """The proposals that bring references nearer, the most worth reading first; and all that were searched with.

    ideas: the likeliest first. known: replicas that no change may alter. evaluations: shapes built for searches, about.
    limit: of the number of changes. None only repeats part of what another does.
    """
    with Workers.of(procedure, judge.settings, judge.crew.executor if judge.crew else None) as crew:
        trials = Trials(procedure.space, crew, misfits, judge, RandomShapes.of(crew, judge.settings.seed))
        prospects = [prospect for idea in ideas[:_BUILT] for prospect in _built(trials, idea, known)]
        leading = sorted(prospects, key=lambda prospect: -prospect.promise)
        # What a longer Range brings only a search tells: half of the places are theirs.
        longer = [prospect for prospect in leading if prospect.proposal.rule is None][: _LEADING // 2]
        leading = [*longer, *(prospect for prospect in leading if prospect not in longer)]
        share = int(_LEADING_SHARE * evaluations / min(_LEADING, max(len(leading), 1)))
        leading[:_LEADING] = [_briefly_searched(trials, prospect, share) for prospect in leading[:_LEADING]]
        leading = sorted(leading, key=lambda prospect: -prospect.promise)
        longer = [prospect for prospect in leading if prospect.proposal.rule is None][_LONGER:]  # say much the same
        leading = [prospect for prospect in leading if prospect not in longer]
        changes: list[Change] = []
        tried: list[Tried] = []
        left = (1.0 - _LEADING_SHARE) * evaluations
        for prospect in leading[:_CONFIRMED]:
            if prospect.promise <= _LITTLE * leading[0].promise:
                break
            allowed, idea, begun = int(_CONFIRMED_SHARE * left), prospect.proposal, time.monotonic()
            left -= allowed
            outcome = _outcome_for_all(trials, prospect, allowed)
            changes += change_of(trials, idea, outcome)
            nearer = [m.row for m in misfits if outcome.apart(m.row) < m.nearest.apart]
            best = min((outcome.apart(row) for row in nearer), default=np.inf)
            tried.append(Tried(idea.title, idea.kind, len(nearer), best, time.monotonic() - begun))
        return worth_showing(trials, changes, limit), sorted(tried, key=lambda one: one.best)


def _built(trials: Trials, idea: Proposal, known: Sequence[Replica]) -> Iterator[_Prospect]:
    """The proposal with shapes built for some misfits, half of them those it is for; nothing if it is of no use."""
    misfits = trials.misfits
    groups = [[m for m in misfits if (m.row in idea.starts) == own] for own in (True, False)]
    some = [m for group in groups for m in _spread(group, _SAMPLED - min(_SAMPLED // 2, len(misfits) - len(group)))]
    try:
        with turned_to(idea.write(idea.ranges), trials.crew) as crew:
            if builds_the_same(crew, known):
                pieces = {m.row: m.pieces for m in some}
                starts = nearest_starts(crew, {m.row: idea.candidates(m) for m in some}, trials.judge, pieces)
                starts = starts.whole(pieces).only_counted()
                yield _Prospect(idea, starts, _promise(idea, misfits, {m.row: way(m, starts) for m in some}))
    except (EditError, ProcedureError):
        return


def _spread(misfits: Sequence[Misfit], count: int) -> list[Misfit]:
    return [misfits[i] for i in sorted({int(i) for i in np.linspace(0, len(misfits) - 1, count)})] if misfits else []


def _promise(idea: Proposal, misfits: Sequence[Misfit], ways: Mapping[int, float]) -> float:
    """How many references the proposal may make replicated: those that were tried stand for the others."""
    promise = 0.0
    for own in (True, False):
        group = [m.row for m in misfits if (m.row in idea.starts) == own]
        seen = [ways[row] for row in group if row in ways]
        promise += len(group) * float(np.mean(seen)) if seen else 0.0
    return promise


def _briefly_searched(trials: Trials, prospect: _Prospect, evaluations: int) -> _Prospect:
    """The same after a short search for the nearest of the misfits that it is for, which then stand for the others."""
    idea, starts, misfits = prospect.proposal, prospect.starts, trials.misfits
    ways = {m.row: way(m, starts) for m in misfits if m.row in starts.replicas}
    budget = BRIEF.within(max(evaluations / _SEARCHED, _LEAST), int(trials.space.scalars.sum()))
    near = sorted((row for row in ways if row in idea.starts and ways[row] < 1.0), key=starts.apart)
    near = near[: min(_SEARCHED, evaluations // _LEAST)]
    if not near:
        return prospect
    with turned_to(idea.write(idea.ranges), trials.crew) as crew:
        begin = {row: starts.parameters[row] for row in near}
        starts = starts.joined(outcome_of(crew, begin, trials.judge, budget, sure=idea.flag).using(idea.uses))
    after = {m.row: way(m, starts) for m in misfits if m.row in ways}
    lift = float(np.mean([after[row] for row in near]))
    after = {row: way if row in near or row not in idea.starts else max(way, lift) for row, way in after.items()}
    return replace(prospect, starts=starts, promise=_promise(idea, misfits, after))


def _outcome_for_all(trials: Trials, prospect: _Prospect, evaluations: int) -> Outcome:
    """What the proposal gives for all misfits: before a search, with the choices that suit others, and after one."""
    idea, judge, pieces = prospect.proposal, trials.judge, {m.row: m.pieces for m in trials.misfits}
    with turned_to(idea.write(idea.ranges), trials.crew) as crew:
        space = crew.procedure.space
        others = {m.row: idea.candidates(m) for m in trials.misfits if m.row not in prospect.starts.replicas}
        outcome = prospect.starts.joined(nearest_starts(crew, others, judge, pieces)).whole(pieces)
        fresh = [name for name in space.names if name not in trials.space.names]
        left, before = evaluations, 0
        turns: list[tuple[Budget, Sequence[str] | None, float]] = [
            (FEW_SCALARS, fresh, 1.0),
            (LONG, None, 1.0),
            (OTHER_CHOICES, None, 1.0),
        ]
        if idea.rule is None:
            turns.append((LONG, None, _CLOSE))
        for turn, (budget, only, aim) in enumerate(turns):
            if idea.rule and len(outcome.replicated) > before:
                before = len(outcome.replicated)
                borrowed = with_borrowed_choices(space, outcome, outcome.parameters)
                borrowed = _afforded(borrowed, int(_BORROWED * left))
                left -= sum(len(several) for several in borrowed.values())
                lent = nearest_starts(crew, borrowed, judge, pieces).using(idea.uses)
                outcome = outcome.joined(lent).whole(pieces)
            free = int(space.scalars.sum()) if only is None else len(only)
            rows = _worth_a_search(outcome, aim, PROMISING if idea.rule else _FAR)
            rows = rows[: left // min(budget.evaluations(free), _LEAST)]
            if rows and free:
                within = budget.within(left / len(rows), free)
                left -= len(rows) * within.evaluations(free)
                begin = {row: outcome.parameters[row] for row in rows}
                searched = outcome_of(crew, begin, judge, within, turn, ENOUGH * aim, only, idea.flag)
                outcome = outcome.joined(searched.using(idea.uses)).whole(pieces)
    return outcome


def _worth_a_search(outcome: Outcome, aim: float, far: float) -> list[int]:
    """Rows of references so far apart: those not replicated first, the nearest first."""
    rows = [row for row in outcome.counted if aim < outcome.apart(row) <= far]
    return sorted(rows, key=lambda row: (row in outcome.replicated, outcome.apart(row)))


def _afforded(candidates: Mapping[int, list[Parameters]], most: int) -> dict[int, list[Parameters]]:
    """As many candidates of each reference as there may be in all."""
    share = max(1, most // max(len(candidates), 1))
    return {row: several[:share] for row, several in list(candidates.items())[:most]}
