"""What a long computation tells whoever watches it."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

from shapewright.parameters import Parameters

AnswerKind = Literal["carried over", "most similar samples", "predicted"]
"""Where parameters that are shown before the end of a fit come from: the run before, the first samples, the network."""

NoticeKind = Literal["waiting", "pace", "within", "kept", "stochastic", "lying", "size", "not kept", "going on"]
"""What a notice is about: no shape yet, the cost of a shape, how a limit of time is divided, samples of an earlier run
that are used again, a procedure that builds other shapes from the same parameters, references in which another axis is
up than in its shapes, or that are as large as these, files that it reads of which runs keep no copy, and a fit that was
stopped and goes on."""


@dataclass(frozen=True)
class Notice:
    """Something that whoever watches is told once.

    kind: what it is about.
    text: the same for a person.
    """

    kind: NoticeKind
    text: str


@dataclass(frozen=True)
class Progress:
    """A stage of an iteration, and how far it is.

    stage: name of the stage.
    done: steps that are done.
    total: steps that there are.
    remark: what a person may read beside it.
    answer: the parameters of every reference as far as they are known by now; None when there is nothing new.
    losses: of the epoch of training that ended: epoch, train, validation (None where nothing was held back).
    answer_kind: where ``answer`` comes from; None without one.
    left: seconds that all stages together are likely to take still; None where nobody knows.
    notice: something that is told now, and not again.
    """

    stage: str
    done: int
    total: int
    remark: str = ""
    answer: Mapping[str, Parameters] | None = field(default=None, repr=False)
    losses: Mapping[str, float | None] | None = field(default=None, repr=False)
    answer_kind: AnswerKind | None = None
    left: float | None = None
    notice: Notice | None = None

    def __str__(self) -> str:
        if self.notice:
            return self.notice.text
        return f"{self.stage} {self.done}/{self.total}{' ' + self.remark if self.remark else ''}"


Listener = Callable[[Progress], object]


class Stages:
    """Reports the stages of one iteration to a listener, a few times a second at most, and keeps their seconds."""

    INTERVAL = 0.2
    KNOWN = 0.05
    """Share of the work from which on the time that is left can be told."""

    def __init__(self, listener: Listener | None, shares: Mapping[str, float] | None = None) -> None:
        """shares: of each stage in the time of all, which add up to 1, for telling what is left."""
        self.seconds: dict[str, float] = {}
        self.first_answer: float | None = None
        self.notices: list[Notice] = []
        self._created = time.perf_counter()
        self._listener = listener
        self._shares = shares or {}
        self._stage = ""
        self._started = self._told = 0.0
        self._done = self._total = 0

    @property
    def elapsed(self) -> float:
        """Seconds since the beginning."""
        return time.perf_counter() - self._created

    def begin(self, stage: str, total: int) -> None:
        """Begin a stage; one that has begun already goes on."""
        if stage == self._stage:
            self.step(min(self._done, total), total)
            return
        self.end()
        self._stage, self._started, self._told = stage, time.perf_counter(), 0.0
        self.step(0, total)

    def step(self, done: int, total: int, remark: str = "", losses: Mapping[str, float | None] | None = None) -> None:
        now = time.perf_counter()
        self._done, self._total = done, total
        if self._listener and (now - self._told >= self.INTERVAL or done >= total):
            self._told = now
            self._listener(Progress(self._stage, done, total, remark, losses=losses, left=self._left(now)))

    def _left(self, now: float) -> float | None:
        """Seconds, as if the rest took as long for its share as what is done."""
        past = sum(share for stage, share in self._shares.items() if stage in self.seconds and stage != self._stage)
        past += self._shares.get(self._stage, 0.0) * min(self._done / max(self._total, 1), 1.0)
        return (now - self._created) * max(1.0 - past, 0.0) / past if past >= self.KNOWN else None

    def answer(self, answer: Mapping[str, Parameters], kind: AnswerKind) -> None:
        """Report the parameters that are known so far; never held back."""
        if self.first_answer is None:
            self.first_answer = time.perf_counter() - self._created
        if self._listener:
            self._listener(Progress(self._stage, 1, 1, kind, answer, answer_kind=kind))

    def tell(self, notice: Notice, recorded: bool = True) -> None:
        """Tell something once; never held back. recorded: whether it is among the ``notices``."""
        if recorded:
            self.notices.append(notice)
        if self._listener:
            self._listener(Progress(self._stage, self._done, self._total, notice=notice))

    def end(self) -> None:
        if self._stage:
            if self._done < self._total:
                self.step(self._total, self._total)
            spent = time.perf_counter() - self._started
            self.seconds[self._stage] = self.seconds.get(self._stage, 0.0) + spent
            self._stage = ""
