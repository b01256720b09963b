"""An explanation in a run's folder: ``explanation.json``, pictures of suggestions, and the report written anew."""

from __future__ import annotations

import base64
import json
import math
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.feedback.case import Case, Cause, DrawnCase
from shapewright.feedback.causes.shared import SharedCause
from shapewright.feedback.causes.told import shown_regions
from shapewright.feedback.explanation import Explanation
from shapewright.feedback.suggestions import Suggestion
from shapewright.feedback.surfaces.residuals import Region
from shapewright.feedback.trials.tried import Tried
from shapewright.report import write_report
from shapewright.report.explained import PICTURES
from shapewright.runs.difference import changed
from shapewright.runs.folder import EXPLANATION, RunError
from shapewright.storage import scratch_folder


def record_of(explanation: Explanation) -> dict[str, Any]:
    """An explanation as plain values for ``explanation.json``; pictures in base64."""
    return {
        "format": 1,
        "references": {name: _case(case) for name, case in explanation.references.items()},
        "summary": [_shared(cause) for cause in explanation.summary],
        "suggestions": [_suggestion(suggestion, explanation.source) for suggestion in explanation.suggestions],
        "unsuggested": explanation.unsuggested,
        **({"sample": sample_record(*explanation.sample)} if explanation.sample else {}),
        "tried": [_tried(tried) for tried in explanation.tried],
        "seconds": {stage: round(seconds, 2) for stage, seconds in explanation.seconds.items()},
    }


def sample_record(explained: int, references: int) -> dict[str, Any]:
    """That some references stand for all."""
    words = (
        f"Explained on a sample: {explained:,} of {references:,} references, some of each group. Counts are of these."
    )
    return {"explained": explained, "of": references, "text": words}


def write_into(folder: Path, record: Mapping[str, Any]) -> dict[str, Any]:
    """Write an explanation's record into a folder that is still being made; return it as it was written.

    Pictures of suggestions are given in base64 and become files, whose paths in the folder replace them.
    """
    written = {**record, "suggestions": [dict(suggestion) for suggestion in record["suggestions"]]}
    for number, suggestion in enumerate(written["suggestions"], start=1):
        picture = suggestion.get("picture")
        if picture:
            (folder / PICTURES).mkdir(exist_ok=True)
            path = f"{PICTURES}/{number}.png"
            (folder / path).write_bytes(base64.b64decode(picture))
            suggestion["picture"] = path
    (folder / EXPLANATION).write_text(json.dumps(written, indent=1, allow_nan=False), encoding="utf-8")
    return written


def write(run: Path, record: Mapping[str, Any], previous: Path | None = None) -> dict[str, Any]:
    """Put an explanation into the folder of a finished run, in the place of an earlier one, and renew its report.

    Everything is written beside its place first and moved there at the end. previous: the run that the report compares
    with. Returns the record as it was written. Raises RunError when the folder cannot be written; then all stays as it
    was.
    """
    try:
        with scratch_folder(run / EXPLANATION) as partial:
            written = write_into(partial, record)
            write_report(run, previous, partial)
            shutil.rmtree(run / PICTURES, ignore_errors=True)
            for path in partial.iterdir():
                path.replace(run / path.name)
    except OSError as error:
        raise RunError(f"{run}: the explanation cannot be written: {error.strerror or error}") from error
    return written


def _case(case: Case | DrawnCase) -> dict[str, Any]:
    """Its regions are what of the reference no parameters account for, and what of the iteration's replica is too much.

    The weightiest come first. The placement takes the replica's own normalised units to the reference's; drawings are
    compared in place.
    """
    placement = {"centre": [0.0, 0.0, 0.0], "scale": 1.0}
    if isinstance(case, Case):
        own, placed = case.replica.mesh.normalisation(), case.residuals.placement
        centre = (np.array(placed.centre) - own.centre) * own.scale
        placement = {"centre": _rounded(centre), "scale": round(placed.scale / own.scale, 5)}
    return {
        "causes": [_cause(cause) for cause in case.causes],
        "remark": _cause(case.remark) if isinstance(case, Case) and case.remark else None,
        "regions": [_region(region) for region in _regions(case)],
        "placement": placement,
        "dimensions": case.residuals.dimensions,
    }


def _regions(case: Case | DrawnCase) -> Sequence[Region]:
    if isinstance(case, Case):
        return shown_regions(case)
    both = [*case.covering_residuals.of("unexplained"), *case.residuals.of("surplus")]
    return sorted(both, key=lambda region: -region.weight)


def _cause(cause: Cause) -> dict[str, Any]:
    """Its picture in base64, where it has one."""
    picture = {"picture": base64.b64encode(cause.picture).decode("ascii")} if cause.picture else {}
    return {"kind": cause.kind, "text": cause.text, "evidence": dict(cause.evidence), **picture}


def _region(region: Region) -> dict[str, Any]:
    return {
        "side": region.side,
        "centre": _rounded(region.box.centre),
        "size": _rounded(region.box.size),
        "axes": [_rounded(axis) for axis in region.box.axes],
        "share": round(region.share, 4),
        "distance": round(region.distance, 4),
        "label": region.label,
        "rule": region.rule,
    }


def _shared(cause: SharedCause) -> dict[str, Any]:
    record = {**vars(cause), "references": list(cause.references)}
    outside = record.pop("outside")
    return record | vars(outside) if outside else record


def _suggestion(suggestion: Suggestion, source: str) -> dict[str, Any]:
    """source: of the procedure without the change."""
    picture = base64.b64encode(suggestion.picture).decode("ascii")
    own = {"picture": picture, "references": list(suggestion.references), "tried": dict(suggestion.tried)}
    diff = [vars(line) for line in changed(source, suggestion.source)] if source and suggestion.source else []
    change = suggestion.change.record if suggestion.change else None
    return {**vars(suggestion), **own, "gain": suggestion.gain, "diff": diff, "change": change}


def _tried(tried: Tried) -> dict[str, Any]:
    best = round(tried.best, 3) if math.isfinite(tried.best) else None
    return {**vars(tried), "best": best, "seconds": round(tried.seconds, 2)}


def _rounded(values: Any) -> list[float]:
    return [round(float(value), 4) for value in values]
