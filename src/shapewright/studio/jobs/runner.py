"""Long work in processes of their own: fits, explanations, exports. Each reports its progress."""

from __future__ import annotations

import asyncio
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from shapewright.studio.jobs.events import OPENING, Advanced, AnyEvent, Done, Failed, Guessed
from shapewright.studio.jobs.remaining import left
from shapewright.studio.project.timings import Took
from shapewright.studio.wire.child import Child, Frame, on_this_loop
from shapewright.studio.wire.printed import Printed
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.work import Job, JobKind, JobStage

_OFTEN = 0.3
"""Seconds between two looks at what a job has printed."""


@dataclass(eq=False)
class Runner:
    """One kind of work, of which at most one runs at a time."""

    kind: JobKind
    root: Path  # folder that problems name files relative to
    changed: Callable[[Runner], object]  # called after every change
    guessed: Callable[[Guessed], object]  # called with parameters that are known before the end of a fit
    printed: Callable[[JobKind, str], object]  # called with what it prints
    _usual: Mapping[str, Took] = field(default_factory=dict)
    _started: float = 0.0
    _stage_started: float = 0.0
    _child: Child | None = None
    _task: asyncio.Task[None] | None = None

    def __post_init__(self) -> None:
        self._job = Job(kind=self.kind)

    @property
    def running(self) -> bool:
        return self._job.state in ("running", "cancelling")

    def job(self) -> Job:
        """As the page gets it."""
        seconds = time.monotonic() - self._started if self.running else self._job.seconds
        return replace(self._job, seconds=round(seconds, 2))

    def start(self, module: str, request: dict[str, Any], usual: Mapping[str, Took]) -> None:
        """Run a program with a request; nothing else of this kind may be running. usual: what its stages took last."""
        assert not self.running
        self._usual = usual
        self._job = Job(kind=self.kind, state="running", left=left([], usual))
        self._started = self._stage_started = time.monotonic()
        # The program takes seconds until it says something.
        self._job.stages.append(JobStage(name=OPENING, done=0, total=1, remark="", seconds=0.0))
        self._task = asyncio.create_task(self._run(module, request))
        self.changed(self)

    async def cancel(self) -> None:
        """End what runs, if anything does, and wait until it has ended."""
        if not self.running or self._task is None:
            return
        self._job.state = "cancelling"
        self.changed(self)
        if self._child:
            await asyncio.to_thread(self._child.end)
        await asyncio.wait([self._task])

    async def _run(self, module: str, request: dict[str, Any]) -> None:
        failed: Problem | None = None
        printed = Printed()
        listener = asyncio.create_task(self._listen(printed))
        try:
            frames: asyncio.Queue[Frame | None] = asyncio.Queue()
            # Requests stay open: when they close, the program knows that the studio has ended.
            self._child = child = Child(module, on_this_loop(frames.put_nowait), AnyEvent, printed=printed)
            if self._job.state == "cancelling":
                child.end()
            child.send({**request, "root": str(self.root)})
            while frame := await frames.get():
                event = frame[0]
                if isinstance(event, Failed):
                    failed = event.problem
                elif self._job.state == "running":
                    self._take(event)
            status = await asyncio.to_thread(child.process.wait)
            await asyncio.to_thread(child.end)  # its own workers, where they still run
            if status != 0 and failed is None:
                failed = Problem(self.kind, f"it ended with status {status}; the terminal says more")
        except OSError as error:
            failed = Problem(self.kind, f"it could not be started: {error}")
        finally:
            self._child = None
            listener.cancel()
            self._hear(printed)
            printed.close()
            self._job.seconds = time.monotonic() - self._started
        if self._job.state == "cancelling":
            self._job.state = "cancelled"
        else:
            self._job.state, self._job.problem = "failed" if failed else "done", failed
        self._job.left = None
        self._end_stage(time.monotonic())
        self.changed(self)

    async def _listen(self, printed: Printed) -> None:
        while True:
            await asyncio.sleep(_OFTEN)
            self._hear(printed)

    def _hear(self, printed: Printed) -> None:
        """Tell what was printed; the terminal says it, too."""
        if text := printed.take():
            sys.stderr.write(text)
            self.printed(self.kind, text)

    def _take(self, event: Advanced | Guessed | Done) -> None:
        match event:
            case Advanced():
                self._advance(event)
            case Guessed():
                self._job.answer = event.kind
                self.guessed(event)
            case Done():
                self._job.result = event.result
        self.changed(self)

    def _advance(self, event: Advanced) -> None:
        now = time.monotonic()
        if not self._job.stages or self._job.stages[-1].name != event.stage:
            self._end_stage(now)
            self._job.stages.append(JobStage(name=event.stage, done=0, total=0, remark="", seconds=0.0))
            self._stage_started = now
        stage = self._job.stages[-1]
        stage.done, stage.total, stage.remark = event.done, event.total, event.remark
        stage.seconds = round(now - self._stage_started, 2)
        self._job.left = left(self._job.stages, self._usual) if event.left is None else event.left
        if event.losses:
            self._job.curve.append(event.losses)

    def _end_stage(self, now: float) -> None:
        if self._job.stages:
            self._job.stages[-1].seconds = round(now - self._stage_started, 2)
