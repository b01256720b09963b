"""The text of an OpenSCAD file: what in it is code, what is a comment, and how values are written."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from typing import Any

_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"?|//[^\n]*|/\*.*?(?:\*/|\Z)', re.DOTALL)
_FILE = re.compile(r"\b(?:include|use)\s*<([^>\n]+)>|\b(?:import|surface)\s*\([^;]*?\"([^\"\n]+)\"")


@dataclass(frozen=True)
class Comment:
    """A comment.

    Attributes:
        start: where it begins in the text.
        text: what it says.
        block: whether it stands between ``/*`` and ``*/``.
    """

    start: int
    text: str
    block: bool


@dataclass(frozen=True)
class Text:
    """A file's text taken apart.

    Attributes:
        code: the text with blanks in the place of comments; what stands where stays there.
        bare: the same with blanks inside strings, too.
        comments: in their order.
    """

    code: str
    bare: str
    comments: tuple[Comment, ...]

    @classmethod
    def of(cls, text: str) -> Text:
        comments: list[Comment] = []

        def without_comment(match: re.Match[str]) -> str:
            found = match[0]
            if found.startswith('"'):
                return found
            block = found.startswith("/*")
            comments.append(Comment(match.start(), found[2:].removesuffix("*/") if block else found[2:], block))
            return _blank(found)

        code = _TOKEN.sub(without_comment, text)
        bare = _TOKEN.sub(lambda match: f'"{_blank(match[0][1:])}', code)
        return cls(code, bare, tuple(comments))

    def line(self, place: int) -> int:
        """The number of the line of a place in the text, from 1."""
        return self.code.count("\n", 0, place) + 1

    def calls(self, name: str, arguments: int) -> Iterator[int]:
        """The lines of the calls of a function with so many arguments."""
        for match in re.finditer(rf"\b{name}\s*\(", self.bare):
            depth, commas = 0, 0
            for character in self.bare[match.end() - 1 :]:
                depth += (character in "([{") - (character in ")]}")
                commas += character == "," and depth == 1
                if not depth:
                    break
            if commas + 1 == arguments:
                yield self.line(match.start())

    @property
    def files(self) -> tuple[str, ...]:
        """What it includes, uses and imports, as it names it, each once."""
        named = (match for match in _FILE.finditer(self.code) if self.bare[match.start()].strip())
        return tuple(dict.fromkeys(match[1] or match[2] for match in named))


def literal(value: Any) -> str:
    """A value as OpenSCAD writes it; its undef stands for None."""
    if isinstance(value, Enum):
        value = value.name
    if value is None:
        return "undef"
    if isinstance(value, tuple | list):
        return f"[{', '.join(map(literal, value))}]"
    known = value if isinstance(value, str | bool | int | float) else str(value)
    return json.dumps(known, ensure_ascii=False)


def _blank(text: str) -> str:
    return re.sub(r"[^\n]", " ", text)
