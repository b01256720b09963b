"""What became of one shape: built, or failed and why; and what a shape may cost."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from shapewright.parameters import Parameters
from shapewright.shapes import Shape

FailureKind = Literal["infeasible", "raised", "no shape", "time", "memory", "crash"]


@dataclass(frozen=True)
class Limits:
    """What one shape may cost. seconds: wall time; memory_mb: address space of a worker beyond its start (POSIX)."""

    seconds: float = 10.0
    memory_mb: int = 2048


@dataclass(frozen=True)
class Failure:
    """Why a shape could not be built. kind says what happened, message where and what."""

    kind: FailureKind
    message: str


@dataclass(frozen=True)
class Build:
    """One attempt: the parameters, and the shape or the failure."""

    parameters: Parameters
    shape: Shape | None
    failure: Failure | None = None
    seconds: float = 0.0


def describe_failures(builds: Sequence[Build]) -> str:
    """The failures in one line a kind of message, commonest first, each with parameters that caused it."""
    failed = [build for build in builds if build.failure]
    if not failed:
        return "no failures"
    example = {build.failure: build.parameters for build in reversed(failed) if build.failure}
    counts = Counter(build.failure for build in failed if build.failure)
    return "; ".join(
        f"{count} x {failure.kind}: {failure.message}, for example with {_call(example[failure])}"
        for failure, count in counts.most_common(3)
    )


def _call(parameters: Parameters) -> str:
    return ", ".join(f"{k}={round(v, 6) if isinstance(v, float) else repr(v)}" for k, v in parameters.items())
