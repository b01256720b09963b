"""A change of a procedure that is proposed, and the misfits that it is for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from shapewright.comparison.light_field import RAW_SCALE, THRESHOLD
from shapewright.feedback.case import Replica
from shapewright.feedback.ideas.hypothesis import Hypothesis
from shapewright.feedback.parts.attachment import separate
from shapewright.feedback.writing.change import FileChange
from shapewright.feedback.writing.rule_code import RuleDraft
from shapewright.parameters import End, Parameters
from shapewright.shapes import Mesh

Interval = tuple[float, float, float]
"""Low, high and default of a parameter."""
Ranges = Mapping[str, Interval]
"""By the name of the parameter."""
_LEAST_WAY = 0.05  # nearer shapes are as good as replicated


@dataclass(frozen=True, eq=False)
class Misfit:
    """A reference that is not replicated, and what could be changed for it."""

    covering: Replica  # the replica within the space whose surface has most in common with the reference's
    nearest: Replica  # the replica within the space that is nearest by the light field
    outside: Replica  # the nearest replica with longer Ranges
    hypotheses: tuple[Hypothesis, ...] = ()  # the best first
    goal: float = THRESHOLD * RAW_SCALE  # the cost of a replica that may well be compatible

    @property
    def row(self) -> int:
        """Index of the reference in its collection."""
        return self.covering.row

    @property
    def replica(self) -> Mesh:
        """The shape that hypotheses change."""
        return self.covering.mesh

    @cached_property
    def pieces(self) -> int:
        """Into how many pieces its replica falls."""
        return separate(self.replica)

    def way(self, apart: float) -> float:
        """How much of the way from the nearest replica to a replicated one another has come, 0 to 1."""
        way = min(max(self.nearest.apart - 1.0, _LEAST_WAY), 1.0)
        return min(max((1.0 + way - apart) / way, 0.0), 1.0)


@dataclass(frozen=True, eq=False)
class Proposal:
    """A change to try."""

    kind: str  # see ``suggestions.Suggestion``
    title: str  # what changes
    source: str  # of the author's file, without the change
    change: Callable[[Ranges], FileChange]  # of the file, given Ranges
    ranges: Ranges  # wide ones to begin with
    starts: Mapping[int, Parameters]  # values of the new parameters by row of a misfit; others start at the medians
    worth: float  # how many references it may help, roughly
    rule: RuleDraft | None = None  # of a new or changed part; None for a wider Range
    ends: tuple[End, ...] = ()  # of the Ranges that are wider

    def candidates(self, misfit: Misfit) -> list[Parameters]:
        """Where a search may begin for a misfit."""
        if self.rule is None:
            return [misfit.outside.parameters, misfit.nearest.parameters]
        middle: Parameters = {q.name: as_value(q.whole, self.ranges[q.name][2]) for q in self.rule.quantities}
        flag: Parameters = {self.flag: self._on} if self.flag else {}
        return [{**misfit.covering.parameters, **middle, **flag, **self.starts.get(misfit.row, {})}]

    def write(self, ranges: Ranges) -> str:
        """The changed source with these Ranges. Raises EditError."""
        return self.change(ranges).written(self.source)

    def adding(self, change: FileChange) -> str | None:
        """The source changed so that it makes only what the change adds; None where that is no part."""
        if not (self.rule and self.rule.alone and change.rule):
            return None
        function = change.rule.function.replace(self.rule.function, self.rule.alone)
        return replace(change, rule=replace(change.rule, function=function)).written(self.source)

    def uses(self, parameters: Parameters) -> bool:
        """Whether parameters of the changed procedure make something that it did not make before."""
        return self.flag is None or parameters[self.flag] == self._on

    @property
    def flag(self) -> str | None:
        """The binary that switches the rule on, where there is one."""
        return self.rule.flag if self.rule else None

    @property
    def _on(self) -> bool:
        """What switches the rule on: one without a function makes a part optional, and is on where the part is not."""
        return self.rule is not None and self.rule.function != ""


def as_value(whole: bool, value: float) -> float | int:
    """A value of a parameter. whole: whether that is an integer."""
    return round(value) if whole else float(value)


def listed(words: Sequence[str]) -> str:
    """Words in a row, as a sentence has them."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
