"""Why references are not replicated: better replicas are searched for, and what stays different tells the cause."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from operator import attrgetter

from shapewright.building import Workers
from shapewright.feedback.case import Case, Replica, updated
from shapewright.feedback.causes.better_replicas import (
    AGAIN,
    AGAIN_SHARE,
    affordable,
    covering_replicas,
    knows,
    nearest_replicas,
    prediction_of,
    with_choices_kept,
    with_fields,
)
from shapewright.feedback.causes.diagnosis import diagnosed, or_leaning
from shapewright.feedback.causes.leaning import leaning
from shapewright.feedback.causes.longer_ranges import replicas_outside
from shapewright.feedback.causes.outliers import isolation, outliers
from shapewright.feedback.causes.poses import standings
from shapewright.feedback.causes.told import remark
from shapewright.feedback.remarks.proportions import Proportion, Reach
from shapewright.feedback.surfaces.placement import Overlay
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.judging.judge import Judge
from shapewright.judging.mesh_target import MeshTarget
from shapewright.parameters import ParameterSpace
from shapewright.prediction.predictor import Predictor
from shapewright.progress import Stages
from shapewright.threads import in_threads

_GAINED = 0.2
"""How much nearer, in ``Replica.apart``, of benchmarks/causes.py a third of misfits come whose numbers are spoilt, and
next to none of others (seed 0)."""


def causes(
    cases: Sequence[Case], predictor: Predictor | None, crew: Workers, judge: Judge, stages: Stages
) -> list[Case]:
    """The same cases; those that are not replicated know better replicas and their causes, the others what differs."""
    space, settings = crew.procedure.space, judge.settings
    good = [case for case in cases if case.replicated]
    remarks = in_threads(remark, good, settings.workers)
    cases = updated(cases, [replace(case, remark=said) for case, said in zip(good, remarks, strict=True)])
    misfits = [case for case in cases if not case.replicated]
    if not misfits:
        return cases
    misfits = _searched(misfits, predictor, crew, judge, stages)
    misfits = _compared(misfits, judge)
    misfits = in_threads(lambda case: replace(case, causes=diagnosed(space, case)), misfits, settings.workers)
    lacking = [case for case in misfits if case.causes[0].kind == "missing part"]
    standing = [(case.covering.parameters, case.overlay) for case in lacking]
    leans = leaning(crew, standing, settings.workers, [case.replica.mesh for case in lacking])
    leaning_ones = [or_leaning(case, lean) for case, lean in zip(lacking, leans, strict=True)]
    misfits = updated(misfits, leaning_ones)
    extents = [judge.references.extents[case.row] for case in misfits]
    knowing = predictor if predictor and knows(predictor, space) else None
    stood = standings(misfits, knowing, crew, settings.workers, extents)
    pairs = zip(misfits, stood, strict=True)
    posed = [replace(case, causes=(its.cause(case.reference), *case.causes)) for case, its in pairs if its.told]
    return updated(cases, updated(misfits, posed))


def _searched(
    misfits: list[Case], predictor: Predictor | None, crew: Workers, judge: Judge, stages: Stages
) -> list[Case]:
    """The misfits with the nearest replica within the space and outside, and the one that covers most."""
    space, threads = crew.procedure.space, judge.settings.workers
    known = with_fields([case.replica for case in misfits], judge)
    overlays = in_threads(lambda case: Overlay(case.residuals.reference, case.replica.mesh), misfits, threads)
    extents = [judge.references.extents[case.row] for case in misfits]
    prediction = prediction_of(space, predictor, known, [case.reference for case in misfits], extents)
    covering = covering_replicas(known, overlays, prediction, crew, judge)
    misfits = [
        replace(case, replica=old, overlay=overlay, covering=new, nearest=min(old, new, key=attrgetter("apart")))
        for case, old, overlay, new in zip(misfits, known, overlays, covering, strict=True)
    ]
    stages.step(1, 4)
    unsolved = [i for i, case in enumerate(misfits) if case.nearest.apart > 1.0]
    some = [misfits[i] for i in unsolved]
    nearest = nearest_replicas([case.nearest for case in some], prediction.take(unsolved), crew, judge)
    misfits = updated(misfits, [replace(case, nearest=new) for case, new in zip(some, nearest, strict=True)])
    going = [i for i, case in enumerate(misfits) if _goes_on(case)]
    some = [misfits[i] for i in going]
    longer = affordable(AGAIN, AGAIN_SHARE, len(some), crew)
    nearest = nearest_replicas([case.nearest for case in some], prediction.take(going), crew, judge, longer)
    misfits = updated(misfits, [replace(case, nearest=new) for case, new in zip(some, nearest, strict=True)])
    nearest = with_choices_kept(misfits, crew, judge)
    misfits = [replace(case, nearest=new, outside=new) for case, new in zip(misfits, nearest, strict=True)]
    stages.step(2, 4)
    some = [case for case in misfits if case.nearest.apart > 1.0]
    reach = Reach.of(crew, judge.settings.seed) if some else None
    beyond = [reach.beyond(case.reference, case.replica.mesh) if reach else None for case in some]
    outside = replicas_outside([case.nearest for case in some], crew, judge, beyond)
    found = zip(some, outside, beyond, strict=True)
    misfits = updated(misfits, [_outside(space, *one) for one in found])
    stages.step(3, 4)
    return misfits


def _goes_on(case: Case) -> bool:
    """Whether a search has come so much nearer that it is likely to come nearer still: the prediction was bad."""
    return case.nearest.apart > 1.0 and case.replica.apart - case.nearest.apart > _GAINED


def _outside(space: ParameterSpace, case: Case, outside: Replica, proportion: Proportion | None) -> Case:
    """The case with what longer Ranges bring; a replica within them that this search finds may be the nearest."""
    within = outside.apart < case.nearest.apart and not space.outside(outside.parameters)
    return replace(case, outside=outside, nearest=outside if within else case.nearest, proportion=proportion)


def _compared(misfits: Sequence[Case], judge: Judge) -> list[Case]:
    """The misfits with what differs from the covering replica, and how far they are from all other references."""
    settings = judge.settings
    described = [target.descriptor for target in judge.targets if isinstance(target, MeshTarget)]
    alone = isolation(described, settings.align, settings.workers, settings.seed)
    unlike = outliers(alone)
    fresh = in_threads(lambda case: residuals(case.residuals.reference, case.covering.mesh), misfits, settings.workers)
    return [
        replace(case, covering_residuals=where, isolation=float(alone[case.row]) if unlike[case.row] else None)
        for case, where in zip(misfits, fresh, strict=True)
    ]
