"""What the program of a job reports to the server, and how it runs."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO, TypeAlias

from msgspec import Struct

from shapewright.procedures import ProcedureError
from shapewright.progress import AnswerKind, Progress
from shapewright.references.errors import CollectionError
from shapewright.runs.folder import RunError
from shapewright.studio.wire.child import own_streams, read_frame, write_frame
from shapewright.studio.wire.problems import Problem, ProblemKind, of_error
from shapewright.studio.wire.values import Values, message_of
from shapewright.studio.wire.work import Epoch, JobKind, JobResult

OPENING = "open"
"""The first stage of every job: its program starts, and reads what it needs."""


class Event(Struct, frozen=True, kw_only=True, tag=True):
    """Any of them."""


class Advanced(Event, frozen=True):
    """A stage went on."""

    stage: str
    done: int
    total: int
    remark: str = ""
    losses: Epoch | None = None  # of an epoch that ended
    left: float | None = None  # seconds that the job is likely to take still


class Guessed(Event, frozen=True):
    """Parameters are known before the end of a fit."""

    kind: AnswerKind
    answer: dict[str, Values]  # by name of the reference


class Failed(Event, frozen=True):
    """The job ends without a result."""

    problem: Problem


class Done(Event, frozen=True):
    """The job ends with a result."""

    result: JobResult


AnyEvent: TypeAlias = Advanced | Guessed | Failed | Done


class Reporter:
    """Sends events over a stream."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self._notices: dict[str, str] = {}  # of each stage

    def send(self, event: AnyEvent) -> None:
        write_frame(self._stream, event)

    def stage(self, name: str, done: int, total: int) -> None:
        """Report how far a stage is."""
        self.send(Advanced(stage=name, done=done, total=total))

    def opens(self, done: int, total: int, remark: str) -> None:
        """Report how far the program is with what it needs."""
        self.send(Advanced(stage=OPENING, done=done, total=total, remark=remark))

    def progress(self, progress: Progress) -> None:
        """Report an event of a fit or an explanation."""
        if progress.answer is not None and progress.answer_kind is not None:
            self.send(Guessed(kind=progress.answer_kind, answer=dict(progress.answer)))
            return
        if progress.notice:
            before = self._notices.get(progress.stage, "")
            self._notices[progress.stage] = f"{before} {progress.notice.text}".strip()
        progress = replace(progress, remark=progress.remark or self._notices.get(progress.stage, ""))
        losses = Epoch(**progress.losses) if progress.losses else None  # type: ignore[arg-type]
        self.send(message_of(Advanced, progress, losses=losses))


ERRORS: tuple[type[Exception], ...] = (ProcedureError, RunError, ValueError, OSError)
Work = Callable[[dict[str, Any], Reporter], JobResult]


def run(kind: JobKind, work: Work, errors: tuple[type[Exception], ...] = ERRORS) -> None:
    """Run the program of a job: do the work that the server requests, and report its result or why there is none.

    When the stream of requests closes the studio has ended; this program then ends too, with all that it started.
    Live evaluation goes before it. errors: what becomes a problem that the author sees.
    """
    if hasattr(os, "nice"):
        os.nice(5)
    requests, events = own_streams()
    frame = read_frame(requests)
    if frame is None:
        sys.exit(1)

    def watch() -> None:
        while read_frame(requests):
            pass
        if os.name == "posix":
            os.killpg(os.getpgrp(), signal.SIGKILL)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
    request, reporter = frame[0], Reporter(events)
    try:
        reporter.send(Done(result=work(request, reporter)))
    except errors as error:
        reporter.send(Failed(problem=of_error(error, _problem_kind(kind, error), Path(request["root"]))))
        sys.exit(1)


def _problem_kind(kind: JobKind, error: Exception) -> ProblemKind:
    if kind == "fit" and isinstance(error, ProcedureError):
        return "load"
    return "references" if kind == "fit" and isinstance(error, CollectionError) else kind
