"""What to write next: changes of the author's file, each tried on the references before it is shown."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from shapewright.building import Workers
from shapewright.feedback.cards import Example, card
from shapewright.feedback.edit import EditError, can_edit, parameter_line, snippet
from shapewright.feedback.explanation import Explained
from shapewright.feedback.hypotheses import Hypothesis, hypotheses
from shapewright.feedback.proposals import Misfit, Proposal, Ranges, narrowed, proposals
from shapewright.feedback.trial import GLANCE, LOOK, PEEK, SEARCH, Trial, changed, lent, tried, unchanged
from shapewright.judge import Judge
from shapewright.parameters import Parameters, ParameterSpace, Scalar
from shapewright.procedure import Procedure, ProcedureError
from shapewright.progress import Stages
from shapewright.shapes import Mesh
from shapewright.threads import in_threads

EVALUATIONS = 9_000
"""Shapes built for all trials together, about."""
_STUDIED = 48  # misfits that hypotheses are made for, at most
_GLANCES = 8  # misfits in a first trial
_GLANCED = 20  # proposals that are tried on some misfits, at most: each starts workers of its own
_FEW = 0.12  # share of the misfits, of which a proposal must be for more to be tried
_CONFIRMED = 6  # proposals that are tried on all misfits, at most
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


@dataclass(frozen=True, eq=False)
class _Tried:
    proposal: Proposal
    ranges: Ranges
    source: str
    trial: Trial


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
    stages.begin("trials", 2)
    known = [(each.found.parameters, each.found.mesh) for each in list(explained.values())[:_GLANCES]]
    promising = _glanced(procedure, ideas, misfits, judge, known)
    stages.step(1, 2)
    found = _confirmed(procedure, promising, misfits, judge)
    return tuple(_suggestion(each, procedure, explained, judge) for each in _shown(found, limit))


def _misfits(explained: Sequence[Explained], judge: Judge) -> list[Misfit]:
    """All misfits, the first _STUDIED of them, spread over the collection, with hypotheses."""
    count = min(_STUDIED, len(explained))
    studied = {explained[i].row for i in np.linspace(0, len(explained) - 1, count).astype(int)}

    def study(each: Explained) -> Misfit:
        guesses: list[Hypothesis] = []
        if each.row in studied:
            replica = each.best.mesh
            guesses = hypotheses(each.misfit, each.reference, replica, lambda meshes: _costs(judge, each.row, meshes))
        nearest = each.nearest.parameters
        return Misfit(each.row, each.best.parameters, each.best.mesh, tuple(guesses[:3]), nearest, judge.goal)

    return in_threads(study, explained, judge.settings.workers)


def _costs(judge: Judge, row: int, meshes: Sequence[Mesh]) -> list[float]:
    one = replace(judge, settings=replace(judge.settings, workers=1))
    return one.search_costs([(row, mesh) for mesh in meshes])


def _always(space: ParameterSpace, crew: Workers, seed: int) -> list[str]:
    """Labels that every shape of the procedure has."""
    builds = crew.build(space.sample(_SAMPLES, seed))
    names = [build.shape.label_names for build in builds if isinstance(build.shape, Mesh)]
    return [name for name in (names[0] if names else ()) if all(name in each for each in names)]


def _glanced(
    procedure: Procedure,
    ideas: Sequence[Proposal],
    misfits: Sequence[Misfit],
    judge: Judge,
    known: Sequence[tuple[Parameters, Mesh]],
) -> list[Proposal]:
    """The proposals that bring most to a few of the misfits they are for, best first."""
    scores: list[tuple[float, int, Proposal]] = []
    spent, each = 0, GLANCE.evaluations(_scalars(procedure.space))
    # A part is only ever proposed for misfits that were studied.
    worthy = [idea for idea in ideas if len(idea.starts) > _FEW * min(len(misfits), _STUDIED)]
    for number, idea in enumerate(worthy[:_GLANCED]):
        members = [misfit for misfit in misfits if misfit.row in idea.starts]
        some = [members[i] for i in sorted({int(i) for i in np.linspace(0, len(members) - 1, _GLANCES)})]
        if spent + len(some) * each > 0.4 * EVALUATIONS:
            break
        spent += len(some) * each
        try:
            with changed(idea.write(idea.ranges), procedure, judge) as new:
                if not unchanged(new, known):
                    continue
                trial = tried(new, {m.row: idea.start(m) for m in some}, judge, [GLANCE], judge.settings.seed)
        except (EditError, ProcedureError):
            continue
        trial = trial.standing({m.row: m.replica for m in some})
        share = float(np.mean([_nearness(trial, m.row) for m in some]))
        scores.append((-share * len(members), number, idea))
    return [idea for _, _, idea in sorted(scores, key=lambda score: score[:2])]


def _scalars(space: ParameterSpace) -> int:
    return sum(isinstance(parameter, Scalar) for parameter in space)


def _nearness(trial: Trial, row: int) -> float:
    """1 for a compatible reference, less the further it is, 0 from twice the threshold on."""
    distance = trial.distances.get(row, np.inf)
    return float(np.clip(2.0 - distance / trial.threshold, 0.0, 1.0))


def _confirmed(
    procedure: Procedure, ideas: Sequence[Proposal], misfits: Sequence[Misfit], judge: Judge
) -> list[_Tried]:
    """The proposals that make references compatible, with the Ranges that these need."""
    found: list[_Tried] = []
    peek, look, search = (budget.evaluations(_scalars(procedure.space)) for budget in (PEEK, LOOK, SEARCH))
    most, left = int(0.5 * EVALUATIONS / _CONFIRMED / peek), 0.6 * EVALUATIONS
    for idea in ideas[:_CONFIRMED]:
        first = [m for m in misfits if m.row in idea.starts]
        others = [m for m in misfits if m.row not in idea.starts]
        some = (first + others)[: max(_GLANCES, most)]
        left -= peek * len(some) + (look + search / 2) * min(len(first), len(some))
        if left < 0.0 and len(found) > 1:
            break
        starts, before = {m.row: idea.start(m) for m in some}, {m.row: m.replica for m in some}
        with changed(idea.write(idea.ranges), procedure, judge) as new:
            trial = tried(new, starts, judge, [PEEK, LOOK, SEARCH], judge.settings.seed).standing(before)
            left -= peek * (len(some) - len(trial.compatible))
            trial = lent(new, trial, starts, judge, [PEEK, LOOK, SEARCH], judge.settings.seed).standing(before)
        made = {row: trial.parameters[row] for row in trial.compatible}
        if not made:
            continue
        ranges = narrowed(idea, procedure.space, list(made.values()))
        try:
            source = idea.write(ranges)
            with changed(source, procedure, judge) as new:
                final = tried(new, made, judge, [], judge.settings.seed)
                lost = {row: made[row] for row in made if row not in final.compatible}
                if lost:
                    final = final.joined(tried(new, lost, judge, [SEARCH], judge.settings.seed))
        except (EditError, ProcedureError):
            continue
        if final.compatible:
            found.append(_Tried(idea, ranges, source, final))
    return found


def _value(trial: Trial) -> float:
    """The references that become compatible; a close replica counts half as much again as one at the threshold."""
    return sum(1.5 - 0.5 * trial.distances[row] / trial.threshold for row in trial.compatible)


def _shown(found: Sequence[_Tried], limit: int) -> list[_Tried]:
    """Largest gain first, simpler first on a tie; none that only repeats part of what another does."""
    needed = [each for each in found if not any(_simpler(other, each) for other in found)]
    order = sorted(needed, key=lambda each: (-_value(each.trial), len(each.ranges)))
    shown: list[_Tried] = []
    for each in order:
        repeats = any(
            other.proposal.kind == each.proposal.kind and set(each.trial.compatible) <= set(other.trial.compatible)
            for other in shown
        )
        if not repeats and len(shown) < limit:
            shown.append(each)
    return shown


def _simpler(one: _Tried, other: _Tried) -> bool:
    """Whether one makes fewer Ranges longer than the other, for as many references."""
    fewer = bool(one.proposal.ends) and set(one.proposal.ends) < set(other.proposal.ends)
    return fewer and len(one.trial.compatible) >= len(other.trial.compatible)


def _suggestion(found: _Tried, procedure: Procedure, explained: Mapping[int, Explained], judge: Judge) -> Suggestion:
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


def _text(found: _Tried, procedure: Procedure, gain: int, misfits: int) -> str:
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


def _snippet(found: _Tried, procedure: Procedure) -> str:
    if found.proposal.rule is None:
        lines = [parameter_line(found.source, procedure.name, name) for name in found.ranges]
        return "\n".join(dict.fromkeys(lines)) + "\n"
    return snippet(procedure.source, found.source)
