"""What to write next: changes of the author's file, each tried on the references before it is shown."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from shapewright.building import Workers
from shapewright.comparison.light_field import RAW_SCALE
from shapewright.feedback.explanation import Explained
from shapewright.feedback.ideas.hypotheses import Hypothesis, hypotheses
from shapewright.feedback.ideas.proposal import Misfit
from shapewright.feedback.ideas.proposals import proposals
from shapewright.feedback.trials.cards import Example, card
from shapewright.feedback.trials.selection import Tried, selected
from shapewright.feedback.writing.edit import can_edit, parameter_line, snippet
from shapewright.judging.judge import Judge
from shapewright.parameters import ParameterSpace
from shapewright.procedures import Procedure
from shapewright.progress import Stages
from shapewright.shapes import Mesh
from shapewright.threads import in_threads

EVALUATIONS = 4_500
"""Shapes built for all trials together, about, where misfits are few: the causes of many take long enough."""
_FEWER = 36  # for each misfit, until a quarter of them is left
_STUDIED = 12  # misfits that hypotheses are made for, at most
_FEW = 0.12  # share of these, of which a proposal must be for more to be tried
_KNOWN = 8  # shapes that no change may alter
_SAMPLES = 40
_PICTURED = 3


@dataclass(frozen=True, eq=False)
class Suggestion:
    """A change that makes references compatible, tried.

    kind: "range", "new part", "part replaced", "moved part" or "part removed". title, text: what and for whom.
    snippet: new and changed definitions, to paste at the end of the file or in place of the old ones; for a Range, the
    changed lines of the signature. source: the whole changed file. picture: PNG, a row for each of a few references:
    the reference with what it misses marked, the replica before and after. references: names of those that become
    compatible. gain: how many they are, less those that are lost. tried: what was measured.
    """

    kind: str
    title: str
    text: str
    snippet: str
    source: str
    picture: bytes
    references: tuple[str, ...]
    gain: int
    tried: Mapping[str, Any] = field(default_factory=dict)

    @property
    def record(self) -> dict[str, Any]:
        """As plain values for JSON, the picture in base64."""
        return {
            "kind": self.kind,
            "title": self.title,
            "text": self.text,
            "snippet": self.snippet,
            "source": self.source,
            "picture": base64.b64encode(self.picture).decode("ascii"),
            "references": list(self.references),
            "gain": self.gain,
            "tried": dict(self.tried),
        }


def suggest(
    procedure: Procedure,
    wanting: Sequence[Explained],
    crew: Workers,
    judge: Judge,
    stages: Stages | None = None,
    limit: int = 5,
) -> tuple[Suggestion, ...]:
    """What would make most of the incompatible references compatible, the largest gain first; empty if nothing would.

    wanting: the incompatible references, explained. crew: builds shapes of the procedure. The same seed gives the same
    suggestions. References that the procedure can replicate already, as a longer search has shown, are left alone.
    """
    stages = stages or Stages(None)
    explained = {each.row: each for each in wanting if each.nearest.distance > judge.settings.threshold}
    if not explained or not can_edit(procedure.source, procedure.name):
        return ()
    stages.begin("hypotheses", 1)
    misfits = _misfits(list(explained.values()), judge)
    always = _always(procedure.space, crew, judge.settings.seed)
    ideas = proposals(procedure.source, procedure.name, procedure.space, misfits, always)
    stages.begin("trials", 1)
    known = [(each.found.parameters, each.found.mesh) for each in list(explained.values())[:_KNOWN]]
    # A part is only ever proposed for misfits that were studied.
    worthy = [idea for idea in ideas if len(idea.starts) > _FEW * min(len(misfits), _STUDIED)]
    evaluations = max(EVALUATIONS - _FEWER * len(misfits), EVALUATIONS // 4)
    found = selected(procedure, worthy, misfits, judge, known, evaluations, limit)
    return tuple(_suggestion(each, procedure, explained, judge) for each in found)


def suggestion_records(*arguments: Any) -> list[dict[str, Any]]:
    """Suggestions as records; arguments: see ``suggest``."""
    return [suggestion.record for suggestion in suggest(*arguments)]


def _misfits(explained: Sequence[Explained], judge: Judge) -> list[Misfit]:
    """All misfits, the first _STUDIED of them, spread over the collection, with hypotheses."""
    count = min(_STUDIED, len(explained))
    studied = {explained[i].row for i in np.linspace(0, len(explained) - 1, count).astype(int)}

    def study(each: Explained) -> Misfit:
        guesses: list[Hypothesis] = []
        if each.row in studied:
            replica = each.best.mesh
            guesses = hypotheses(each.misfit, each.reference, replica, lambda meshes: _costs(judge, each.row, meshes))
        return Misfit(
            each.row,
            each.best.parameters,
            each.best.mesh,
            tuple(guesses[:3]),
            each.nearest.parameters,
            judge.goal,
            each.outside.parameters if each.outside else None,
            each.nearest.distance * RAW_SCALE,
        )

    return in_threads(study, explained, judge.settings.workers)


def _costs(judge: Judge, row: int, meshes: Sequence[Mesh]) -> list[float]:
    one = replace(judge, settings=replace(judge.settings, workers=1))
    return one.search_costs([(row, mesh) for mesh in meshes])


def _always(space: ParameterSpace, crew: Workers, seed: int) -> list[str]:
    """Labels that every shape of the procedure has."""
    builds = crew.build(space.sample(_SAMPLES, seed))
    names = [build.shape.label_names for build in builds if isinstance(build.shape, Mesh)]
    return [name for name in (names[0] if names else ()) if all(name in each for each in names)]


def _suggestion(found: Tried, procedure: Procedure, explained: Mapping[int, Explained], judge: Judge) -> Suggestion:
    idea, trial = found.proposal, found.trial
    rows = sorted(trial.compatible, key=lambda row: trial.distances[row] - explained[row].nearest.distance)
    names = tuple(judge.references.names[row] for row in sorted(rows))
    before = {row: explained[row].nearest.distance for row in rows}
    examples = [_example(explained[row], trial.replicas[row]) for row in rows[:_PICTURED]]
    gain = len(names)
    return Suggestion(
        idea.kind,
        idea.title,
        _text(found, procedure, gain, len(explained)),
        _snippet(found, procedure),
        found.source,
        card(examples),
        names,
        gain,
        {
            "tried": len(trial.distances),
            "compatible": gain,
            "lost": 0,
            "before": float(np.mean(list(before.values()))),
            "after": float(np.mean([trial.distances[row] for row in rows])),
            "parameters": {judge.references.names[row]: trial.parameters[row] for row in rows},
        },
    )


def _example(explained: Explained, after: Mesh) -> Example:
    regions = [region.points for region in explained.misfit.of("unexplained")]
    marked = np.concatenate(regions) if regions else np.zeros((0, 3))
    return Example(explained.reference, marked, explained.best.mesh, after)


def _text(found: Tried, procedure: Procedure, gain: int, misfits: int) -> str:
    would = f"{gain} of {misfits} incompatible references would become compatible"
    if found.proposal.rule is None:
        changes = []
        for name, (low, high, _) in found.ranges.items():
            old: Any = procedure.space[name]
            changes.append(f"{name}: from {old.low:g}..{old.high:g} to {low:.4g}..{high:.4g}")
        return f"{'; '.join(changes)}. {would}, and none is lost."
    flag = found.proposal.rule.flag
    off = f" Without {flag} every shape stays as it was." if flag else " By default every shape stays as it was."
    return f"{found.proposal.title}: {would}, and none is lost.{off}"


def _snippet(found: Tried, procedure: Procedure) -> str:
    if found.proposal.rule is None:
        lines = [parameter_line(found.source, procedure.name, name) for name in found.ranges]
        return "\n".join(dict.fromkeys(lines)) + "\n"
    return snippet(procedure.source, found.source)
