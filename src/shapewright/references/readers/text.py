"""Text of mesh files: what encoding it has, its lines, and its numbers, read fast and strictly."""

from __future__ import annotations

import codecs
import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.shapes import Floats, Ints

_MARKS = {
    codecs.BOM_UTF32_LE: "utf-32-le",  # before UTF-16, whose mark it begins with
    codecs.BOM_UTF32_BE: "utf-32-be",
    codecs.BOM_UTF16_LE: "utf-16-le",
    codecs.BOM_UTF16_BE: "utf-16-be",
}
PADDING = b"\0\x1a \t\r\n\v\f"
"""Bytes that programs write behind the end of a text: zeros, the end-of-file sign of DOS, white space."""
_BLOCK = 2**22  # bytes of text whose lines are held at once
LONG = 2**23
"""Bytes of a text from which kernels read it: they take half a second to load, as much as words take by numpy alone."""
_PIECE = 2**20  # bytes of text whose numbers are held at once
_WINDOWS = re.compile(rb"([-+]?)1\.#(INF|IND|QNAN|SNAN)0*", re.IGNORECASE)
"""What is not finite, as C libraries of Windows print it."""


def plain(data: bytes) -> bytes:
    """The text without its byte order mark; UTF-16 and UTF-32 become UTF-8.

    Text in any other encoding stays as it is. Raises UnreadableError for UTF-16 or UTF-32 that is broken.
    """
    if data.startswith(codecs.BOM_UTF8):
        return data[len(codecs.BOM_UTF8) :]
    mark, encoding = next(((mark, name) for mark, name in _MARKS.items() if data.startswith(mark)), (b"", ""))
    start = data[:64]
    if not encoding and len(start) >= 8 and b"\0" in start:
        even, odd = start[::2], start[1::2]
        if not any(odd) and all(even):
            encoding = "utf-16-le"
        elif not any(even) and all(odd):
            encoding = "utf-16-be"
    if not encoding:
        return data
    try:
        return data[len(mark) :].decode(encoding).encode()
    except UnicodeError as error:
        raise UnreadableError(f"broken: text in {encoding[:6].upper()} that cannot be decoded") from error


def utf8(data: bytes) -> bytes:
    """The text as UTF-8, without mark. Where it is none it counts as Latin-1, which older programs write in names."""
    text = plain(data)
    if text.isascii():
        return text
    try:
        text.decode()
    except UnicodeDecodeError:
        return text.decode("latin-1").encode()
    return text


def lines(text: bytes) -> Iterator[bytes]:
    """The lines of a text, without their ends; no more than a part of them is held at once."""
    sign, start = b"\n" if b"\n" in text else b"\r", 0
    while start < len(text):
        end = text.find(sign, start + _BLOCK) + 1 or len(text)
        yield from text[start:end].splitlines()
        start = end


@dataclass(frozen=True, eq=False)
class Rows:
    """The numbers of a text, line by line; a line without any is no row.

    Attributes:
        values: (N,) the numbers, one row after the other.
        starts: (R + 1,) where each row starts among the values; the last is N.
    """

    values: Floats
    starts: Ints

    def __len__(self) -> int:
        return len(self.starts) - 1

    @property
    def lengths(self) -> Ints:
        """(R,): how many numbers each row has."""
        return np.diff(self.starts)


def rows(text: bytes) -> Rows:
    """The numbers of every line. Raises UnreadableError for a word that is no number."""
    if len(text) < LONG:
        return _rows(text)
    pieces: list[Rows] = []
    for start, end in _pieces(text):
        piece = text[start:end]
        found = _fast_rows(piece) if end - start <= 4 * _PIECE else None
        pieces.append(found or _rows(piece))
    firsts = np.cumsum([0, *(len(piece.values) for piece in pieces)])
    starts = [piece.starts[:-1] + first for piece, first in zip(pieces, firsts[:-1], strict=True)]
    return Rows(np.concatenate([piece.values for piece in pieces]), np.concatenate([*starts, firsts[-1:]]))


def _pieces(text: bytes) -> Iterator[tuple[int, int]]:
    """Where each begins and ends: lines, about _PIECE bytes of them, or one that is longer."""
    sign, start = b"\n" if b"\n" in text else b"\r", 0
    while start < len(text):
        end = text.find(sign, start + _PIECE) + 1 or len(text)
        yield start, end
        start = end


def _fast_rows(text: bytes) -> Rows | None:
    from shapewright.references.readers.kernels.words import numbers_of_rows

    found = numbers_of_rows(np.frombuffer(text, np.uint8))
    return Rows(found[0], np.append(found[1], len(found[0]))) if found else None


def _rows(text: bytes) -> Rows:
    letters = np.frombuffer(text, np.uint8)
    gaps = letters <= ord(" ")
    begins = ~gaps
    begins[1:] &= gaps[:-1]
    words = np.flatnonzero(begins)
    ends = np.flatnonzero((letters == ord("\n")) | (letters == ord("\r")))
    starts = np.concatenate([[-1], np.searchsorted(words, np.concatenate([[0], ends])), [len(words)]])
    starts = starts[1:][starts[1:] != starts[:-1]]  # they are in order; lines without words repeat one
    values = numbers(text)
    if len(values) != len(words):
        raise UnreadableError("broken: control characters among its numbers")
    return Rows(values, starts)


def numbers(text: bytes) -> Floats:
    """The numbers of a text, between white space. Raises UnreadableError for a word that is none.

    Windows' words for what is not finite, such as ``1.#IND``, are numbers that are not finite.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)
        try:
            return np.fromstring(text, dtype=np.float64, sep=" ") if text.strip() else np.empty(0)
        except (DeprecationWarning, ValueError):  # text that it reads a part of; which of both is numpy's to say
            return np.array([_number(word) for word in text.split()], dtype=np.float64)


def _number(word: bytes) -> float:
    odd = _WINDOWS.fullmatch(word)
    if odd:
        return float(odd[1] + b"inf") if odd[2].upper() == b"INF" else float("nan")
    try:
        if b"_" not in word:  # which Python allows between digits
            return float(word)
    except ValueError:
        pass
    comma = "; decimals need a point" if b"," in word else ""
    raise UnreadableError(f"broken: {shown(word)} is no number{comma}")


def shown(text: bytes) -> str:
    """A piece of a file for a message, in quotes, its first line and 60 bytes of it at most."""
    first = (text.splitlines() or [b""])[0]
    return repr(first[:60].decode(errors="replace"))
