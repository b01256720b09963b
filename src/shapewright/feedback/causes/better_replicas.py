"""Better replicas within the space, for many references at once: the nearest, and those whose surfaces cover most.

An iteration gives up early. What a longer search finds tells a bad prediction from a procedure that cannot do better.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from shapewright.building import Build, Workers
from shapewright.feedback.case import Case, Replica
from shapewright.feedback.surfaces.placement import Overlay
from shapewright.judging.judge import Judge
from shapewright.parameters import Parameters, ParameterSpace, Prediction, Scalar
from shapewright.prediction.lookup import nearest
from shapewright.prediction.predictor import Predictor
from shapewright.rendering.raster import render
from shapewright.search.budgets import Budget
from shapewright.search.moves import Probe, Scan, Step
from shapewright.search.objective import Criterion, measure_of
from shapewright.search.search import SearchStart, refine
from shapewright.shapes import Mesh, Shape

_RIVAL = 1.25  # of the best combination's cost
NEAREST = Budget((Scan(8), Probe(2, rival=_RIVAL), *(Step(1, scatter=5),) * 12), patience=1, spread=0.15)
AGAIN = Budget((Scan(12), Probe(3, rival=_RIVAL), *(Step(2, scatter=6),) * 12), patience=3, spread=0.3)
"""From where the first has come to, more widely."""
COVERING = Budget(
    (Scan(6), Probe(2, rival=_RIVAL), Step(2, scatter=4, rival=_RIVAL), *(Step(1, scatter=5),) * 10),
    patience=2,
    spread=0.2,
)
"""Budgets and shares were chosen on seed 0 of ``benchmarks/causes.py``."""
RANDOM = 256
"""Random shapes among which the most similar to a reference is looked up."""
EVALUATIONS = 3_600
"""Shapes built for all references together, about: with 6,000 the causes were no better (docs/benchmarks.md)."""
ENOUGH = 0.9
"""Of the goal. In the pose that both share, distances are upper bounds of what is judged."""
_UNSURE = 0.3  # probability of another class than the known one, where no predictor is known
_NEAREST_SHARE, _COVERING_SHARE = 0.45, 0.55  # of EVALUATIONS
AGAIN_SHARE = 0.3
"""The same of a second search, for those that the first has brought much nearer."""


def measured(asked: Sequence[tuple[int, Parameters]], crew: Workers, judge: Judge) -> list[Replica | None]:
    """Build and measure parameters, each for the reference of a row; None where no shape can be built or measured."""
    builds = crew.build([parameters for _, parameters in asked])
    rows = [row for row, _ in asked]
    standings = judge.standings(builds, rows)
    return [Replica.of(row, build, standing) for row, build, standing in zip(rows, builds, standings, strict=True)]


def with_fields(replicas: Sequence[Replica], judge: Judge) -> list[Replica]:
    """The same, with their light fields."""
    builds = [Build(replica.parameters, replica.shape) for replica in replicas]
    fields = judge.nearest(builds, [replica.row for replica in replicas])[1]
    return [replace(replica, field=int(field)) for replica, field in zip(replicas, fields, strict=True)]


def nearest_replicas(
    known: Sequence[Replica], prediction: Prediction, crew: Workers, judge: Judge, budget: Budget | None = None
) -> list[Replica]:
    """The nearest replicas that a search within the space finds, or those that are known.

    prediction: for the same references. budget: by default what their number affords.
    """
    vectors = refine(
        SearchStart(prediction, [replica.parameters for replica in known]),
        as_near_as(ENOUGH, known, judge),
        crew,
        budget or affordable(NEAREST, _NEAREST_SHARE, len(known), crew),
        judge.settings.seed,
    )
    return nearer(known, vectors, crew, judge)


def covering_replicas(
    known: Sequence[Replica], overlays: Sequence[Overlay], prediction: Prediction, crew: Workers, judge: Judge
) -> list[Replica]:
    """The replicas within the space whose surfaces have most in common with the references'.

    overlays, prediction: for the same references. A replica may be further away by the light field than what is known.
    A search starts from the most similar of some random shapes where that has more in common with the reference.
    """
    vectors = refine(
        SearchStart(prediction, _starts(known, overlays, crew, judge)),
        Criterion(measure_of(overlays, judge.settings.workers)),
        crew,
        affordable(COVERING, _COVERING_SHARE, len(known), crew),
        judge.settings.seed,
    )
    rows = [replica.row for replica in known]
    fresh = measured(list(zip(rows, vectors, strict=True)), crew, judge)
    return [new or old for new, old in zip(fresh, known, strict=True)]


def with_choices_kept(cases: Sequence[Case], crew: Workers, judge: Judge) -> list[Replica]:
    """The nearest replicas, with the choices of the iteration's where these do as well with the new numbers."""
    space = crew.procedure.space
    choices = [parameter.name for parameter in space if not isinstance(parameter, Scalar)]
    best, asked = [case.nearest for case in cases], {}
    for i, case in enumerate(cases):
        old, new = case.replica, case.nearest
        kept = space.canonical({**new.parameters, **{name: old.parameters[name] for name in choices}})
        if new.apart <= 1.0 and kept != new.parameters:
            asked[i] = (case.row, kept)
    for i, replica in zip(asked, measured(list(asked.values()), crew, judge), strict=True):
        if replica and replica.apart <= 1.0:
            best[i] = replica
    return best


def nearer(known: Sequence[Replica], vectors: Sequence[Parameters], crew: Workers, judge: Judge) -> list[Replica]:
    """The nearer of what is known and what these parameters give, for each reference."""
    best = list(known)
    moved = [i for i, (old, vector) in enumerate(zip(known, vectors, strict=True)) if vector != old.parameters]
    fresh = measured([(known[i].row, vectors[i]) for i in moved], crew, judge)
    for i, replica in zip(moved, fresh, strict=True):
        if replica and replica.apart < best[i].apart:
            best[i] = replica
    return best


def as_near_as(share: float, known: Sequence[Replica], judge: Judge) -> Criterion:
    """The cost in the light fields of known replicas, down to a share of the judge's goal."""
    measure = judge.measure([replica.row for replica in known], [replica.field for replica in known])
    return Criterion(measure, enough=share * judge.goal)


def affordable(budget: Budget, share: float, references: int, crew: Workers) -> Budget:
    """What each reference's part of a share of all evaluations pays for."""
    return budget.within(share * EVALUATIONS / max(references, 1), int(crew.procedure.space.scalars.sum()))


def prediction_of(
    space: ParameterSpace,
    predictor: Predictor | None,
    known: Sequence[Replica],
    shapes: Sequence[Shape],
    extents: Sequence[float | None],
) -> Prediction:
    """What the predictor says of references, or what is known of them, not quite sure of its choices, without one.

    extents: of the references, the longest sides that replicas are to have, where sizes count.
    """
    if predictor and knows(predictor, space):
        # A predictor that was saved has lost each ``when`` of its space.
        return replace(predictor.infer(shapes, extents), space=space)
    return Prediction.of(space, [replica.parameters for replica in known], doubt=_UNSURE)


def knows(predictor: Predictor, space: ParameterSpace) -> bool:
    """Whether a predictor was trained for parameters of these names and classes."""
    return [(p.name, p.classes) for p in predictor.space] == [(p.name, p.classes) for p in space]


def _starts(known: Sequence[Replica], overlays: Sequence[Overlay], crew: Workers, judge: Judge) -> list[Parameters]:
    """What is known, or the most similar of some random shapes where more of the surfaces lies together."""
    builds = crew.build(crew.procedure.space.sample(RANDOM, judge.settings.seed + 1))
    drawn = [(build.parameters, build.shape) for build in builds if isinstance(build.shape, Mesh)]
    if not drawn:
        return [replica.parameters for replica in known]
    shapes = [judge.references.references[replica.row].shape for replica in known]
    pictures = [
        render([mesh.normalised() for mesh in meshes], threads=judge.settings.workers)
        for meshes in ([shape for shape in shapes if isinstance(shape, Mesh)], [mesh for _, mesh in drawn])
    ]
    alike = [drawn[i] for i in nearest(*pictures)]
    return [
        parameters if overlay(mesh) < overlay(replica.mesh) else replica.parameters
        for replica, overlay, (parameters, mesh) in zip(known, overlays, alike, strict=True)
    ]
