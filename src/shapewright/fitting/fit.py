"""One turn of the loop: references, samples, prediction, search, replicas, judged and grouped."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from shapewright.building import Workers
from shapewright.fitting.facing import quarter_turns
from shapewright.fitting.learning import learn, learn_more
from shapewright.fitting.pictures import suited
from shapewright.fitting.replicas import replicate, resume
from shapewright.fitting.results import judged, recorded
from shapewright.fitting.start import Start, for_procedure
from shapewright.judging.judge import Judge
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Stages
from shapewright.references import Collection
from shapewright.runs.iteration import Iteration
from shapewright.settings import Settings


def fit(
    procedure: Procedure,
    references: Collection,
    settings: Settings | None = None,
    progress: Listener | None = None,
    cache: Path | None = None,
    previous: Iteration | None = None,
    known: Mapping[str, Sequence[Parameters]] | None = None,
) -> Iteration:
    """One iteration: find parameters for every reference, and say which the procedure cannot replicate yet.

    The same seed, settings and machine give the same iteration.

    Args:
        procedure: the author's.
        references: the shapes to replicate. Pictures are views of objects where the procedure builds meshes.
        settings: how the iteration runs; the defaults are made for laptops.
        progress: called with a Progress a few times a second; ``print`` will do. Within seconds one holds an answer.
        cache: a folder that keeps the references' descriptors between iterations.
        previous: an iteration with an earlier version of the procedure, to resume. Its parameters, network and cameras
            are carried over, which takes a third of the time.
        known: parameters that are worth a trial, by the name of their reference: those of a suggestion, for instance.

    Raises:
        ProcedureError: the procedure cannot build shapes.
        CollectionError: no picture can be read as one of an object.
    """
    settings, stages = settings or Settings(), Stages(progress)
    references = for_procedure(references, procedure)
    with Workers.of(procedure, settings) as crew:
        references = suited(references, crew)
        start = Start.of(references, procedure.space, previous, known)
        lesson = learn(crew, settings, stages, start)
        turns = quarter_turns(references, lesson.predictor, crew, settings, stages)
        stages.begin("describe", len(references))
        judge = Judge.of(references.turned(turns), settings, cache)
        replicas = resume(start, crew, judge)
        replicas = replicate(crew, judge, lesson, stages, replicas, start.new)
        for number in range(settings.rounds):
            lesson = learn_more(crew, settings, stages, lesson, replicas.parameters, number)
            replicas = replicate(crew, judge, lesson, stages, replicas)
    results, groups = judged(procedure, judge, replicas, stages)
    return recorded(procedure, judge, lesson, results, groups, turns, stages)
