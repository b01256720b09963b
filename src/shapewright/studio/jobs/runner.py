"""Long work in processes of their own: fits, explanations, exports. Each reports its progress."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from shapewright.studio.jobs.events import Advanced, AnyEvent, Done, Failed, Guessed
from shapewright.studio.wire.child import Child, Frame, on_this_loop
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.values import message_of
from shapewright.studio.wire.work import Answer, Epoch, Job, JobKind, JobResult, JobStage, JobState


@dataclass(eq=False)
class Runner:
    """One kind of work, of which at most one runs at a time; see ``wire.work.Job`` for the other fields."""

    kind: JobKind
    root: Path  # folder that problems name files relative to
    changed: Callable[[Runner], object]  # called after every change
    guessed: Callable[[Guessed], object]  # called with parameters that are known before the end of a fit
    state: JobState = "idle"
    stages: list[JobStage] = field(default_factory=list)
    curve: list[Epoch] = field(default_factory=list)
    answer: Answer | None = None
    problem: Problem | None = None
    result: JobResult | None = None
    _started: float = 0.0
    _seconds: float = 0.0
    _stage_started: float = 0.0
    _child: Child | None = None
    _task: asyncio.Task[None] | None = None

    @property
    def running(self) -> bool:
        return self.state in ("running", "cancelling")

    def job(self) -> Job:
        """As the page gets it."""
        seconds = time.monotonic() - self._started if self.running else self._seconds
        return message_of(Job, self, seconds=round(seconds, 2))

    def start(self, module: str, request: dict[str, Any]) -> None:
        """Run a program with a request; nothing else of this kind may be running."""
        assert not self.running
        self.state, self.stages, self.curve = "running", [], []
        self.answer = self.problem = self.result = None
        self._started = time.monotonic()
        self._task = asyncio.create_task(self._run(module, request))
        self.changed(self)

    async def cancel(self) -> None:
        """End what runs, if anything does, and wait until it has ended."""
        if not self.running or self._task is None:
            return
        self.state = "cancelling"
        self.changed(self)
        if self._child:
            await asyncio.to_thread(self._child.end)
        await asyncio.wait([self._task])

    async def _run(self, module: str, request: dict[str, Any]) -> None:
        failed: Problem | None = None
        try:
            frames: asyncio.Queue[Frame | None] = asyncio.Queue()
            # Requests stay open: when they close, the program knows that the studio has ended.
            self._child = child = Child(module, on_this_loop(frames.put_nowait), AnyEvent)
            if self.state == "cancelling":
                child.end()
            child.send({**request, "root": str(self.root)})
            while frame := await frames.get():
                event = frame[0]
                if isinstance(event, Failed):
                    failed = event.problem
                elif self.state == "running":
                    self._take(event)
            status = await asyncio.to_thread(child.process.wait)
            await asyncio.to_thread(child.end)  # its own workers, where they still run
            if status != 0 and failed is None:
                failed = Problem(self.kind, f"it ended with status {status}; the terminal says more")
        except OSError as error:
            failed = Problem(self.kind, f"it could not be started: {error}")
        finally:
            self._child = None
            self._seconds = time.monotonic() - self._started
        if self.state == "cancelling":
            self.state = "cancelled"
        else:
            self.state, self.problem = "failed" if failed else "done", failed
        self._end_stage(time.monotonic())
        self.changed(self)

    def _take(self, event: Advanced | Guessed | Done) -> None:
        match event:
            case Advanced():
                self._advance(event)
            case Guessed():
                self.answer = event.kind
                self.guessed(event)
            case Done():
                self.result = event.result
        self.changed(self)

    def _advance(self, event: Advanced) -> None:
        now = time.monotonic()
        if not self.stages or self.stages[-1].name != event.stage:
            self._end_stage(now)
            self.stages.append(JobStage(name=event.stage, done=0, total=0, remark="", seconds=0.0))
            self._stage_started = now
        stage = self.stages[-1]
        stage.done, stage.total, stage.remark = event.done, event.total, event.remark
        stage.seconds = round(now - self._stage_started, 2)
        if event.losses:
            self.curve.append(event.losses)

    def _end_stage(self, now: float) -> None:
        if self.stages:
            self.stages[-1].seconds = round(now - self._stage_started, 2)
