"""The pages that look at the studio, and what is sent to them."""

from __future__ import annotations

import asyncio
import itertools
import json
from collections.abc import Mapping
from typing import Any

MOST_WAITING = 2000
Message = Mapping[str, Any]


class Page:
    """One connection. Messages wait in a queue; None at its end says that the page is too slow and is given up."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.queue: asyncio.Queue[str | bytes | None] = asyncio.Queue()
        self.lost = False

    def send(self, message: Message | bytes) -> None:
        if self.lost:
            return
        if self.queue.qsize() >= MOST_WAITING:
            self.lost = True
            self.queue.put_nowait(None)
            return
        self.queue.put_nowait(message if isinstance(message, bytes) else encode(message))


class Pages:
    """All connections, by number."""

    def __init__(self) -> None:
        self._pages: dict[int, Page] = {}
        self._numbers = itertools.count(1)

    def open(self) -> Page:
        page = Page(next(self._numbers))
        self._pages[page.number] = page
        return page

    def close(self, page: Page) -> None:
        self._pages.pop(page.number, None)

    def send(self, number: int, message: Message | bytes) -> None:
        """To one page; to nobody when it has gone."""
        if number in self._pages:
            self._pages[number].send(message)

    def publish(self, kind: str, **content: Any) -> None:
        """A message of this type to all."""
        if self._pages:
            text = {"type": kind, **content}
            for page in self._pages.values():
                page.send(text)


def encode(message: Message) -> str:
    """As JSON text. Raises ValueError for a number that is not finite."""
    return json.dumps(message, allow_nan=False, separators=(",", ":"))
