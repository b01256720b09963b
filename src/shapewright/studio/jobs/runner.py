"""Long work in processes of their own: fits, explanations, exports. Each reports its progress."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from shapewright.progress import AnswerKind
from shapewright.studio.wire.child import Child, Frame, on_this_loop
from shapewright.studio.wire.problems import Problem

Kind = Literal["fit", "explain", "export"]
State = Literal["idle", "running", "cancelling", "done", "cancelled", "failed"]


@dataclass(eq=False)
class Job:
    """One kind of work, of which at most one runs at a time.

    root: folder that problems are named relative to. changed: called after every change of the record. told: called
    with every event that is not progress.
    """

    kind: Kind
    root: Path
    changed: Callable[[Job], object]
    told: Callable[[dict[str, Any]], object]
    state: State = "idle"
    stages: list[dict[str, Any]] = field(default_factory=list)
    curve: list[dict[str, Any]] = field(default_factory=list)
    answer: AnswerKind | None = None
    problem: Problem | None = None
    result: dict[str, Any] | None = None
    _started: float = 0.0
    _seconds: float = 0.0
    _stage_started: float = 0.0
    _child: Child | None = None
    _task: asyncio.Task[None] | None = None

    @property
    def running(self) -> bool:
        return self.state in ("running", "cancelling")

    def record(self) -> dict[str, Any]:
        """As the page gets it."""
        names = ("kind", "state", "stages", "curve", "answer", "result")
        seconds = time.monotonic() - self._started if self.running else self._seconds
        found = self.problem.record() if self.problem else None
        return {**{name: getattr(self, name) for name in names}, "seconds": round(seconds, 2), "problem": found}

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
            # Requests stay open: when they close, the program knows that the studio has gone.
            self._child = child = Child(module, on_this_loop(frames.put_nowait))
            if self.state == "cancelling":
                child.end()
            child.send({**request, "root": str(self.root)})
            while frame := await frames.get():
                event = frame[0]
                if event["event"] == "failed":
                    failed = Problem.from_record(event["problem"])
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
        if self.stages:
            self.stages[-1]["seconds"] = round(time.monotonic() - self._stage_started, 2)
        self.changed(self)

    def _take(self, event: dict[str, Any]) -> None:
        kind = event.get("event")
        if kind == "progress":
            self._advance(event)
        elif kind == "answer":
            self.answer = event["kind"]
            self.told(event)
        elif kind == "done":
            self.result = event["result"]
            self.told(event)
        self.changed(self)

    def _advance(self, event: dict[str, Any]) -> None:
        now = time.monotonic()
        if not self.stages or self.stages[-1]["name"] != event["stage"]:
            if self.stages:
                self.stages[-1]["seconds"] = round(now - self._stage_started, 2)
            self.stages.append({"name": event["stage"]})
            self._stage_started = now
        known = {name: event[name] for name in ("done", "total", "remark")}
        self.stages[-1] |= known | {"seconds": round(now - self._stage_started, 2)}
        if event.get("losses"):
            self.curve.append(event["losses"])
