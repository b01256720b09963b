"""One turn of the loop: references, samples, prediction, search, replicas, judged and grouped."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

from shapewright.building import Executor, Workers
from shapewright.fitting.chunks.facts import deciding, looks
from shapewright.fitting.chunks.forms import KeptSamples
from shapewright.fitting.chunks.judges import CHUNK, Judges
from shapewright.fitting.chunks.passes import Passes
from shapewright.fitting.facing import quarter_turns
from shapewright.fitting.keeping.unfinished import Unfinished
from shapewright.fitting.learning import learn, learn_more
from shapewright.fitting.pacing.opening import Opening
from shapewright.fitting.pacing.pace import paced
from shapewright.fitting.pacing.stock import Stock
from shapewright.fitting.pictures import suited
from shapewright.fitting.results import followed, judged, recorded, telling
from shapewright.fitting.standing import stand
from shapewright.fitting.start import Start, for_procedure
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure
from shapewright.progress import Listener, Notice, Stages
from shapewright.references import Collection
from shapewright.runs.iteration import Iteration
from shapewright.settings import Settings
from shapewright.survey.preparation import following, leading, prepared


def fit(
    procedure: Procedure,
    references: Collection,
    settings: Settings | None = None,
    progress: Listener | None = None,
    cache: Path | None = None,
    previous: Iteration | None = None,
    known: Mapping[str, Sequence[Parameters]] | None = None,
    opening: Opening | None = None,
    executor: Executor | None = None,
    unfinished: Unfinished | None = None,
    chunk: int = CHUNK,
) -> Iteration:
    """One iteration: find parameters for every reference, and say which the procedure cannot replicate yet.

    The same seed, settings and machine give the same iteration.

    Args:
        procedure: the author's.
        references: the shapes to replicate; ``settings`` say what of them is left out, and which follow others.
            Pictures are views of objects where the procedure builds meshes. Where up is "auto", the procedure's shapes
            decide how meshes stand.
        settings: how the iteration runs; the defaults are made for laptops.
        progress: called with a Progress a few times a second; ``print`` will do. Within seconds one holds an answer.
        cache: a folder that keeps the references' descriptors between iterations, and samples that took long to build.
        previous: an iteration with an earlier version of the procedure, to resume. Its parameters, network and cameras
            are carried over, which takes a third of the time.
        known: parameters that are worth a trial, by the name of their reference: those of a suggestion, for instance.
        opening: the procedure's first samples with these settings, where they are being built already; its workers
            build all else as well.
        executor: builds, draws, describes, searches and judges on other machines, see ``sample``; training stays here.
        unfinished: keeps what is done, so that the same call goes on after it was stopped. Its owner removes it when
            the run is written.
        chunk: references that are searched for at the same time; fewer take less memory, and change no result.

    Raises:
        ProcedureError: the procedure cannot build shapes.
        CollectionError: no picture can be read as one of an object; a reference to leave out is none, or nothing is
            left.
        ExecutorError: an executor lost the same work twice.
        ValueError: there are both an opening, which has an executor of its own, and an executor.
    """
    if opening and executor:
        raise ValueError("the workers of an opening have an executor already, or build here: give it to the opening")
    settings, unfinished = settings or Settings(), unfinished or Unfinished()
    references = references if references.taught else stand(procedure, references, settings, progress, previous)
    references = for_procedure(references, procedure)
    with nullcontext(opening.crew) if opening else Workers.of(procedure, settings, executor) as crew:
        first = opening.builds() if opening else []
        references = prepared(suited(references, crew), settings, settings.workers)
        like = following(references, settings, settings.workers)
        stages, fitted = Stages(progress and telling(progress, like)), leading(references, like)
        start = Start.of(fitted, procedure.space, previous, known)
        if unfinished.begin(deciding(procedure, fitted, settings, previous, known)):
            stages.tell(Notice("going on", "this goes on with a fit that was stopped"), recorded=False)
        stock = Stock(crew, cache, first, KeptSamples(unfinished))
        stages.notices += opening.notices if opening else []
        settings = _paced(stock, settings, stages, start, unfinished)
        lesson = learn(crew, settings, stages, start, stock, unfinished)
        stock.keep()
        turns = quarter_turns(fitted, lesson.predictor, crew, settings, stages)
        stages.begin("describe", len(fitted))
        judges = Judges(fitted.turned(turns), settings, cache, chunk, crew)
        passes = Passes(crew, judges, unfinished, stages)
        found = passes.searched(lesson, passes.known(start), 0, not settings.rounds, start.new)
        for number in range(1, settings.rounds + 1):
            centres = [values for each in found for values in each.replicas().parameters]
            lesson = learn_more(crew, settings, stages, lesson, centres, number - 1, unfinished)
            found = passes.searched(lesson, found, number, number == settings.rounds)
    results, groups = judged(procedure, judges, found, stages)
    turned = dict(zip(fitted.names, turns, strict=True)) | {
        each.name: turns[fitted.names.index(each.of)] for each in like
    }
    results, groups = followed(references, like, results, groups, turned)
    return recorded(procedure, judges, lesson, references, results, groups, turned, stages, unfinished, crew.opened)


def _paced(stock: Stock, settings: Settings, stages: Stages, start: Start, unfinished: Unfinished) -> Settings:
    """The settings as ``paced`` divides them; or has divided them, where an earlier try is gone on with."""
    divided = unfinished.fact("divided")
    chosen = paced(stock, replace(settings, within=None, **divided) if divided else settings, stages, start)
    if unfinished.once("looks", looks(stock.probes)) != looks(stock.probes):
        unfinished.forget()  # the procedure builds other shapes than it did, for instance by what it reads
        stock.build_anew()
    if settings.within is not None:
        unfinished.once("divided", {"samples": chosen.samples, "refine_shapes": chosen.refine_shapes})
    return chosen
