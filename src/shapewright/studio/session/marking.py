"""What the author's marks say: which cut they ask for, and which pairs to mark next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.judging.calibration import fit_cut, fit_threshold
from shapewright.judging.paper import Metric
from shapewright.runs.folder import RunError, next_run, read_record
from shapewright.runs.marks import pairs, read_marks, worth_marking
from shapewright.runs.result import Result, from_record
from shapewright.settings import JudgeName, Settings
from shapewright.studio.wire.judgement import Learned, Mark, Marking
from shapewright.studio.wire.values import Slug


@dataclass(frozen=True)
class Shown:
    """A run that is shown, and what it is judged by; see ``runs.marks.Judged``."""

    results: Sequence[Result]
    metric: Metric
    settings: Settings


def marking(project: Path, run: Path | None, slugs: Mapping[str, Slug], settings: Settings, shown: Settings) -> Marking:
    """All that a page shows of a project's marks; empty where they cannot be read.

    run: that is shown.
    slugs: of the references that are there, by name.
    settings: of the next fit.
    shown: what the run that is shown is judged by.
    """
    try:
        judged = pairs(project)
        found = learned(project, run, settings.judge)
    except RunError:
        return Marking(marks=[], learned=None, asked=[])
    own = {a for a, b, _ in judged if a == b}
    # Marks of a run that another judge judged would not move the cut.
    open_ones = asked(run, shown, own) if run and shown.judge == settings.judge else ()
    return Marking(
        marks=[Mark(a=slugs[a], b=slugs[b], same=same) for a, b, same in judged if a in slugs and b in slugs],
        learned=found,
        asked=[slugs[name] for name in open_ones if name in slugs],
    )


def learned(project: Path, run: Path | None, judge: JudgeName) -> Learned | None:
    """The cut that a project's marks ask for, as ``fit --marks`` takes it; None while none counts.

    run: it says what was measured where a mark does not. Raises RunError for marks that cannot be read.
    """
    name = "fidelity" if judge == "fidelity" else "distance"
    marks = [mark for mark in read_marks(run or next_run(project / "runs")) if name in mark.measures]
    if not marks:
        return None
    values, same = np.array([mark.measures[name] for mark in marks]), np.array([mark.same for mark in marks])
    by_fidelity = judge == "fidelity"
    cut, usual = (fit_cut, Settings.replicated) if by_fidelity else (fit_threshold, Settings.threshold)

    def agrees(at: float) -> int:
        return int((((values >= at) if by_fidelity else (values <= at)) == same).sum())

    found = cut(values, same)
    return Learned(
        judge=judge, count=len(marks), cut=found, agrees=agrees(found), usual=usual, usual_agrees=agrees(usual)
    )


def cuts(found: Learned | None, judge: JudgeName) -> Mapping[str, Any]:
    """The settings that follow from what the marks say; the usual ones where they say nothing."""
    if judge == "paper":
        return {"threshold": found.cut if found else Settings.threshold}
    cut = found.cut if found else Settings.replicated
    return {"replicated": cut, "close": min(Settings.close, cut)}


def asked(run: Path, settings: Settings, marked: set[str]) -> tuple[str, ...]:
    """Names of the references of a run whose marks would decide most, the most first; none where it cannot be read.

    settings: the judge and its cuts. marked: names of those that have a mark.
    """
    try:
        record = read_record(run)
    except RunError:
        return ()
    results = [from_record(entry, None) for entry in record["references"]]
    own = Settings.from_record(record["settings"])
    judged = replace(own, judge=settings.judge, replicated=settings.replicated, close=settings.close)
    return worth_marking(Shown(results, Metric.of_record(record), judged), marked=marked)
