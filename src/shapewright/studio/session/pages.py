"""The pages that look at the studio, and what is sent to them."""

from __future__ import annotations

import asyncio
import itertools

from shapewright.studio.wire.values import Message, encode

MOST_WAITING = 2000


class Page:
    """One connection. Messages wait in a queue; None at its end says that the page is too slow and is given up."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.queue: asyncio.Queue[str | bytes | None] = asyncio.Queue()
        self.lost = False

    def send(self, message: str | bytes) -> None:
        """Text, or a binary message."""
        if self.lost:
            return
        if self.queue.qsize() >= MOST_WAITING:
            self.lost = True
            self.queue.put_nowait(None)
            return
        self.queue.put_nowait(message)


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
        """To one page; to nobody when it is closed."""
        if number in self._pages:
            self._pages[number].send(message if isinstance(message, bytes) else encode(message).decode())

    def publish(self, message: Message) -> None:
        """To all."""
        if self._pages:
            text = encode(message).decode()
            for page in self._pages.values():
                page.send(text)
