"""The bench, seen from the server: started, started again when it dies, asked, and listened to."""

from __future__ import annotations

import asyncio
import itertools
import time
from collections.abc import Callable
from typing import Any

from shapewright.studio.project.workspace import Missing
from shapewright.studio.wire.child import Child, Frame, on_this_loop

_PROGRAM = "shapewright.studio.bench.program"
_REPLY_SECONDS = 60.0
_SOON, _OFTEN = 5.0, 3
Message = dict[str, Any]


class BenchError(Exception):
    """The bench cannot answer; the message says why."""


class BenchProcess:
    """A bench that is always there, or soon again.

    heard: called with every message and payload for the session. live: with a client's number, a message or None, and a
    payload. started: after every start, when there is everything to tell it anew. lost: when it died.
    """

    def __init__(
        self,
        heard: Callable[[Message, bytes], object],
        live: Callable[[int, Message | None, bytes], object],
        started: Callable[[], object],
        lost: Callable[[], object],
    ) -> None:
        self._heard, self._live, self._started, self._lost = heard, live, started, lost
        self._child: Child | None = None
        self._replies: dict[int, asyncio.Future[tuple[Message, bytes]]] = {}
        self._numbers = itertools.count(1)

    @property
    def ready(self) -> bool:
        return self._child is not None

    async def run(self) -> None:
        """Keep a bench going until cancelled. Raises BenchError when it dies again and again as soon as it starts."""
        hasty = 0
        while hasty < _OFTEN:
            begun = time.monotonic()
            frames: asyncio.Queue[Frame | None] = asyncio.Queue()
            child = Child(_PROGRAM, on_this_loop(frames.put_nowait))
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
            hasty = hasty + 1 if time.monotonic() - begun < _SOON else 0
            self._lost()
        raise BenchError(f"the bench process ended {_OFTEN} times as soon as it had started; the terminal says more")

    def _hear(self, child: Child, envelope: Message, payload: bytes) -> None:
        message = envelope["message"]
        if envelope["to"] == "live":
            self._live(envelope["client"], message, payload)
        elif envelope["to"] == "reply":
            reply = self._replies.pop(envelope["request"], None)
            if reply and not reply.done():
                reply.set_result((message, payload))
        elif message["type"] == "ready":
            self._child = child
            self._started()
        else:
            self._heard(message, payload)

    def ask(self, request: Message) -> None:
        """Send a request; without a bench it is lost, and ``started`` will say when there is one again."""
        if self._child:
            self._child.send(request)

    async def fetch(self, request: Message) -> tuple[Message, bytes]:
        """The answer to a request of kind ``fetch``. Raises BenchError, Missing where there is no such thing."""
        if not self.ready:
            raise BenchError("the bench is starting; ask again in a moment")
        number = next(self._numbers)
        self._replies[number] = reply = asyncio.get_running_loop().create_future()
        self.ask({**request, "do": "fetch", "request": number})
        try:
            message, payload = await asyncio.wait_for(reply, _REPLY_SECONDS)
        except TimeoutError as error:
            raise BenchError("the bench did not answer in time") from error
        finally:
            self._replies.pop(number, None)
        if "error" in message:
            raise Missing(message["error"])
        return message, payload
