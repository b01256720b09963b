"""Long work in processes of their own: fits, explanations, exports. Each tells its progress in lines of JSON."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from shapewright.progress import AnswerKind
from shapewright.studio.wire.problems import Problem

Kind = Literal["fit", "explain", "export"]
State = Literal["idle", "running", "cancelling", "done", "cancelled", "failed"]
_GRACE = 3.0
_LINE = 2**25


async def spawn(*arguments: str) -> asyncio.subprocess.Process:
    """Start a Python program that speaks over its standard streams, in a process group of its own."""
    return await asyncio.create_subprocess_exec(
        sys.executable,
        *arguments,
        stdin=asyncio.subprocess.PIPE,
        stdout=asyncio.subprocess.PIPE,
        limit=_LINE,
        start_new_session=os.name == "posix",
    )


async def end(process: asyncio.subprocess.Process) -> None:
    """End a process and those it started, however they feel about it."""
    if process.returncode is not None and os.name != "posix":
        return
    with contextlib.suppress(ProcessLookupError, PermissionError):
        if os.name == "posix":
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
    await process.wait()


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
    _process: asyncio.subprocess.Process | None = None
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

    def start(self, arguments: list[str], request: dict[str, Any]) -> None:
        """Run a program with one line of JSON on its standard input; nothing else of this kind may be running."""
        assert not self.running
        self.state, self.stages, self.curve = "running", [], []
        self.answer = self.problem = self.result = None
        self._started = time.monotonic()
        self._task = asyncio.create_task(self._run(arguments, request))
        self.changed(self)

    async def cancel(self) -> None:
        """End what runs, if anything does, and wait until it has ended."""
        if not self.running or self._task is None:
            return
        self.state = "cancelling"
        self.changed(self)
        if self._process:
            await end(self._process)
        await asyncio.wait([self._task])

    async def _run(self, arguments: list[str], request: dict[str, Any]) -> None:
        failed: Problem | None = None
        try:
            self._process = process = await spawn(*arguments)
            if self.state == "cancelling":
                await end(process)
            assert process.stdin and process.stdout
            with contextlib.suppress(ConnectionError):
                # The pipe stays open: when it closes, the program knows that the studio has gone.
                process.stdin.write(json.dumps({**request, "root": str(self.root)}).encode() + b"\n")
                await process.stdin.drain()
            async for line in process.stdout:
                event = _parsed(line)
                if event.get("event") == "failed":
                    failed = Problem.from_record(event["problem"])
                elif self.state == "running":
                    self._take(event)
            status = await process.wait()
            await end(process)  # its own workers, where they still run
            if status != 0 and failed is None:
                failed = Problem(self.kind, f"it ended with status {status}; the terminal says more")
        except OSError as error:
            failed = Problem(self.kind, f"it could not be started: {error}")
        finally:
            self._process = None
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


def _parsed(line: bytes) -> dict[str, Any]:
    """An event, or nothing: programs may print other things."""
    try:
        event = json.loads(line)
    except ValueError:
        return {}
    return event if isinstance(event, dict) else {}
