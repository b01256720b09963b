"""Which proposals are worth showing: all are tried on a few misfits, the most promising on all of them.

A shape that is built as a proposal has it, before any search, mostly says already what a change is worth. Searches go
to what leads, and to the references that are near.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapewright.building import Limits, Workers
from shapewright.comparison.light_field import RAW_SCALE
from shapewright.feedback.ideas.proposal import Misfit, Proposal, Ranges
from shapewright.feedback.ideas.proposals import narrowed
from shapewright.feedback.trials.trial import (
    ENOUGH,
    GLANCE,
    LOOK,
    PEEK,
    PROMISING,
    SEARCH,
    Start,
    Trial,
    begun,
    changed,
    mixtures,
    tried,
    unchanged,
)
from shapewright.feedback.writing.edit import EditError
from shapewright.judging.judge import Judge
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure, ProcedureError
from shapewright.search.budgets import Budget
from shapewright.shapes import Mesh

Known = Sequence[tuple[Parameters, Mesh]]

_GLANCED = 20  # proposals of which shapes are built, at most
_SAMPLED = 12  # misfits that these are built for
_LEADING, _LED = 8, 4  # proposals that are searched with before one is chosen, and misfits of each
_CONFIRMED = 5  # proposals that are tried on all misfits, at most
_SHARES = (0.3, 0.35)  # of the evaluations left: for the leading proposals; for each that is tried on all misfits
_MIXED = 0.15  # of these, for the choices that suit others
_LITTLE = 0.05  # of the most that is promised, that is not worth a trial
_LEAST = 24  # evaluations that a search is worth beginning with
_FAR = 3.0  # thresholds: what lies further away is not searched for with longer Ranges, which may change much
_CLOSE = 0.4  # of the threshold: how near longer Ranges should come, so that they are long enough


@dataclass(frozen=True, eq=False)
class Tried:
    """A proposal, the Ranges that references need, the changed source, and what it gave for them."""

    proposal: Proposal
    ranges: Ranges
    source: str
    trial: Trial

    @property
    def value(self) -> float:
        """The references that become compatible; a close replica counts half as much again as one at the threshold."""
        trial = self.trial
        return sum(1.5 - 0.5 * trial.distances[row] / trial.threshold for row in trial.compatible)


@dataclass(frozen=True, eq=False)
class _Glanced:
    proposal: Proposal
    starts: Mapping[int, Start]
    promise: float


def selected(
    procedure: Procedure,
    ideas: Sequence[Proposal],
    misfits: Sequence[Misfit],
    judge: Judge,
    known: Known,
    evaluations: int,
    limit: int,
) -> list[Tried]:
    """At most so many proposals that make references compatible, the largest gain first, simpler first on a tie.

    ideas: the likeliest first. known: parameters and their shapes, which no change may alter. evaluations: shapes built
    for searches, about. None only repeats part of what another does.
    """
    settings = judge.settings
    with Workers(procedure, settings.workers, Limits(settings.shape_seconds, settings.shape_memory_mb)) as crew:
        glanced = [each for idea in ideas[:_GLANCED] for each in _glanced(crew, procedure, idea, misfits, judge, known)]
        leading = sorted(glanced, key=lambda each: -each.promise)
        # What a longer Range brings only a search tells: half of the places are theirs.
        longer = [each for each in leading if each.proposal.rule is None][: _LEADING // 2]
        leading = [*longer, *(each for each in leading if each not in longer)]
        share = int(_SHARES[0] * evaluations / min(_LEADING, max(len(leading), 1)))
        leading[:_LEADING] = [_led(crew, procedure, each, misfits, judge, share) for each in leading[:_LEADING]]
        leading = sorted(leading, key=lambda each: -each.promise)
        found, left = [], (1.0 - _SHARES[0]) * evaluations
        for each in leading[:_CONFIRMED]:
            if each.promise <= _LITTLE * leading[0].promise:
                break
            allowed = int(_SHARES[1] * left)
            left -= allowed
            trial = _confirmed(crew, procedure, each, misfits, judge, allowed)
            if trial.compatible:
                ranges = narrowed(each.proposal, procedure.space, [trial.parameters[row] for row in trial.compatible])
                found.append(Tried(each.proposal, ranges, "", trial))
        return _shown(crew, procedure, found, judge, limit)


def _glanced(
    crew: Workers, procedure: Procedure, idea: Proposal, misfits: Sequence[Misfit], judge: Judge, known: Known
) -> Iterator[_Glanced]:
    """The proposal with shapes built as it is for some misfits, half of them those it is for; nothing if it is of no
    use."""
    groups = [[m for m in misfits if (m.row in idea.starts) == own] for own in (True, False)]
    some = [m for group in groups for m in _spread(group, _SAMPLED - min(_SAMPLED // 2, len(misfits) - len(group)))]
    try:
        with changed(idea.write(idea.ranges), procedure, judge, crew) as new:
            if unchanged(new, known):
                pieces = {m.row: m.pieces for m in some}
                starts = begun(new, {m.row: idea.candidates(m) for m in some}, judge, pieces)
                stands = Trial.of(starts, judge.settings.threshold).standing(pieces).distances
                starts = {row: starts[row] for row in stands}
                yield _Glanced(idea, starts, _promise(idea, misfits, {m.row: _way(m, starts) for m in some}))
    except (EditError, ProcedureError):
        return


def _spread(misfits: Sequence[Misfit], count: int) -> list[Misfit]:
    return [misfits[i] for i in sorted({int(i) for i in np.linspace(0, len(misfits) - 1, count)})] if misfits else []


def _way(misfit: Misfit, starts: Mapping[int, Start]) -> float:
    return misfit.way(starts[misfit.row].cost) if misfit.row in starts else 0.0


def _promise(idea: Proposal, misfits: Sequence[Misfit], ways: Mapping[int, float]) -> float:
    """How many references the proposal may make compatible: those that were tried stand for the others."""
    promise = 0.0
    for own in (True, False):
        group = [m.row for m in misfits if (m.row in idea.starts) == own]
        seen = [ways[row] for row in group if row in ways]
        promise += len(group) * float(np.mean(seen)) if seen else 0.0
    return promise


def _led(
    crew: Workers, procedure: Procedure, glanced: _Glanced, misfits: Sequence[Misfit], judge: Judge, evaluations: int
) -> _Glanced:
    """The same after a short search for the nearest of the misfits that it is for, which then stand for the others."""
    idea, starts = glanced.proposal, glanced.starts
    ways = {m.row: _way(m, starts) for m in misfits if m.row in starts}
    budget = GLANCE.within(max(evaluations / _LED, _LEAST), int(procedure.space.scalars.sum()))
    near = sorted((row for row in ways if row in idea.starts and ways[row] < 1.0), key=lambda row: starts[row].cost)
    near = near[: min(_LED, evaluations // _LEAST)]
    if not near:
        return glanced
    with changed(idea.write(idea.ranges), procedure, judge, crew) as new:
        begin = {row: starts[row].parameters for row in near}
        trial = tried(new, begin, judge, budget, judge.settings.seed, sure=idea.flag).where(idea.uses)
    better = {
        row: Start(trial.parameters[row], trial.replicas[row], trial.distances[row] * RAW_SCALE)
        for row in near
        if trial.distances.get(row, np.inf) * RAW_SCALE < starts[row].cost
    }
    starts = {**starts, **better}
    after = {m.row: _way(m, starts) for m in misfits if m.row in starts}
    lift = float(np.mean([after[row] for row in near]))
    after = {row: way if row in near or row not in idea.starts else max(way, lift) for row, way in after.items()}
    return replace(glanced, starts=starts, promise=_promise(idea, misfits, after))


def _confirmed(
    crew: Workers, procedure: Procedure, glanced: _Glanced, misfits: Sequence[Misfit], judge: Judge, evaluations: int
) -> Trial:
    """What the proposal gives for all misfits: built as it is, with the choices that suit others, and searched for."""
    idea, pieces = glanced.proposal, {m.row: m.pieces for m in misfits}
    with changed(idea.write(idea.ranges), procedure, judge, crew) as new:
        space, scalars = new.procedure.space, int(new.procedure.space.scalars.sum())
        rest = {m.row: idea.candidates(m) for m in misfits if m.row not in glanced.starts}
        starts = {**glanced.starts, **begun(new, rest, judge, pieces)}
        trial = Trial.of(starts, judge.settings.threshold).standing(pieces)
        fresh = [name for name in space.names if name not in procedure.space.names]
        left, held = evaluations, 0
        turns: list[tuple[Budget, Sequence[str] | None, float]] = [
            (PEEK, fresh, 1.0),
            (SEARCH, None, 1.0),
            (LOOK, None, 1.0),
        ]
        if idea.rule is None:
            turns.append((SEARCH, None, _CLOSE))
        for turn, (budget, only, aim) in enumerate(turns):
            if idea.rule and len(trial.compatible) > held:
                held = len(trial.compatible)
                mixed = _afforded(mixtures(space, trial, trial.parameters), int(_MIXED * left))
                left -= sum(len(several) for several in mixed.values())
                lent = Trial.of(begun(new, mixed, judge, pieces), trial.threshold)
                trial = trial.joined(lent.where(idea.uses)).standing(pieces)
            free = scalars if only is None else len(only)
            rows = _near(trial, aim, PROMISING if idea.rule else _FAR)[: left // min(budget.evaluations(free), _LEAST)]
            if rows and free:
                within = budget.within(left / len(rows), free)
                left -= len(rows) * within.evaluations(free)
                begin, seed = {row: trial.parameters[row] for row in rows}, judge.settings.seed + turn
                found = tried(new, begin, judge, within, seed, ENOUGH * aim, only, idea.flag)
                trial = trial.joined(found.where(idea.uses)).standing(pieces)
    return trial


def _near(trial: Trial, aim: float, far: float) -> list[int]:
    """References that are worth a search: those that are not compatible first, the nearest first."""
    rows = [row for row in trial.distances if aim < trial.distances[row] / trial.threshold <= far]
    return sorted(rows, key=lambda row: (row in trial.compatible, trial.distances[row]))


def _afforded(mixed: Mapping[int, list[Parameters]], most: int) -> dict[int, list[Parameters]]:
    """As many candidates of each as there may be in all."""
    each = max(1, most // max(len(mixed), 1))
    return {row: several[:each] for row, several in list(mixed.items())[:most]}


def _shown(crew: Workers, procedure: Procedure, found: Sequence[Tried], judge: Judge, limit: int) -> list[Tried]:
    """Those to show, with the Ranges that their references need, judged with these."""
    needed = [each for each in found if not any(_simpler(other, each) for other in found)]
    shown: list[Tried] = []
    for each in _ordered(needed):
        if len(shown) < limit and not any(_repeats(each, other) for other in shown):
            shown += _judged(crew, procedure, each, judge)
    return _ordered(shown)


def _ordered(found: Sequence[Tried]) -> list[Tried]:
    return sorted(found, key=lambda each: (-each.value, len(each.ranges)))


def _repeats(one: Tried, other: Tried) -> bool:
    return other.proposal.kind == one.proposal.kind and set(one.trial.compatible) <= set(other.trial.compatible)


def _simpler(one: Tried, other: Tried) -> bool:
    """Whether one makes fewer Ranges longer than the other, for as many references."""
    fewer = bool(one.proposal.ends) and set(one.proposal.ends) < set(other.proposal.ends)
    return fewer and len(one.trial.compatible) >= len(other.trial.compatible)


def _judged(crew: Workers, procedure: Procedure, found: Tried, judge: Judge) -> Iterator[Tried]:
    """The same with its final source, and what that really gives; nothing if that is nothing."""
    made = {row: found.trial.parameters[row] for row in found.trial.compatible}
    try:
        source = found.proposal.write(found.ranges)
        with changed(source, procedure, judge, crew) as new:
            trial = tried(new, made, judge, None, judge.settings.seed)
            lost = {row: made[row] for row in made if row not in trial.compatible}
            again = tried(new, lost, judge, SEARCH, judge.settings.seed, sure=found.proposal.flag)
            trial = trial.joined(again.where(found.proposal.uses))
    except (EditError, ProcedureError):
        return
    if trial.compatible:
        yield replace(found, source=source, trial=trial)
