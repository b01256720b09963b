"""A map of shapes: alike ones near each other, by the two directions in which their small pictures differ most."""

from __future__ import annotations

import numpy as np

from shapewright.shapes import Bytes, Floats

_SIDE = 24  # pixels of such a picture, see ``survey.likeness``
_POOLED = 2


def layout(seen: Bytes) -> Floats:
    """(N, 2): places of shapes, the furthest at 1 from the middle along its axis. seen: (N, 4, D), as ``likeness`` has.

    The principal components of the pictures, with signs that do not depend on chance.
    """
    count = len(seen)
    if count < 2:
        return np.zeros((count, 2))
    pictures = seen.reshape(count, -1, _SIDE // _POOLED, _POOLED, _SIDE // _POOLED, _POOLED)
    rows = pictures.mean(axis=(3, 5), dtype=np.float32).reshape(count, -1).astype(np.float64)
    rows -= rows.mean(axis=0)
    wide = rows.shape[1] > count
    _, vectors = np.linalg.eigh(rows @ rows.T if wide else rows.T @ rows)
    chosen = vectors[:, ::-1][:, :2]
    axes = rows.T @ chosen if wide else chosen
    axes = axes / np.maximum(np.linalg.norm(axes, axis=0), np.finfo(np.float64).tiny)
    largest = axes[np.abs(axes).argmax(axis=0), np.arange(axes.shape[1])]
    places = rows @ (axes * np.where(largest < 0.0, -1.0, 1.0))
    places = np.pad(places, ((0, 0), (0, 2 - places.shape[1])))
    return np.asarray(places / max(float(np.abs(places).max()), np.finfo(np.float64).tiny))
