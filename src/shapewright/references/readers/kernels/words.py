"""The words of long texts: numbers, lines of OBJ and facets of STL, as most programs write them.

A kernel takes what it is sure of and stops before anything else, which the caller reads word by word. A number of up to
15 digits and a power of ten up to 22 is exact in floating point, and so is the power; their product or quotient is
rounded once, so it is the number that Python reads (Clinger, "How to read floating point numbers accurately", 1990).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Letters = NDArray[np.uint8]
ODD, LINE = 1, 2
"""Why ``obj_lines`` stops: at a line that it cannot read, or at one of another keyword."""
_POWERS = 10.0 ** np.arange(23)
_FACET = tuple(np.frombuffer(word, np.uint8) for word in (b"facet", b"normal", b"outer", b"loop", b"vertex"))
_END = tuple(np.frombuffer(word, np.uint8) for word in (b"endloop", b"endfacet"))


def numbers_of_rows(letters: Letters) -> tuple[NDArray[np.float64], NDArray[np.int64]] | None:
    """The numbers (N,) of lines, and where each line that has some begins among them; None where a word is odd."""
    values, starts = np.empty(len(letters) // 2 + 1), np.empty(len(letters) // 2 + 1, dtype=np.int64)
    count, rows = _numbers(letters, values, starts, _POWERS)
    return None if count < 0 else (values[:count].copy(), starts[:rows].copy())


def obj_lines(
    letters: Letters, at: int, stop: int, above: int
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64], int, int]:
    """Points (N, 3), corners and their counts of faces of lines; where it stops, and why: 0 at ``stop``, ODD or LINE.

    Args:
        letters: the text.
        at: where the first line begins.
        stop: where the last line ends.
        above: the vertices above, from which relative indices count. Corners count from 0.
    """
    size = stop - at
    points, corners = np.empty((size // 6 + 1, 3)), np.empty(size // 2 + 1, dtype=np.int64)
    counts = np.empty(size // 3 + 1, dtype=np.int64)
    n, c, f, at, why = _obj_lines(letters[:stop], at, above, points, corners, counts, _POWERS)
    return points[:n].copy(), corners[:c].copy(), counts[:f].copy(), at, why


def stl_facets(letters: Letters, at: int, room: NDArray[np.float64]) -> tuple[int, int]:
    """Put the corners of triangles into ``room`` (3 F, 3); how many there are, and the place behind the last."""
    count, at = _stl_facets(letters, at, room, _FACET, _END, _POWERS)
    return int(count), int(at)


def _kernel(function: Any) -> Any:
    return njit(cache=True, nogil=True)(function)


@_kernel
def _is_gap(letter):  # type: ignore[no-untyped-def]
    return letter == 32 or 9 <= letter <= 13


@_kernel
def _number(letters, at, powers):  # type: ignore[no-untyped-def]
    """A number, and where its word ends; -1 where that is none, or may be rounded."""
    end = len(letters)
    negative = False
    if at < end and (letters[at] == 45 or letters[at] == 43):
        negative = letters[at] == 45
        at += 1
    mantissa, digits, power = 0, 0, 0
    there = False
    while at < end and 48 <= letters[at] <= 57:
        mantissa = 10 * mantissa + letters[at] - 48
        digits += 1 if mantissa else 0
        there = True
        at += 1
        if digits > 15:
            return 0.0, -1
    if at < end and letters[at] == 46:
        at += 1
        while at < end and 48 <= letters[at] <= 57:
            mantissa = 10 * mantissa + letters[at] - 48
            digits += 1 if mantissa else 0
            power -= 1
            there = True
            at += 1
            if digits > 15:
                return 0.0, -1
    if not there:
        return 0.0, -1
    if at < end and (letters[at] == 101 or letters[at] == 69):
        at += 1
        down = False
        if at < end and (letters[at] == 45 or letters[at] == 43):
            down = letters[at] == 45
            at += 1
        exponent, first = 0, at
        while at < end and 48 <= letters[at] <= 57:
            exponent = 10 * exponent + letters[at] - 48
            at += 1
            if at - first > 3:
                return 0.0, -1
        if at == first:
            return 0.0, -1
        power += -exponent if down else exponent
    value = np.float64(mantissa)
    if mantissa != 0:
        if power < -22 or power > 22:
            return 0.0, -1
        value = value / powers[-power] if power < 0 else value * powers[power]
    return -value if negative else value, at


@_kernel
def _numbers(letters, values, starts, powers):  # type: ignore[no-untyped-def]
    count, rows, at, end = 0, 0, 0, len(letters)
    begins = True
    while at < end:
        letter = letters[at]
        if _is_gap(letter):
            begins = begins or letter == 10 or letter == 13
            at += 1
            continue
        value, at = _number(letters, at, powers)
        if at < 0 or (at < end and not _is_gap(letters[at])):
            return -1, 0
        if begins:
            starts[rows] = count
            rows += 1
            begins = False
        values[count] = value
        count += 1
    return count, rows


@_kernel
def _line_end(letters, at):  # type: ignore[no-untyped-def]
    while at < len(letters) and letters[at] != 10 and letters[at] != 13:
        at += 1
    return at


@_kernel
def _skipped(letters, at):  # type: ignore[no-untyped-def]
    """Behind blanks and tabs."""
    while at < len(letters) and (letters[at] == 32 or letters[at] == 9):
        at += 1
    return at


@_kernel
def _ends(letters, at):  # type: ignore[no-untyped-def]
    return at >= len(letters) or letters[at] == 10 or letters[at] == 13


@_kernel
def _obj_lines(letters, at, above, points, corners, counts, powers):  # type: ignore[no-untyped-def]
    n, c, f, end = 0, 0, 0, len(letters)
    while at < end:
        line = at
        at = _skipped(letters, at)
        if _ends(letters, at):
            at += 1
            continue
        keyword = letters[at]
        second = letters[at + 1] if at + 1 < end else 10
        third = letters[at + 2] if at + 2 < end else 10
        blank = second == 32 or second == 9
        if keyword == 35 or (keyword == 118 and (second == 116 or second == 110) and (third == 32 or third == 9)):
            at = _line_end(letters, at) + 1  # a comment, vt or vn
        elif keyword == 115 and blank:
            at = _line_end(letters, at) + 1
        elif keyword == 118 and blank:
            at = _skipped(letters, at + 1)
            held = 0
            while not _ends(letters, at):
                value, at = _number(letters, at, powers)
                if at < 0 or not (_ends(letters, at) or letters[at] == 32 or letters[at] == 9):
                    return n, c, f, line, 1
                if held < 3:
                    points[n, held] = value
                held += 1
                at = _skipped(letters, at)
            if held < 3:
                return n, c, f, line, 1
            n += 1
            at += 1
        elif keyword == 102 and blank:
            at = _skipped(letters, at + 1)
            held = 0
            while not _ends(letters, at):
                negative = letters[at] == 45
                at += 1 if negative else 0
                index, first = 0, at
                while at < end and 48 <= letters[at] <= 57 and at - first < 15:
                    index = 10 * index + letters[at] - 48
                    at += 1
                if at == first or not (
                    _ends(letters, at) or letters[at] == 32 or letters[at] == 9 or letters[at] == 47
                ):
                    return n, c, f, line, 1
                while not _ends(letters, at) and letters[at] != 32 and letters[at] != 9:
                    if letters[at] < 45 or letters[at] > 57:  # of texture and normal
                        return n, c, f, line, 1
                    at += 1
                corners[c + held] = above + n - index if negative and index else index - 1
                held += 1
                at = _skipped(letters, at)
            if held == 0:
                return n, c, f, line, 1
            counts[f] = held
            c += held
            f += 1
            at += 1
        else:
            return n, c, f, line, 2
    return n, c, f, min(at, end), 0


@_kernel
def _word(letters, at, word):  # type: ignore[no-untyped-def]
    """Behind white space and a word, in small or capital letters; -1 where that is not there."""
    end = len(letters)
    while at < end and _is_gap(letters[at]):
        at += 1
    if at + len(word) > end:
        return -1
    for i in range(len(word)):
        if letters[at + i] | 32 != word[i]:
            return -1
    at += len(word)
    return at if at == end or _is_gap(letters[at]) else -1


@_kernel
def _stl_facets(letters, at, points, facet, ends, powers):  # type: ignore[no-untyped-def]
    count, end = 0, len(letters)
    while 3 * count + 3 <= len(points):
        here = _word(letters, at, facet[0])
        here = _word(letters, here, facet[1]) if here >= 0 else -1
        for _ in range(3):
            if here < 0:
                break
            while here < end and _is_gap(letters[here]):
                here += 1
            _, here = _number(letters, here, powers)
            if here >= 0 and not (here < end and _is_gap(letters[here])):
                here = -1
        here = _word(letters, here, facet[2]) if here >= 0 else -1
        here = _word(letters, here, facet[3]) if here >= 0 else -1
        for corner in range(3):
            here = _word(letters, here, facet[4]) if here >= 0 else -1
            for axis in range(3):
                if here < 0:
                    break
                while here < end and _is_gap(letters[here]):
                    here += 1
                value, here = _number(letters, here, powers)
                if here >= 0 and not (here < end and _is_gap(letters[here])):
                    here = -1
                points[3 * count + corner, axis] = value
        here = _word(letters, here, ends[0]) if here >= 0 else -1
        here = _word(letters, here, ends[1]) if here >= 0 else -1
        if here < 0:
            return count, at
        at = here
        count += 1
    return count, at
