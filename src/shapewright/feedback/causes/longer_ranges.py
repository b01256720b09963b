"""Replicas beyond the Ranges that end too soon."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from shapewright.building import Workers
from shapewright.feedback.case import Replica
from shapewright.feedback.causes.better_replicas import ENOUGH, affordable, as_near_as, measured, nearer
from shapewright.feedback.remarks.proportions import Proportion
from shapewright.judging.judge import Judge
from shapewright.parameters import End, Integer, Parameters, ParameterSpace, Prediction
from shapewright.search.budgets import Budget
from shapewright.search.candidates import others
from shapewright.search.moves import Probe, Scan, Step
from shapewright.search.search import SearchStart, refine

OUTSIDE = Budget(
    (Scan(1), Probe(1), *(Step(1, scatter=5),) * 3, Probe(1, again=True), *(Step(1, scatter=5),) * 5),
    patience=3,
    spread=0.06,  # in a space that is a few times as wide
)
# Where nothing else is said, chosen on seed 0 of benchmarks/causes.py.
_SHARE = 0.4  # of the evaluations for all references
_TURNS = 2  # a longer Range may bring parameters to the ends of others
_CLOSE = 0.4  # of the threshold: beyond a Range the surfaces have to come together as well
_NEXT, _OTHER = 0.1, 1e-6  # likelihoods of the next integer and of any other class, where the known one's is 1
_CHOICES = 6  # other choices that a wished proportion is tried with
_LEVEL = 0.1  # part of what longer Ranges bring that is not worth one of them


def replicas_outside(
    known: Sequence[Replica],
    crew: Workers,
    judge: Judge,
    proportions: Sequence[Proportion | None] | None = None,
) -> list[Replica]:
    """The nearest replicas when the Ranges are longer at the ends that the known parameters rest on.

    A parameter lies outside its Range only where that pays. proportions: of each reference the one that no parameters
    give; a search then begins where its limit would have to be.
    """
    space = crew.procedure.space
    best, ends = list(known), [space.pressed(replica.parameters) for replica in known]
    for i, replica in _begun(known, proportions or [], crew, judge).items():
        best[i] = replica
        ends[i] |= {(excess.parameter, excess.side) for excess in space.outside(replica.parameters)}
    todo = [i for i, free in enumerate(ends) if free]
    for _ in range(_TURNS):
        if not todo:
            break
        wider = _searched([best[i] for i in todo], [ends[i] for i in todo], crew, judge)
        again = []
        for i, replica in zip(todo, wider, strict=True):
            best[i] = replica
            free = ends[i] | space.pressed(replica.parameters)
            if free != ends[i] and replica.apart > 1.0:
                again.append(i)
            ends[i] = free
        todo = again
    return _pulled_back(known, best, crew, judge)


def _searched(known: Sequence[Replica], ends: Sequence[set[End]], crew: Workers, judge: Judge) -> list[Replica]:
    space = crew.procedure.space
    wide = space.widened()
    vectors = refine(
        SearchStart(
            _prediction(wide, known, ends), [replica.parameters for replica in known], within=space.limits(wide, ends)
        ),
        as_near_as(ENOUGH * _CLOSE, known, judge),
        crew,
        affordable(_with_integers(OUTSIDE, space, ends), _SHARE, len(known), crew),
        judge.settings.seed,
    )
    return nearer(known, vectors, crew, judge)


def _begun(
    known: Sequence[Replica], proportions: Sequence[Proportion | None], crew: Workers, judge: Judge
) -> dict[int, Replica]:
    """Nearer replicas with the limit of a proportion where it would have to be, by their place among those known.

    Tried with the known parameters, and with one choice changed.
    """
    space, wide = crew.procedure.space, crew.procedure.space.widened()
    asked: list[tuple[int, Parameters]] = []
    for i, proportion in enumerate(proportions):
        if proportion and proportion.limit and (wish := proportion.wish()) is not None:
            name, centre = proportion.limit.parameter, space.encode(known[i].parameters)
            several = [known[i].parameters, *(space.decode(other) for other in others(space, centre)[:_CHOICES])]
            wished = (wide.clipped({**values, name: wish}, [name]) for values in several)
            asked += [(i, values) for values in wished if name in space.active(values)]
    best: dict[int, Replica] = {}
    found = measured([(known[i].row, values) for i, values in asked], crew, judge)
    for (i, _), replica in zip(asked, found, strict=True):
        if replica and replica.apart < best.get(i, known[i]).apart:
            best[i] = replica
    return best


def _pulled_back(known: Sequence[Replica], best: Sequence[Replica], crew: Workers, judge: Judge) -> list[Replica]:
    """The same, with every parameter inside its Range again whose longer Range brings next to nothing."""
    space, best = crew.procedure.space, list(best)

    def as_good(apart: float, wide: float, before: float) -> bool:
        return apart <= 1.0 or (wide > 1.0 and apart - wide <= _LEVEL * (before - wide))

    for name in [name for name in space.names if any(_outside(space, replica, name) for replica in best)]:
        some = [i for i, replica in enumerate(best) if _outside(space, replica, name)]
        asked = [(best[i].row, space.clipped(best[i].parameters, [name])) for i in some]
        for i, replica in zip(some, measured(asked, crew, judge), strict=True):
            if replica and as_good(replica.apart, best[i].apart, known[i].apart):
                best[i] = replica
    return best


def _outside(space: ParameterSpace, replica: Replica, name: str) -> bool:
    return any(excess.parameter == name for excess in space.outside(replica.parameters))


def _with_integers(budget: Budget, space: ParameterSpace, ends: Sequence[set[End]]) -> Budget:
    """The same, with a combination more for each whole number that may leave its Range."""
    more = max(sum(isinstance(space[name], Integer) for name, _ in free) for free in ends)
    return replace(budget, moves=(Scan(budget.combinations + more), *budget.moves[1:]))


def _prediction(wide: ParameterSpace, known: Sequence[Replica], ends: Sequence[set[End]]) -> Prediction:
    """What is known; an integer that rests on an end of its Range may leave it by one."""
    prediction = Prediction.of(wide, [replica.parameters for replica in known], least=_OTHER)
    for parameter, column in zip(wide, prediction.columns, strict=True):
        for row, free in enumerate(ends if isinstance(parameter, Integer) else ()):
            value = int(column[row].argmax())
            for side, neighbour in (("low", value - 1), ("high", value + 1)):
                if (parameter.name, side) in free and 0 <= neighbour < parameter.classes:
                    column[row, neighbour] = _NEXT
    return prediction
