"""The first answer: for each reference the most similar of the samples rendered so far."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def nearest(references: NDArray[np.uint8], samples: NDArray[np.uint8]) -> NDArray[np.int64]:
    """Index of the sample whose pictures differ least from each reference's, (N,), by summed squares.

    references: (N, C, 2, S, S); samples: (M, C, 2, S, S).
    """
    return np.asarray(squares(references, samples).argmin(axis=1))


def squares(references: NDArray[np.uint8], samples: NDArray[np.uint8]) -> NDArray[np.float32]:
    """By how much the pictures of each reference and of each sample differ, (N, M): summed squares of their pixels.

    Compared at half the size, which forgives small offsets.
    """
    theirs, ours = _halved(references), _halved(samples)
    found = (theirs**2).sum(axis=1)[:, None] - 2.0 * theirs @ ours.T + (ours**2).sum(axis=1)[None, :]
    return np.asarray(np.maximum(found, 0.0))


def _halved(images: NDArray[np.uint8]) -> NDArray[np.float32]:
    count, views, channels, side, _ = images.shape
    blocks = images.reshape(count, views * channels, side // 2, 2, side // 2, 2).astype(np.float32)
    return np.asarray(blocks.mean(axis=(3, 5)).reshape(count, views * channels * side * side // 4) / np.float32(255.0))
