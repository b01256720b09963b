"""The vertices and triangles in the XML of a model, read as blocks of numbers.

A million triangles are a million elements, which a parser of XML takes 5 s for; here they take half a second.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.text import numbers, shown
from shapewright.shapes import Floats, Ints

_CLOSINGS = {b"<!--": b"-->", b"<![CDATA[": b"]]>", b"<?": b"?>"}
_NO_ELEMENT = re.compile(b"|".join(map(re.escape, _CLOSINGS)))
_ROOT = re.compile(rb"\s*<((?:[\w.-]+:)?)\w")
_DIGITS = b"0123456789"
_NUMBER = _DIGITS + b"+-.eE"
_SPACE = b" \t\r\n"
_PIECE = 2**22
"""Bytes of text that are read at once."""


@dataclass(frozen=True, eq=False)
class Cut:
    """A model's text without its numbers.

    Attributes:
        outline: the XML, in which every element of vertices or triangles is empty and has one attribute, its number.
        prefix: of the root's namespace, with a colon, or empty.
        text: the text with the numbers.
        blocks: where in it the content of each of those elements begins and ends.
    """

    outline: bytes
    prefix: bytes
    text: bytes
    blocks: list[tuple[int, int]]

    def rows(self, block: int, name: bytes, attributes: Sequence[bytes]) -> Floats:
        """The numbers (N, A) in the attributes of each element of a name. Raises UnreadableError where one lacks."""
        pieces = _pieces(self.text, *self.blocks[block])
        tables = [_rows(piece, self.prefix + name, attributes) for piece in pieces]
        return np.concatenate(tables) if tables else np.empty((0, len(attributes)))


def cut(text: bytes) -> Cut:
    """Take comments, and the content of vertices and triangles, out of an XML text in UTF-8."""
    text = _elements_only(text)
    root = _ROOT.match(text)
    prefix = root[1] if root else b""
    starts = re.compile(rb"<%b(vertices|triangles)(?:\s[^<>]*)?/?>" % re.escape(prefix))
    pieces, blocks, at = list[bytes](), list[tuple[int, int]](), 0
    while found := starts.search(text, at):
        end, close = found.end(), found.end() - 1
        if not found[0].endswith(b"/>"):
            end = text.find(b"</" + prefix + found[1], found.end())
            close = text.find(b">", end)
            if end < 0 or close < 0:
                raise UnreadableError(f"cut short: its {found[1].decode()} do not end")
        pieces += [text[at : found.start()], b'<%b%b block="%d"/>' % (prefix, found[1], len(blocks))]
        blocks.append((found.end(), end))
        at = close + 1
    return Cut(b"".join([*pieces, text[at:]]), prefix, text, blocks)


def _elements_only(text: bytes) -> bytes:
    """The text without comments, CDATA sections and processing instructions."""
    pieces, at = list[bytes](), 0
    while found := _NO_ELEMENT.search(text, at):
        end = text.find(_CLOSINGS[found[0]], found.end())
        if end < 0:
            raise UnreadableError("cut short: a comment, or the like, does not end")
        pieces.append(text[at : found.start()])
        at = end + len(_CLOSINGS[found[0]])
    return b"".join([*pieces, text[at:]])


def _pieces(text: bytes, start: int, stop: int) -> Iterator[bytes]:
    while start < stop:
        end = text.find(b">", start + _PIECE, stop) + 1 or stop
        yield text[start:end]
        start = end


def _rows(piece: bytes, name: bytes, attributes: Sequence[bytes]) -> Floats | Ints:
    bare = piece.replace(b"<%b " % name, b"")
    letters = [attribute.rstrip(_DIGITS) for attribute in attributes]
    # The digits in names such as v1 are read among the numbers, and compared afterwards.
    digits = [int(each[len(rest) :]) for each, rest in zip(attributes, letters, strict=True) if each != rest]
    number = _DIGITS if digits else _NUMBER
    kept = bare.translate(None, number + _SPACE)
    pattern = b"".join(b'%b=""' % each for each in letters) + b"/>"
    count = len(kept) // len(pattern)
    if kept == pattern * count and b'""' not in bare:
        words = bare.translate(bytes(byte if byte in number else ord(" ") for byte in range(256)))
        values = np.fromstring(words, np.int64, sep=" ") if digits and count else numbers(words)
        if len(values) == count * (len(attributes) + len(digits)):
            table = values.reshape(count, -1)
            if not digits or (table[:, ::2] == digits).all():
                return table[:, 1::2] if digits else table
    return _rows_in_any_order(piece, name, attributes)


def _rows_in_any_order(piece: bytes, name: bytes, attributes: Sequence[bytes]) -> Floats:
    """The same for elements with other attributes, other orders and other quotes."""
    elements = re.findall(rb"<%b(\s[^<>]*)>" % re.escape(name), piece)
    text = b"\n".join(elements)
    columns = []
    for attribute in attributes:
        found = re.findall(rb"\s%b\s*=\s*(?:\"([^\"<>]*)\"|'([^'<>]*)')" % attribute, text)
        if len(found) != len(elements):
            odd = [each for each in elements if len(re.findall(rb"\s%b\s*=" % attribute, each)) != 1]
            raise UnreadableError(f"broken: {shown(b'<' + name + (odd or elements)[0])} has no {attribute.decode()}")
        words = [a or b for a, b in found]
        if b"" in words:
            raise UnreadableError(f"broken: {name.decode()} with an empty {attribute.decode()}")
        columns.append(numbers(b" ".join(words)))
    if any(len(column) != len(elements) for column in columns):
        raise UnreadableError(f"broken: {name.decode()} with two numbers in one attribute")
    return np.stack(columns, axis=1)
