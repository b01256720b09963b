"""Buffer views compressed by meshoptimizer: EXT_meshopt_compression and KHR_meshopt_compression.

The bitstream is the one of the appendix of KHR_meshopt_compression, versions 0 and 1. A kernel returns the byte behind
the last that it used, so that a stream which is not used up is told, and a negative number where the stream ends early.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.gltf.meshopt_filters import FILTERS

_Bytes = NDArray[np.uint8]
_PADDING = {0: 32, 1: 24}
"""Bytes that the tail of attributes has at least, by the version of the stream."""
_CODE_AUX = 16
_EARLY, _INVALID = -1, -2
_INDEX_TYPES = {2: np.uint16, 4: np.uint32}


def decoded(source: memoryview, count: int, stride: int, mode: str, filter_name: str) -> memoryview:
    """The bytes of ``count`` elements of ``stride`` bytes each. Raises UnreadableError where the stream is invalid."""
    data = np.frombuffer(source, np.uint8)
    if count < 0:
        raise UnreadableError(f"broken: meshopt compression of {count} elements")
    if mode == "ATTRIBUTES" and 0 < stride <= 256 and stride % 4 == 0:
        result: NDArray[Any] = _attributes(data, count, stride)
    elif mode in ("TRIANGLES", "INDICES") and stride in _INDEX_TYPES and filter_name == "NONE":
        result = (_triangles if mode == "TRIANGLES" else _indices)(data, count).astype(_INDEX_TYPES[stride])
    else:
        raise UnreadableError(f"broken: meshopt compression of mode {mode}, {stride} bytes, filter {filter_name}")
    if filter_name != "NONE":
        if filter_name not in FILTERS or stride not in FILTERS[filter_name].strides:
            raise UnreadableError(f"broken: meshopt filter {filter_name} of elements of {stride} bytes")
        result = FILTERS[filter_name].apply(result)
    return np.ascontiguousarray(result).reshape(-1).view(np.uint8).data.toreadonly()


def _attributes(data: _Bytes, count: int, stride: int) -> _Bytes:
    version = _header(data, 0xA0, 0xA1)
    tail = stride + (stride // 4 if version else 0)
    end = len(data) - max(tail, _PADDING[version])
    if end < 1:
        raise UnreadableError("broken: a meshopt stream of attributes without its end")
    channels = data[len(data) - stride // 4 :].copy() if version else np.zeros(stride // 4, np.uint8)
    if (((channels & 15) > 2) | (((channels & 15) < 2) & (channels > 15))).any():
        raise UnreadableError("broken: a meshopt stream of attributes with channels that are not known")
    result = np.zeros((count, stride), np.uint8)
    _check(_decode_attributes(data, end, version, channels, data[len(data) - tail :][:stride].copy(), result), end)
    return result


def _triangles(data: _Bytes, count: int) -> NDArray[np.uint32]:
    _header(data, 0xE1, 0xE1)
    end = len(data) - _CODE_AUX
    if count % 3 or end < 1 + count // 3:
        raise UnreadableError("broken: a meshopt stream of triangles that is too short")
    result = np.zeros(count, np.uint32)
    _check(_decode_triangles(data, end, result), end)
    return result


def _indices(data: _Bytes, count: int) -> NDArray[np.uint32]:
    _header(data, 0xD1, 0xD1)
    result = np.zeros(count, np.uint32)
    _check(_decode_indices(data, len(data) - 4, result), len(data) - 4)
    return result


def _header(data: _Bytes, oldest: int, newest: int) -> int:
    """The version of a stream."""
    if not len(data) or not oldest <= data[0] <= newest:
        raise UnreadableError("broken: a meshopt stream with a header that is not known")
    return int(data[0] & 0x0F)


def _check(used: int, end: int) -> None:
    if used == _INVALID:
        raise UnreadableError("broken: a meshopt stream with a code that is not valid")
    if used != end:
        raise UnreadableError(f"broken: a meshopt stream that {'ends early' if used < 0 else 'is not used up'}")


@njit(nogil=True, cache=True)
def _decode_attributes(data: _Bytes, end: int, version: int, channels: _Bytes, last: _Bytes, result: _Bytes) -> Any:
    """Fill ``result`` (count, stride) with the elements that follow on ``last`` (stride,), which it changes."""
    count, stride = result.shape
    most = min((8192 // stride) & ~15, 256)
    deltas = np.zeros((stride, most + 16), np.uint8)
    at = 1
    for first in range(0, count, most):
        elements = min(count - first, most)
        groups = (elements + 15) // 16
        controls = at
        at += stride // 4 * version
        if at > end:
            return _EARLY
        for byte in range(stride):
            control = (data[controls + byte // 4] >> (2 * (byte % 4))) & 3 if version else 0
            if control == 2 and version:
                deltas[byte] = 0
                continue
            if control == 3 and version:
                if at + elements > end:
                    return _EARLY
                deltas[byte, :elements] = data[at : at + elements]
                at += elements
                continue
            header = at
            at += (groups + 3) // 4
            if at > end:
                return _EARLY
            for group in range(groups):
                mode = (data[header + group // 4] >> (2 * (group % 4))) & 3
                # Bits for each delta: 0 2 4 8 in version 0, 0 1 2 4 and 1 2 4 8 in version 1.
                bits = (1 << mode) if control or not version else (1 << mode) >> 1
                if not version and mode == 0:
                    bits = 0
                at = _decode_group(data, at, end, bits, deltas[byte, 16 * group : 16 * group + 16])
                if at < 0:
                    return _EARLY
        for element in range(elements):
            for channel in range(stride // 4):
                _add(channels[channel], deltas[4 * channel : 4 * channel + 4, element], last[4 * channel :])
            result[first + element] = last
    return at


@njit(nogil=True, cache=True)
def _decode_group(data: _Bytes, at: int, end: int, bits: int, result: _Bytes) -> Any:
    """Sixteen deltas of 0, 1, 2, 4 or 8 bits; those whose bits are all 1 follow as a byte each."""
    if bits == 0:
        result[:] = 0
        return at
    codes = at
    at += 2 * bits
    if at > end:
        return _EARLY
    if bits == 8:
        result[:] = data[codes:at]
        return at
    sentinel = (1 << bits) - 1
    in_byte = 8 // bits
    for i in range(16):
        place = i % in_byte
        shift = place if bits == 1 else 8 - bits * (place + 1)
        delta = (data[codes + i // in_byte] >> shift) & sentinel
        if delta == sentinel:
            if at >= end:
                return _EARLY
            delta = data[at]
            at += 1
        result[i] = delta
    return at


@njit(nogil=True, cache=True)
def _add(channel: int, delta: _Bytes, last: _Bytes) -> None:
    """Take the next four bytes of an element from the last ones: byte by byte, by two, or by the bits that change."""
    if channel == 0:
        for i in range(4):
            last[i] += (delta[i] >> 1) ^ (0xFF * (delta[i] & 1))
    elif channel == 1:
        for i in (0, 2):
            coded = np.int64(delta[i]) | np.int64(delta[i + 1]) << 8
            value = (np.int64(last[i]) | np.int64(last[i + 1]) << 8) + ((coded >> 1) ^ -(coded & 1))
            last[i], last[i + 1] = value & 0xFF, (value >> 8) & 0xFF
    else:
        turn = channel >> 4
        word = np.int64(0)
        for i in range(4):
            word |= np.int64(delta[i]) << (8 * i)
        word = ((word >> turn) | (word << (32 - turn))) & 0xFFFFFFFF
        for i in range(4):
            last[i] ^= (word >> (8 * i)) & 0xFF


@njit(nogil=True, cache=True)
def _varint(data: _Bytes, at: int, end: int) -> tuple[Any, Any]:
    """A number of 32 bits (LEB128), and the byte behind it."""
    value = np.int64(0)
    for i in range(5):
        if at < 0:  # the number before was broken already
            return 0, at
        if at >= end:
            return 0, _EARLY
        value |= np.int64(data[at] & 127) << (7 * i)
        at += 1
        if data[at - 1] < 128:
            return value & 0xFFFFFFFF, at
    return 0, _INVALID


@njit(nogil=True, cache=True)
def _decode_indices(data: _Bytes, end: int, result: NDArray[np.uint32]) -> Any:
    """Fill ``result`` with differences to one of two numbers; each becomes the number of its kind."""
    last = np.zeros(2, np.int64)
    at = 1
    for i in range(len(result)):
        value, at = _varint(data, at, end)
        if at < 0:
            return at
        last[value & 1] += (value >> 2) ^ -((value >> 1) & 1)
        result[i] = last[value & 1] & 0xFFFFFFFF
    return at


@njit(nogil=True, cache=True)
def _decode_triangles(data: _Bytes, end: int, result: NDArray[np.uint32]) -> Any:
    """Fill ``result`` with triangles of the last 16 edges and vertices, the next new vertex, and told ones."""
    edges = np.full((16, 2), -1, np.int64)
    vertices = np.full(16, -1, np.int64)
    edge, vertex, upcoming, last = 0, 0, 0, 0
    at = 1 + len(result) // 3
    for i in range(len(result) // 3):
        high, low = np.int64(data[1 + i] >> 4), np.int64(data[1 + i] & 15)
        if high < 15:
            a, b = edges[(edge - 1 - high) & 15]
            if 0 < low < 13:
                c = vertices[(vertex - 1 - low) & 15]
            else:
                if low == 0:
                    c, upcoming = upcoming, upcoming + 1
                elif low == 15:
                    c, at = _told(data, at, end, last)
                    last = c
                else:
                    c = last + (1 if low == 14 else -1)
                    last = c
                vertices[vertex & 15] = c
                vertex += 1
        else:
            if low < 14:
                pair = np.int64(data[end + low])
                if pair >> 4 == 15 or pair & 15 == 15:
                    return _INVALID
            else:
                if at >= end:
                    return _EARLY
                pair = np.int64(data[at])
                at += 1
                if pair == 0:
                    upcoming = 0
            b_code, c_code = pair >> 4, pair & 15
            if low < 15:
                a, upcoming = upcoming, upcoming + 1
            else:
                a, at = _told(data, at, end, last)
                last = a
            if b_code == 0:
                b, upcoming = upcoming, upcoming + 1
            elif b_code < 15:
                b = vertices[(vertex - b_code) & 15]
            else:
                b, at = _told(data, at, end, last)
                last = b
            if c_code == 0:
                c, upcoming = upcoming, upcoming + 1
            elif c_code < 15:
                c = vertices[(vertex - c_code) & 15]
            else:
                c, at = _told(data, at, end, last)
                last = c
            vertices[vertex & 15] = a
            vertex += 1
            for code, told in ((b_code, b), (c_code, c)):
                if code in (0, 15):
                    vertices[vertex & 15] = told
                    vertex += 1
            edges[edge & 15] = b, a
            edge += 1
        if at < 0:
            return at
        if a < 0 or b < 0 or c < 0:
            return _INVALID
        edges[edge & 15] = c, b
        edges[(edge + 1) & 15] = a, c
        edge += 2
        result[3 * i], result[3 * i + 1], result[3 * i + 2] = a, b, c
    return at


@njit(nogil=True, cache=True)
def _told(data: _Bytes, at: int, end: int, last: Any) -> tuple[Any, Any]:
    """A vertex by its difference to the last one that was told, and the byte behind it."""
    value, at = _varint(data, at, end)
    return (last + ((value >> 1) ^ -(value & 1))) & 0xFFFFFFFF, at
