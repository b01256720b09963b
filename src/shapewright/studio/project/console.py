"""What the procedure and the jobs have printed, the newest lines of it."""

from __future__ import annotations

from collections import deque

from shapewright.studio.wire.values import Slug
from shapewright.studio.wire.work import Line, Speaker

_LINES, _LETTERS = 1000, 2000
"""Lines that are kept, and letters of a line: a page shows as many without delay."""


class Console:
    """The lines, the oldest first; each has a number, one more than the one before."""

    def __init__(self) -> None:
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
