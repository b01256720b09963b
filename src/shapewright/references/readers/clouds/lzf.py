"""LZF, the packing of LibLZF, which PCD uses: literals, and copies of what was unpacked up to 8 KiB before.

The format, as LibLZF's documentation and ``lzf_d.c`` state it: a byte below 32 is one less than the number of literals
that follow. Any other begins a copy: its three high bits are two less than the length, 7 where another byte adds to
that; its five low bits and the next byte are one less than the distance back.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError

MOST_GROWTH = 88
"""A packed file unpacks to at most this many times its size: three bytes copy 264 at most."""


def unpacked(data: bytes, size: int) -> bytes:
    """The ``size`` bytes that data hold. Raises UnreadableError where they hold more or fewer, or copy from nowhere."""
    target = np.zeros(size, dtype=np.uint8)
    if _unpack(np.frombuffer(data, np.uint8), target) != size:
        raise UnreadableError("broken: its packed points cannot be unpacked")
    return target.tobytes()


@njit(nogil=True, cache=True)
def _unpack(data: NDArray[np.uint8], target: NDArray[np.uint8]) -> int:
    """How many bytes were unpacked; -1 for broken data."""
    i, o = 0, 0
    while i < len(data):
        control = int(data[i])
        i += 1
        if control < 32:
            count = control + 1
            if i + count > len(data) or o + count > len(target):
                return -1
            target[o : o + count] = data[i : i + count]
            i += count
            o += count
            continue
        count = control >> 5
        if count == 7:
            if i >= len(data):
                return -1
            count += int(data[i])
            i += 1
        if i >= len(data):
            return -1
        back = ((control & 31) << 8) + int(data[i]) + 1
        i += 1
        count += 2
        if back > o or o + count > len(target):
            return -1
        for _ in range(count):  # one by one: a copy may overlap itself
            target[o] = target[o - back]
            o += 1
    return o
