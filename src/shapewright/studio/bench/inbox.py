"""Requests to the bench that wait, in the order in which they are served."""

from __future__ import annotations

import threading
from collections import deque

from shapewright.studio.bench import messages


class Inbox:
    """Filled by one thread, emptied by another.

    Of evaluations only each client's newest counts; they come before fetches, all other requests before them. A new
    procedure sets ``interrupt``, so that nobody waits for the old one; taking it up clears that.
    """

    def __init__(self, interrupt: threading.Event) -> None:
        self._interrupt = interrupt
        self._arrived = threading.Condition()
        self._live: dict[int, messages.Live] = {}
        self._others: deque[messages.Request] = deque()

    def put(self, request: messages.Request) -> None:
        with self._arrived:
            if isinstance(request, messages.Live):
                self._live.pop(request.client, None)
                self._live[request.client] = request
            else:
                if isinstance(request, messages.Load):
                    self._others = deque(other for other in self._others if not isinstance(other, messages.Load))
                self._others.append(request)
            if isinstance(request, messages.Load | messages.End):
                self._interrupt.set()
            self._arrived.notify()

    @property
    def waiting(self) -> bool:
        """Whether there is a request."""
        return bool(self._live or self._others)

    @property
    def outdated(self) -> bool:
        """Whether what is being answered is no longer what anyone waits for."""
        return bool(self._live) or any(
            isinstance(request, messages.Load | messages.End) for request in list(self._others)
        )

    def take(self, wait: bool) -> messages.Request | None:
        """The next request; without one wait for it, or return None."""
        with self._arrived:
            while wait and not self.waiting:
                self._arrived.wait()
            if self._live and (not self._others or isinstance(self._others[0], messages.Fetch)):
                return self._live.pop(next(iter(self._live)))
            request = self._others.popleft() if self._others else None
            if isinstance(request, messages.Load):
                self._interrupt.clear()
            return request
