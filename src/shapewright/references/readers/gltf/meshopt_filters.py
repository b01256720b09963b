"""What meshoptimizer's filters make of decoded elements: unit vectors, quaternions, floats and colours.

The formulas are those of the appendix of KHR_meshopt_compression.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

_Bytes = NDArray[np.uint8]


@dataclass(frozen=True)
class Filter:
    """A filter of elements (N, stride) of bytes into as many bytes.

    Attributes:
        strides: bytes that an element may have.
        apply: the filter.
    """

    strides: range | tuple[int, ...]
    apply: Callable[[_Bytes], _Bytes]


def _octahedral(elements: _Bytes) -> _Bytes:
    kind = np.int8 if elements.shape[1] == 4 else np.int16
    coded = elements.view(kind)
    with np.errstate(divide="ignore", invalid="ignore"):
        xy = coded[:, :2] / coded[:, 2:3].astype(np.float64)
        z = 1.0 - np.abs(xy).sum(axis=1, keepdims=True)
        xy -= np.copysign(np.minimum(z, 0.0), xy)
        unit = np.concatenate([xy, z], axis=1)
        unit *= np.iinfo(kind).max / np.linalg.norm(unit, axis=1, keepdims=True)
    result = coded.copy()
    result[:, :3] = np.nan_to_num(np.rint(unit))
    return result.view(np.uint8)


def _quaternion(elements: _Bytes) -> _Bytes:
    coded = elements.view("<i2")
    one = (coded[:, 3:] | 3).astype(np.float64)
    xyz = coded[:, :3] / one * np.sqrt(0.5)
    w = np.sqrt(np.maximum(1.0 - (xyz * xyz).sum(axis=1, keepdims=True), 0.0))
    values = np.rint(np.concatenate([w, xyz], axis=1) * 32767.0)
    result = np.empty(coded.shape, "<i2")
    places = (coded[:, 3:] & 3) + np.arange(4)
    # A code that is not valid can lie outside what 16 bits hold.
    np.put_along_axis(result, places % 4, np.clip(values, -32768, 32767).astype("<i2"), axis=1)
    return result.view(np.uint8)


def _exponential(elements: _Bytes) -> _Bytes:
    coded = elements.view("<i4")
    mantissa = (coded << 8) >> 8
    with np.errstate(over="ignore"):
        values = np.asarray(np.ldexp(mantissa.astype(np.float64), coded >> 24), dtype="<f4")
    return values.view(np.uint8)


def _as_they_are(elements: _Bytes) -> _Bytes:
    return elements


FILTERS: Mapping[str, Filter] = {
    "OCTAHEDRAL": Filter((4, 8), _octahedral),
    "QUATERNION": Filter((8,), _quaternion),
    "EXPONENTIAL": Filter(range(4, 257, 4), _exponential),
    # Colours are not read, so their bytes need no meaning.
    "COLOR": Filter((4, 8), _as_they_are),
}
"""By the names of the format."""
