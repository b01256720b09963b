"""The parameters of an OpenSCAD file as the Customizer shows them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from shapewright.procedures.openscad.annotations import NUMBER, Literally, hint, number
from shapewright.procedures.openscad.text import Text

_STRING = r'"(?:[^"\\]|\\.)*"'
_VECTOR = rf"\[\s*{NUMBER}(?:\s*,\s*{NUMBER})*\s*,?\s*\]"
_ASSIGNMENT = re.compile(rf"(?:^|(?<=;))[ \t]*(\w+)\s*=\s*(true|false|{NUMBER}|{_STRING}|{_VECTOR})\s*;", re.MULTILINE)
_SECTION = re.compile(r"\s*\[+\s*(.*?)\s*\]+\s*", re.DOTALL)
_MOST = 4
"""Values of a vector that the Customizer shows."""


class AnnotationError(ValueError):
    """An annotation is no space. line: its number, from 1."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.line = line


@dataclass(frozen=True)
class Setting:
    """A value at the top of a file that can be another.

    Attributes:
        name: of the variable.
        value: what the file gives it.
        hint: which values it may have, as the annotation of a Python signature; None where it is held.
        description: the comment line above it, and what its options are called.
        line: its number, from 1.
    """

    name: str
    value: Literally
    hint: Any
    description: str
    line: int


def settings(text: str) -> tuple[Setting, ...]:
    """Those that the Customizer shows, in the order of the file.

    As there, they stand before the first ``{``, are literals, and are in no section ``[Hidden]``. Special variables,
    such as ``$fn``, are none. Raises AnnotationError for an annotation that is no space.
    """
    parts = Text.of(text)
    end = parts.bare.find("{")
    found: dict[str, Setting] = {}
    for match in _ASSIGNMENT.finditer(parts.code, 0, len(text) if end < 0 else end):
        if _section(parts, match.start(1)).lower() == "hidden" or not parts.bare[match.start(1)].strip():
            continue
        line = parts.line(match.start(1))
        value = _value(match[2])
        try:
            spelled, labels = hint(value, _behind(parts, text, match.end()))
        except ValueError as error:
            raise AnnotationError(f"{match[1]}: {error}", line) from error
        said = "; ".join(part for part in (_above(parts, text, match.start(1)), labels) if part)
        if not isinstance(value, tuple) or len(value) <= _MOST:
            found[match[1]] = Setting(match[1], value, spelled, said, line)  # the last one counts
    return tuple(found.values())


def _value(text: str) -> Literally:
    if text in ("true", "false"):
        return text == "true"
    if text.startswith('"'):
        return re.sub(r"\\(.)", r"\1", text[1:-1])
    if text.startswith("["):
        return tuple(number(part) for part in text[1:-1].split(",") if part.strip())
    return number(text)


def _section(parts: Text, place: int) -> str:
    """The name of the section that a place is in."""
    return next(reversed([name for start, name in _sections(parts) if start < place]), "")


def _sections(parts: Text) -> Iterator[tuple[int, str]]:
    for comment in parts.comments:
        if comment.block and (match := _SECTION.fullmatch(comment.text)):
            yield comment.start, match[1]


def _behind(parts: Text, text: str, end: int) -> str:
    """The comment behind an assignment, on its line; empty where there is none."""
    comment = next((one for one in parts.comments if one.start >= end), None)
    return comment.text if comment and not comment.block and not text[end : comment.start].strip(" \t") else ""


def _above(parts: Text, text: str, start: int) -> str:
    """The comment line above an assignment; empty where that line is another one."""
    line = text.rfind("\n", 0, start)
    before = text.rfind("\n", 0, max(line, 0)) + 1
    comment = next((one for one in parts.comments if before <= one.start < line), None)
    alone = comment is not None and not comment.block and not text[before : comment.start].strip()
    return comment.text.strip().lstrip("/").strip() if comment and alone else ""
