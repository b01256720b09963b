"""The program of a fit, beside the server: it reports progress, early answers and the finished run."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shapewright.studio.jobs import events
from shapewright.studio.project.listing import Origin, listing
from shapewright.studio.wire.work import JobResult

if TYPE_CHECKING:
    from shapewright.references import Collection

PREDICTIONS = "predictions.json"
"""In a run's folder: what the network said of every reference before the search, and how sure it was."""
_OPENS = 3
"""Steps of the opening: what learns, the procedure, the references."""


def collection(origin: Origin, suit: Callable[[Collection], Collection] = lambda whole: whole) -> Collection:
    """The references of a project, but for those that lead out of it. suit: what they are to a procedure, see
    ``fitting.pictures``. Raises CollectionError."""
    from shapewright.references import Collection

    listed = listing(origin)
    whole = suit(Collection.load(origin.source, up=origin.up, front=origin.front, keep=origin.keep))
    outside = {path.absolute() for path in listed.skipped}
    inside = tuple(r for r in whole.references if r.path is None or r.path.absolute() not in outside)
    return replace(whole, references=inside, skipped={**whole.skipped, **listed.skipped})


def fit(request: Mapping[str, Any], reporter: events.Reporter) -> JobResult:
    """Fit as the request says and save the run."""
    reporter.opens(0, _OPENS, "loads what learns")
    from shapewright.fitting.fit import fit as iterate
    from shapewright.fitting.keeping.unfinished import UNFINISHED, Unfinished
    from shapewright.fitting.pictures import suited_to
    from shapewright.procedures import load_procedure
    from shapewright.report import write_report
    from shapewright.runs.folder import next_run, previous_run, suggested_parameters
    from shapewright.runs.iteration import Iteration
    from shapewright.settings import Settings
    from shapewright.storage import cache_folder, write_file

    reporter.opens(1, _OPENS, "reads the procedure")
    procedure, settings = load_procedure(request["procedure"]), Settings.from_record(request["settings"])
    reporter.opens(2, _OPENS, "reads the references")
    references = collection(Origin(**request["origin"]), lambda whole: suited_to(procedure, whole, settings))
    reporter.opens(3, _OPENS, "begins")
    previous, known = None, None
    if request["previous"]:
        previous = Iteration.load(request["previous"])
        known = suggested_parameters(Path(request["previous"]), procedure.space.names)
    unfinished = Unfinished(Path(request["runs"]) / UNFINISHED)
    told = reporter.progress
    iteration = iterate(procedure, references, settings, told, cache_folder(), previous, known, unfinished=unfinished)
    reporter.stage("save", 0, 1)
    folder = next_run(Path(request["runs"])).absolute()
    before = previous_run(folder, set(iteration.names))
    iteration.save(folder, lambda partial: write_report(partial, before))
    predictions = json.dumps(predicted(iteration), allow_nan=False)
    write_file(folder / PREDICTIONS, predictions)
    unfinished.remove()
    return JobResult(run=folder.name)


def predicted(iteration: Any) -> dict[str, Any]:
    """By name: the predicted parameters, the spread of each scalar in its own units, the likelihood of each class."""
    from shapewright.shapes import extent_of

    predictor = iteration.predictor
    results = [result for result in iteration.results if result.reference is not None]
    if predictor is None or not results:
        return {}
    sides = [None if result.replica is None else extent_of(result.replica) for result in results]
    prediction = predictor.infer([result.reference for result in results], sides)
    values = prediction.decode()
    by_name: dict[str, Any] = {}
    for i, result in enumerate(results):
        spread, likelihood = {}, {}
        for j, parameter in enumerate(predictor.space):
            if parameter.classes:
                shares = prediction.columns[j][i]
                levels = parameter.levels
                likelihood[parameter.name] = {_key(v): round(float(p), 4) for v, p in zip(levels, shares, strict=True)}
            else:
                spread[parameter.name] = float(prediction.spreads[j][i]) * (parameter.high - parameter.low)
        by_name[result.name] = {"predicted": values[i], "spread": spread, "likelihood": likelihood}
    return by_name


def _key(value: Any) -> str:
    return value if isinstance(value, str) else json.dumps(value)


if __name__ == "__main__":
    events.run("fit", fit)
