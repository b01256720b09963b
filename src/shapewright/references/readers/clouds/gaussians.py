"""Centres of Gaussian splats (Kerbl et al. 2023), as PLY and as .splat; those that are nearly transparent are none."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.cloud import Cloud
from shapewright.shapes import Floats

_LEAST_OPACITY = 0.1
"""Splats that hide less than a tenth of what is behind them are haze and floaters, not surface."""
_SPLAT = np.dtype([("position", "<f4", 3), ("scale", "<f4", 3), ("colour", "u1", 4), ("rotation", "u1", 4)])
_SIGNS = frozenset(["opacity", "scale_0", "rot_0"])


def is_gaussians(names: Mapping[str, object]) -> bool:
    """Whether the vertices of a PLY file, which have properties of these names, are Gaussian splats."""
    return names.keys() >= _SIGNS


def opaque(positions: Floats, opacity: NDArray[np.floating]) -> Cloud:
    """The centres (N, 3) of splats that can be seen; opacity: (N,), 0 to 1."""
    seen = np.asarray(opacity >= _LEAST_OPACITY)
    hidden = len(seen) - int(seen.sum())
    taken = "Gaussian splats: their centres are taken as points"
    left = f"{hidden} of {len(seen)} splats left out: they are nearly transparent"
    return Cloud(positions[seen], notes=(taken, left) if hidden else (taken,))


def of_ply(positions: Floats, logits: NDArray[np.floating]) -> Cloud:
    """As ``opaque``, with the opacity as training keeps it: before the logistic function."""
    with np.errstate(over="ignore", invalid="ignore"):
        return opaque(positions, 1.0 / (1.0 + np.exp(-logits.astype(np.float64))))


def read_splat(data: bytes) -> Cloud:
    """The centres of a .splat file: 32 bytes a splat. Raises UnreadableError for any other number of bytes."""
    if len(data) % _SPLAT.itemsize:
        raise UnreadableError(f"cut short: {len(data)} bytes are no whole number of splats of {_SPLAT.itemsize} bytes")
    table = np.frombuffer(data, _SPLAT)
    return opaque(table["position"].astype(np.float64), table["colour"][:, 3] / 255.0)
