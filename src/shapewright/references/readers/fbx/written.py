"""The text form of FBX: names with values and, in braces, the nodes below."""

from __future__ import annotations

import re

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.fbx.nodes import DEEPEST, Node, Value
from shapewright.references.readers.text import numbers, utf8

_NUMBER = rb"[-+]?(?:\d|\.\d)[\w.+#-]*|[-+]?(?:inf|nan)\b(?:\([^)]*\))?"
_SPACE = re.compile(rb"(?:\s+|;[^\r\n]*)*+")
_NAME = re.compile(rb"([A-Za-z_][\w|.-]*)[ \t]*:")
_VALUE = re.compile(
    rb'"(?P<text>[^"]*)"'
    rb"|\*[ \t]*(?P<count>\d+)"
    rb"|(?P<numbers>(?:%(n)s)(?:\s*+,\s*+(?:%(n)s))*+)"
    rb"|(?P<word>[A-Za-z_][\w.|-]*+(?![ \t]*:))" % {b"n": _NUMBER},
    re.IGNORECASE,
)
_INTEGER = re.compile(rb"[-+]?\d{1,19}")
_LISTED = 16
"""Numbers that are kept one by one; longer lists are arrays."""
_VERSION = re.compile(rb"^\s*;\s*FBX\s+(\d+)\.(\d+)\.(\d+)", re.MULTILINE)
_QUOTE = "&quot;"


def read_written(data: bytes) -> tuple[Node, int]:
    """The outermost nodes, in one, and the version. Raises UnreadableError, with the reason."""
    text = utf8(data)
    open_: list[tuple[str, list[Value], list[Node]]] = [("", [], [])]
    position = _skip(text, 0)
    while position < len(text):
        if text[position : position + 1] == b"}":
            if len(open_) == 1:
                raise UnreadableError(f"broken: a brace too many in line {_line(text, position)}")
            node = Node(*open_.pop())
            open_[-1][2].append(node)
            position = _skip(text, position + 1)
            continue
        named = _NAME.match(text, position)
        if named is None:
            raise UnreadableError(f"broken: line {_line(text, position)} is not understood")
        values, position = _values(text, named.end())
        position = _skip(text, position)
        name = named[1].decode("latin-1")
        if text[position : position + 1] == b"{":
            open_.append((name, values, []))
            position = _skip(text, position + 1)
            if len(open_) > DEEPEST:
                raise UnreadableError(f"its nodes are more than {DEEPEST} levels deep")
        else:
            open_[-1][2].append(Node(name, values, ()))
    if len(open_) > 1:
        raise UnreadableError("broken: cut short, a brace is not closed")
    top = Node(*open_[0])
    return top, _version(text, top)


def _skip(text: bytes, position: int) -> int:
    """Where white space and comments end."""
    found = _SPACE.match(text, position)
    return found.end() if found else position


def _values(text: bytes, position: int) -> tuple[list[Value], int]:
    """The values behind a name, and where they end: before a brace or the next name."""
    values: list[Value] = []
    while True:
        position = _skip(text, position)
        if text[position : position + 1] == b",":
            position += 1
            continue
        found = _VALUE.match(text, position)
        if found is None:
            return values, position
        position = found.end()
        if found["text"] is not None:
            values.append(found["text"].decode("utf-8", "surrogateescape").replace(_QUOTE, '"'))
        elif found["count"] is not None:
            values.append(int(found["count"]))
        elif found["word"] is not None:
            values.append(found["word"].decode("latin-1"))
        else:
            values.extend(_numbers(found["numbers"]))


def _numbers(text: bytes) -> list[Value]:
    if text.count(b",") >= _LISTED:
        return [numbers(text.replace(b",", b" "))]
    words = [word.strip() for word in text.split(b",")]
    return [int(word) if _INTEGER.fullmatch(word) else float(numbers(word)[0]) for word in words]


def _version(text: bytes, top: Node) -> int:
    """The version that the header tells, else the comment in the first line."""
    header = top.child("FBXHeaderExtension")
    told = None if header is None else header.child("FBXVersion")
    if told is not None and told.values and isinstance(told.values[0], int):
        return told.values[0]
    first = _VERSION.search(text[:1000])
    if first is None:
        raise UnreadableError("no FBX: neither its first line nor its header tells a version")
    return int(first[1]) * 1000 + int(first[2]) * 100 + int(first[3]) * 10


def _line(text: bytes, position: int) -> int:
    return text.count(b"\n", 0, position) + 1
