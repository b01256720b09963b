"""The bench, seen from the server: started, started again when it dies, asked, and listened to."""

from __future__ import annotations

import asyncio
import itertools
import time
from collections.abc import Callable
from typing import Any

from shapewright.studio.bench.messages import (
    Answer,
    Answered,
    Fetch,
    FetchKind,
    LiveMessage,
    News,
    Ready,
    Reply,
    Request,
)
from shapewright.studio.project.workspace import Missing
from shapewright.studio.wire.changes import BenchState
from shapewright.studio.wire.child import Child, Frame, on_this_loop
from shapewright.studio.wire.values import Slug

_PROGRAM = "shapewright.studio.bench.program"
_REPLY_SECONDS = 60.0
_SOON, _OFTEN = 5.0, 3


class BenchError(Exception):
    """The bench cannot answer; the message says why."""


class BenchProcess:
    """A bench that is always there, or soon again.

    heard: called with every message for the session, and its payload.
    answered: called with a page's number, a message for it or None, and a payload.
    changed: called whenever ``state`` does; a bench that has become ready knows nothing.
    """

    def __init__(
        self,
        heard: Callable[[News, bytes], object],
        answered: Callable[[int, LiveMessage | None, bytes], object],
        changed: Callable[[], object],
    ) -> None:
        self._heard, self._answered, self._changed = heard, answered, changed
        self.state: BenchState = "starting"
        self._child: Child | None = None
        self._replies: dict[int, asyncio.Future[tuple[Reply, bytes]]] = {}
        self._numbers = itertools.count(1)

    async def run(self) -> None:
        """Keep a bench going until cancelled. Raises BenchError when it dies again and again as soon as it starts."""
        hasty = 0
        while hasty < _OFTEN:
            started = time.monotonic()
            frames: asyncio.Queue[Frame | None] = asyncio.Queue()
            child = Child(_PROGRAM, on_this_loop(frames.put_nowait), Answer)
            try:
                while frame := await frames.get():
                    self._hear(child, *frame)
            finally:
                self._child = None
                await asyncio.shield(asyncio.to_thread(child.end))
            for reply in self._replies.values():
                if not reply.done():
                    reply.set_exception(BenchError("the bench had to start again; ask once more"))
            self._replies.clear()
            hasty = hasty + 1 if time.monotonic() - started < _SOON else 0
            self._change("restarting")
        raise BenchError(f"the bench process ended {_OFTEN} times as soon as it had started; the terminal says more")

    def _hear(self, child: Child, message: Answer, payload: bytes) -> None:
        match message:
            case Ready():
                self._child = child
                self._change("ready")
            case Answered():
                self._answered(message.client, message.message, payload)
            case Reply():
                reply = self._replies.pop(message.request, None)
                if reply and not reply.done():
                    reply.set_result((message, payload))
            case _:
                self._heard(message, payload)

    def _change(self, state: BenchState) -> None:
        self.state = state
        self._changed()

    def ask(self, request: Request) -> None:
        """Send a request; without a bench it is lost, and ``changed`` will say when there is one again."""
        if self._child:
            self._child.send(request)

    async def fetch(self, slug: Slug | None, what: FetchKind, **details: Any) -> tuple[Any, bytes]:
        """A message about a reference, and a payload; details: see Fetch.

        Raises BenchError, Missing where there is no such thing.
        """
        if not self._child:
            raise BenchError("the bench is starting; ask again in a moment")
        number = next(self._numbers)
        self._replies[number] = reply = asyncio.get_running_loop().create_future()
        self.ask(Fetch(request=number, slug=slug, what=what, **details))
        try:
            answer, payload = await asyncio.wait_for(reply, _REPLY_SECONDS)
        except TimeoutError as error:
            raise BenchError("the bench did not answer in time") from error
        finally:
            self._replies.pop(number, None)
        if answer.error is not None:
            raise Missing(answer.error)
        return answer.message, payload
