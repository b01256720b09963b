"""Rules of the library as hypotheses: those that bring much for several misfits, in each where it brings most."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from shapewright.feedback.ideas.hypothesis import Costs, Hypothesis, priced
from shapewright.feedback.parts.gallery import Gallery
from shapewright.feedback.parts.lack import Lack
from shapewright.feedback.parts.rule_pieces import Gain, fitted, retrieved
from shapewright.feedback.surfaces.residuals import Residuals
from shapewright.rules.rule import Rule
from shapewright.shapes import Mesh
from shapewright.threads import in_threads

# Where nothing else is said, chosen on first versions of vessels and buildings.
_CHOSEN, _EACH = 12, 3  # rules that are fitted to each misfit, and of these in place of one part
_NONE = 0.01  # of the way to a whole match, that is none
_ALONE = 0.5  # of what a rule brings to one misfit alone: what several lack is worth writing
_PRICE = 0.04  # share of what a rule brings, that each of its parameters costs: of those that do as well, the plainest
_CALLED = 1.25  # times as much a rule has to bring as one that is called what the part is called

Key = tuple[tuple[str, ...], str]
"""Labels of the parts that go, and the name of the rule that comes."""


@dataclass(frozen=True, eq=False)
class Study:
    """A misfit to find rules for.

    Attributes:
        replica: the shape that is changed.
        differences: of the replica from the reference.
        costs: of changed replicas.
    """

    replica: Mesh
    differences: Residuals
    costs: Costs


def rule_hypotheses(
    studies: Sequence[Study], rules: Sequence[Rule], workers: int, gallery: Gallery
) -> list[list[Hypothesis]]:
    """For each study the hypotheses with one rule that the studies share, the best first; none where none helps."""
    lacks = in_threads(_lacks, studies, workers)
    gains = in_threads(lambda own: _gains(own, rules, gallery), lacks, workers)
    worths = [_worths(own, lack) for own, lack in zip(gains, lacks, strict=True)]
    chosen = _shared(worths, {rule.name: rule for rule in rules})

    def tried(row: int) -> list[Hypothesis]:
        study, blank = studies[row], Hypothesis(before=studies[row].costs([studies[row].replica])[0])
        pieces = [(key, fitted(gains[row][key], lacks[row][key[0]])) for key in chosen if key in gains[row]]
        several = [replace(blank, removed=removed, pieces=(piece,)) for (removed, _), (_, piece) in pieces]
        helpful = [one for one in priced(several, study.replica, study.costs) if one.cost < one.before]
        return sorted(helpful, key=lambda one: one.score)

    return in_threads(tried, range(len(studies)), workers)


def _lacks(study: Study) -> dict[tuple[str, ...], Lack]:
    """What is lacking beside all parts, and without each of them, by the labels of the parts that go."""
    without = dict.fromkeys([(), *((label,) for label in study.replica.label_names)])
    return {removed: Lack.of(study.differences, removed) for removed in without}


def _gains(lacks: Mapping[tuple[str, ...], Lack], rules: Sequence[Rule], gallery: Gallery) -> dict[Key, Gain]:
    """What each rule brings beside all parts, and in place of each."""
    found = {removed: retrieved(lack, rules, gallery) for removed, lack in lacks.items()}
    return {(removed, name): gain for removed, several in found.items() for name, gain in several.items()}


def _worths(gains: Mapping[Key, Gain], lacks: Mapping[tuple[str, ...], Lack]) -> dict[Key, float]:
    """What share of the way to a whole match each rule brings the replica, parts that go counted off; those that do.

    What stands in place of a part brings more than what stands beside all parts: else nothing needs to go.
    """
    before = lacks[()].match
    ways = {key: (lacks[key[0]].match + gain - before) / max(1.0 - before, _NONE) for key, (gain, _) in gains.items()}
    beside = {name: way for (removed, name), way in ways.items() if not removed}
    return {key: way for key, way in ways.items() if way > (_NONE + beside.get(key[1], 0.0) if key[0] else _NONE)}


def _shared(worths: Sequence[Mapping[Key, float]], rules: Mapping[str, Rule]) -> list[Key]:
    """The rules that bring most over all studies; of those that bring about as much, the one with the part's name."""
    several: dict[Key, list[float]] = {}
    for one in worths:
        for key, way in one.items():
            several.setdefault(key, []).append(way)
    net = {key: sum(own) * (1.0 - _PRICE * len(rules[key[1]].space)) for key, own in several.items()}
    worth = {key: net[key] * (1.0 if len(own) > 1 else _ALONE) for key, own in several.items()}
    called = {key for key in worth if any(_is_called(rules[key[1]], label) for label in key[0])}
    asked = {removed: max(worth[key] for key in called if key[0] == removed) for removed, _ in called}
    chosen: list[Key] = []
    for key in sorted(worth, key=lambda key: (-worth[key], key)):
        suits = key in called or worth[key] >= _CALLED * asked.get(key[0], 0.0)
        if suits and sum(key[0] == other for other, _ in chosen) < _EACH:
            chosen.append(key)
    return chosen[:_CHOSEN]


def _is_called(rule: Rule, label: str) -> bool:
    """Whether the name of a rule, or where its parts stand, has a word of the label: ``legs``, ``back``."""
    return bool({rule.stance, *rule.noun.split()} & set(label.replace("_", " ").split()))
