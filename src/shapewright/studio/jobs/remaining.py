"""How long work takes still, by what its stages took the last time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import dropwhile

from shapewright.studio.project.timings import Took
from shapewright.studio.wire.work import JobStage

_SURE = 0.2
"""Share of a stage from which on its own pace says more than that of the last time."""
_PACES = 0.25, 4.0
"""How much faster or slower than the last time work is taken to be, at most: shapes may be dearer now."""
_TOLD = 1.0
"""Seconds of work after which it can be told whether it is faster or slower."""


def left(stages: Sequence[JobStage], usual: Mapping[str, Took]) -> float | None:
    """Seconds that a job is likely to take still; None where nobody knows.

    stages: those that have begun, the last one running. usual: what each took the last time, in their order.
    """
    if not usual:
        return None
    if not stages:
        return sum(took.seconds for took in usual.values())
    last, begun = stages[-1], {stage.name for stage in stages}
    share = min(last.done / last.total, 1.0) if last.total > 0 else 0.0
    spent = sum(stage.seconds for stage in stages if stage.name in usual)
    expected = sum(_expected(stage, usual) for stage in stages[:-1]) + share * _expected(last, usual)
    pace = min(max(spent / expected, _PACES[0]), _PACES[1]) if expected >= _TOLD else 1.0
    behind = [*dropwhile(lambda name: name != last.name, usual)] if last.name in usual else [*usual]
    coming = sum(usual[name].seconds for name in behind if name not in begun)
    if share >= _SURE:
        return last.seconds * (1.0 - share) / share + pace * coming
    return max(pace * _expected(last, usual) - last.seconds, 0.0) + pace * coming


def _expected(stage: JobStage, usual: Mapping[str, Took]) -> float:
    """Seconds that a stage takes if a step takes as long as the last time."""
    took = usual.get(stage.name, Took(0.0, 0))
    return took.seconds * (stage.total / took.total if took.total > 1 and stage.total > 1 else 1.0)
