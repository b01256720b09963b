"""What to write next: changes of the author's file, each tried on the references before it is shown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from shapewright.building import Workers
from shapewright.comparison.light_field import RAW_SCALE, THRESHOLD
from shapewright.feedback.case import Case, Replica
from shapewright.feedback.ideas.hypotheses import hypotheses
from shapewright.feedback.ideas.hypothesis import Hypothesis
from shapewright.feedback.ideas.proposal import Misfit
from shapewright.feedback.ideas.proposals import proposals
from shapewright.feedback.ideas.rule_hypotheses import Study, rule_hypotheses
from shapewright.feedback.parts.gallery import Gallery
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.feedback.trials.cards import Example, card
from shapewright.feedback.trials.change import Change
from shapewright.feedback.trials.selection import selected
from shapewright.feedback.trials.tried import Tried
from shapewright.feedback.writing.change import FileChange
from shapewright.feedback.writing.edit import parameter_line
from shapewright.feedback.writing.source import can_edit, snippet
from shapewright.judging.judge import Judge
from shapewright.parameters import ParameterSpace
from shapewright.procedures import Procedure, is_foreign
from shapewright.progress import Stages
from shapewright.rules.library import library
from shapewright.rules.rule import Rule
from shapewright.shapes import Mesh
from shapewright.storage import cache_folder
from shapewright.threads import in_threads

EVALUATIONS = 4_500
"""Shapes built for all trials together, about, where misfits are few: the causes of many take long enough."""
PAPER_GOAL = THRESHOLD * RAW_SCALE
"""Of the raw light field distance: what hypotheses cost is in these units, whichever judge it is."""
# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_FEWER, _LEAST = 36, 1 / 4  # shapes less for each misfit, until this part of them is left
_STUDIED = 12  # misfits that hypotheses are made for, at most
_HYPOTHESES = 3  # of each of these, at most
_FEW = 0.12  # share of these, of which a proposal must be for more to be tried
_KNOWN = 8  # shapes that no change may alter
_SAMPLES = 40  # shapes that tell which parts all shapes have
_PICTURED = 3  # references in the picture of a suggestion


@dataclass(frozen=True, eq=False)
class Suggestion:
    """A change of the author's file that brings references nearer, tried on them."""

    kind: str  # "range", "new part", "part replaced", "moved part" or "part removed"
    title: str  # what changes
    text: str  # what changes, and for how many references
    snippet: str  # new and changed definitions, to paste into the file; for a Range, changed lines of the signature
    source: str  # the whole changed file
    picture: bytes  # PNG with a row for each of a few references, see ``cards.card``
    references: tuple[str, ...]  # names of those that become replicated
    nearer: tuple[str, ...] = ()  # names of others that come much nearer
    tried: Mapping[str, Any] = field(default_factory=dict)  # what was measured
    change: FileChange | None = None  # the same as facts, for a file that has been edited since

    @property
    def gain(self) -> int:
        """How many references become replicated; none is lost."""
        return len(self.references)


def suggestions(
    procedure: Procedure,
    cases: Sequence[Case],
    crew: Workers,
    judge: Judge,
    stages: Stages | None = None,
    limit: int = 5,
    rules: Sequence[Rule] | None = None,
) -> tuple[tuple[Suggestion, ...], tuple[Tried, ...]]:
    """What would bring most of the cases nearer, the most per line of code first; and all that was tried on them.

    cases: those that no parameters of the procedure replicate, as a longer search has shown. crew: builds shapes of the
    procedure. limit: of the number of suggestions. rules: the library; by default all of it, and those of the files
    beside the procedure. The same seed gives the same suggestions.
    """
    if not cases or no_suggestions(procedure):
        return (), ()
    stages = stages or Stages(None)
    stages.begin("hypotheses", 1)
    known_rules = library(procedure.path.parent if procedure.path else None) if rules is None else rules
    misfits = _misfits(cases, judge, known_rules)
    always = _always(procedure.space, crew, judge.settings.seed)
    ideas = proposals(procedure.source, procedure.name, procedure.space, misfits, always)
    stages.begin("trials", 1)
    known = [case.replica for case in cases[:_KNOWN]]
    # A part is only ever proposed for misfits that were studied.
    worthy = [idea for idea in ideas if len(idea.starts) > _FEW * min(len(misfits), _STUDIED)]
    evaluations = max(EVALUATIONS - _FEWER * len(misfits), int(_LEAST * EVALUATIONS))
    changes, tried = selected(procedure, worthy, misfits, judge, known, evaluations, limit)
    by_row = {case.row: case for case in cases}
    return tuple(_suggestion(change, procedure, by_row, judge) for change in changes), tuple(tried)


def no_suggestions(procedure: Procedure) -> str | None:
    """Why no changes of this procedure can be suggested, in a sentence; None where they can."""
    if is_foreign(procedure.path) or not can_edit(procedure.source, procedure.name):
        return (
            "No changes are suggested, since they edit a function at the top level of a Python file, "
            f"and {procedure.name} is none."
        )
    return None


def _misfits(cases: Sequence[Case], judge: Judge, rules: Sequence[Rule]) -> list[Misfit]:
    """All cases, _STUDIED of them, spread over the collection, with hypotheses."""
    count = min(_STUDIED, len(cases))
    studied = [cases[i] for i in sorted({int(i) for i in np.linspace(0, len(cases) - 1, count)})]
    bases = dict(
        zip(studied, in_threads(lambda case: _base(case, judge), studied, judge.settings.workers), strict=True)
    )
    gallery = Gallery.opened(cache_folder())
    shared = rule_hypotheses(list(bases.values()), rules, judge.settings.workers or 1, gallery)
    gallery.keep()
    of_rules = {case.row: several for case, several in zip(studied, shared, strict=True)}

    def study(case: Case) -> Misfit:
        guesses: list[Hypothesis] = []
        if base := bases.get(case):
            guesses = hypotheses(base.differences, case.reference, base.replica, base.costs)[:_HYPOTHESES]
        return Misfit(
            _changed(case, judge), case.nearest, case.outside, (*guesses, *of_rules.get(case.row, ())), PAPER_GOAL
        )

    return in_threads(study, cases, judge.settings.workers)


def _changed(case: Case, judge: Judge) -> Replica:
    """What hypotheses change: by the paper's judge the replica whose surface has most in common, else the nearest."""
    return case.covering if judge.settings.judge == "paper" else case.nearest


def _base(case: Case, judge: Judge) -> Study:
    """The replica that hypotheses change. They are priced by what a search makes small, in units of the light field."""
    target = judge.targets[case.row]
    if judge.settings.judge == "paper":
        return Study(case.covering.mesh, case.covering_residuals, lambda meshes: [target.cost(mesh) for mesh in meshes])
    objective, unit = target.objective(), PAPER_GOAL / judge.goal

    def costs(meshes: Sequence[Mesh]) -> list[float]:
        rows = [objective.residual(mesh) if objective else None for mesh in meshes]
        return [np.inf if row is None else unit * float(np.abs(row).sum()) for row in rows]

    return Study(case.nearest.mesh, residuals(case.residuals.reference, case.nearest.mesh), costs)


def _always(space: ParameterSpace, crew: Workers, seed: int) -> list[str]:
    """Labels that every shape of the procedure has."""
    builds = crew.build(space.sample(_SAMPLES, seed))
    names = [build.shape.label_names for build in builds if isinstance(build.shape, Mesh)]
    return [name for name in (names[0] if names else ()) if all(name in others for others in names)]


def _suggestion(change: Change, procedure: Procedure, cases: Mapping[int, Case], judge: Judge) -> Suggestion:
    """cases: all, by row."""
    idea, outcome = change.proposal, change.outcome
    rows = sorted(outcome.replicated, key=lambda row: outcome.apart(row) - cases[row].nearest.apart)
    others = [row for row in change.helped if row not in rows]
    others.sort(key=lambda row: outcome.apart(row) - cases[row].nearest.apart)
    names = judge.references.names
    examples = []
    for row in [*rows, *others][:_PICTURED]:
        marked = [np.zeros((0, 3)), *(region.points for region in cases[row].covering_residuals.of("unexplained"))]
        before, after = cases[row].nearest.mesh, outcome.replicas[row].mesh
        examples.append(Example(cases[row].reference, np.concatenate(marked), before, after))
    return Suggestion(
        idea.kind,
        idea.title,
        _text(change, procedure, len(rows), len(others), len(cases)),
        _snippet(change, procedure),
        change.source,
        card(examples),
        tuple(names[row] for row in sorted(rows)),
        tuple(names[row] for row in sorted(others)),
        {
            "tried": len(outcome.counted),
            "replicated": len(rows),
            "nearer": len(others),
            "lost": 0,
            "before": float(np.mean([cases[row].nearest.distance for row in change.helped])),
            "after": float(np.mean([outcome.replicas[row].distance for row in change.helped])),
            "parameters": {names[row]: outcome.parameters[row] for row in change.helped},
        },
        change.edit,
    )


def _text(change: Change, procedure: Procedure, gain: int, nearer: int, misfits: int) -> str:
    would = f"{gain} of {misfits} misfits would become replicated"
    would += f", {nearer} more would come nearer" if nearer else ""
    if change.proposal.rule is None:
        changes = []
        for name, (low, high, _) in change.ranges.items():
            old: Any = procedure.space[name]
            changes.append(f"{name}: from {old.low:g}..{old.high:g} to {low:.4g}..{high:.4g}")
        return f"{'; '.join(changes)}. {would}, and none is lost."
    flag = change.proposal.rule.flag
    off = f" Without {flag} every shape stays as it was." if flag else " By default every shape stays as it was."
    return f"{would}, and none is lost.{off}"


def _snippet(change: Change, procedure: Procedure) -> str:
    if change.proposal.rule is None:
        lines = [parameter_line(change.source, procedure.name, name) for name in change.ranges]
        return "\n".join(dict.fromkeys(lines)) + "\n"
    return snippet(procedure.source, change.source)
