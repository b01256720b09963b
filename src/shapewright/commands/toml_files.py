"""TOML files of authors: their values, and the line that each stands in, so that a mistake is told with its place."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shapewright.procedures import Place, ProcedureError

_HEADER = re.compile(r"\s*\[\[?([^\[\]]+)\]\]?\s*(#.*)?$")
_KEY = re.compile(r"""\s*((?:[\w-]+|"[^"]*"|'[^']*')(?:\s*\.\s*(?:[\w-]+|"[^"]*"|'[^']*'))*)\s*=""")
_AT = re.compile(r" \(at line (\d+), column \d+\)")
Keys = tuple[str, ...]


@dataclass(frozen=True)
class TomlFile:
    """A TOML file.

    Attributes:
        path: of the file.
        text: what stands in it.
        values: the same, parsed.
    """

    path: Path
    text: str
    values: dict[str, Any]

    def error(self, keys: Keys, message: str) -> ProcedureError:
        """That a key has a wrong value. keys: the names of the tables around it, and its own."""
        return ProcedureError(f"{'.'.join(keys)}: {message}" if keys else message, self.place(keys))

    def place(self, keys: Keys) -> Place:
        """The line of a key, or of the innermost table around it that has a line."""
        lines = self.text.splitlines()
        number = next((found for end in range(len(keys), 0, -1) if (found := self._line(keys[:end]))), None)
        return Place(str(self.path), number, lines[number - 1].strip() if number else None)

    def _line(self, keys: Keys) -> int | None:
        table: Keys = ()
        for number, line in enumerate(self.text.splitlines(), 1):
            if header := _HEADER.match(line):
                table = _names(header[1])
                if table[: len(keys)] == keys:
                    return number
            elif (key := _KEY.match(line)) and (*table, *_names(key[1]))[: len(keys)] == keys:
                return number
        return None


def read_toml(path: Path) -> TomlFile:
    """Read a file. Raises ProcedureError with the line where it is no TOML."""
    try:
        text = path.read_text("utf-8")
        return TomlFile(path, text, tomllib.loads(text))
    except OSError as error:
        raise ProcedureError(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ProcedureError(f"{path}: it is no text in UTF-8") from error
    except tomllib.TOMLDecodeError as error:
        line = int(match[1]) if (match := _AT.search(str(error))) else len(text.splitlines())  # "at end of document"
        raise ProcedureError(f"no TOML: {_AT.sub('', str(error))}", _place(path, text, line)) from error


def _place(path: Path, text: str, line: int | None) -> Place:
    lines = text.splitlines()
    return Place(str(path), line, lines[line - 1].strip() if line and line <= len(lines) else None)


def _names(dotted: str) -> Keys:
    """The names of a dotted key: ``a."b c"`` is ("a", "b c")."""
    try:
        inner: Any = tomllib.loads(f"{dotted} = 0")
    except tomllib.TOMLDecodeError:
        return (dotted,)
    names = []
    while isinstance(inner, dict):
        ((name, inner),) = inner.items()
        names.append(name)
    return tuple(names)
