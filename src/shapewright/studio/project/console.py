"""What the procedure and the jobs have printed, the newest lines of it."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable

from shapewright.studio.wire.values import Slug
from shapewright.studio.wire.work import Line, Speaker

_LINES, _LETTERS = 1000, 2000
"""Lines that are kept, and letters of a line: a page shows as many without delay."""
_GATHERED = 0.15
"""Seconds for which lines are gathered into one message."""


class Console:
    """The lines, the oldest first; each has a number, one more than the one before. told: gets those that are new."""

    def __init__(self, told: Callable[[list[Line]], object] = lambda _: None) -> None:
        self._told = told
        self._telling: asyncio.TimerHandle | None = None
        self._lines: deque[Line] = deque(maxlen=_LINES)
        self._sent = 0
        self._count = 0

    @property
    def lines(self) -> list[Line]:
        return list(self._lines)

    def add(self, speaker: Speaker, slug: Slug | None, text: str) -> bool:
        """Add the lines of a text; returns whether there are any.

        slug: the reference whose replica was built, where it is known.
        """
        found = [line.rstrip() for line in text.splitlines() if line.strip()]
        for line in found:
            self._count += 1
            shown = line if len(line) <= _LETTERS else f"{line[:_LETTERS]}…"
            self._lines.append(Line(number=self._count, speaker=speaker, slug=slug, text=shown))
        return bool(found)

    def news(self) -> list[Line]:
        """The lines since this was asked last."""
        before, self._sent = self._sent, self._count
        return [line for line in self._lines if line.number > before]

    def say(self, speaker: Speaker, text: str, slug: Slug | None = None) -> None:
        """Add the lines of a text, and tell them soon: a sweep prints many times in a second."""
        if self.add(speaker, slug, text) and self._telling is None:
            self._telling = asyncio.get_running_loop().call_later(_GATHERED, self._tell)

    def _tell(self) -> None:
        self._telling = None
        self._told(self.news())
