"""What is left between replicas and their references, as pictures from the same places: missing here, too much there.

Misfits whose remainders lie in the same places lack the same thing, whatever else they look like.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import gaussian_filter

from shapewright.rendering.cameras import Camera
from shapewright.rendering.ink import coverage
from shapewright.rendering.raster import render
from shapewright.shapes import Drawing, Floats, ReferenceShape, Shape

_VIEWS = (Camera(35.0, 25.0), Camera(215.0, 25.0), Camera(0.0, 0.0), Camera(90.0, 0.0), Camera(125.0, -25.0))
_SIZE, _STEP = 64, 4  # pixels along the side of a picture, and between its samples
# The next three were chosen on half the sets of benchmarks/misfits.py.
_BLUR = 8.0  # standard deviation in pixels: a part that is missing may be a little aside
_LIKENESS = 0.35  # share of the references' likeness in a distance; the remainders have the rest
CUT = 1.25
"""Groups merge up to this times the cut of the settings, which is made for likeness alone."""


def remainder(reference: ReferenceShape, replica: Shape | None) -> Floats:
    """A unit vector (K,): what is missing and what is too much, sampled from blurred pictures of depth, or of ink.

    Both shapes are normalised and neither is turned or mirrored. Without a replica all of the reference is missing. 0
    where nothing is left.
    """
    ours = _seen(reference)
    theirs = np.zeros_like(ours) if replica is None else _seen(replica)
    both = (ours > 0.0) & (theirs > 0.0)
    sides = [np.where(both, np.maximum(a - b, 0.0), (a > 0.0) & ~both) for a, b in ((ours, theirs), (theirs, ours))]
    if isinstance(reference, Drawing):
        sides = [np.maximum(ours - theirs, 0.0), np.maximum(theirs - ours, 0.0)]
    half = _STEP // 2
    samples = [gaussian_filter(side, (0.0, _BLUR, _BLUR))[:, half::_STEP, half::_STEP].ravel() for side in sides]
    vector = np.concatenate(samples)
    length = float(np.linalg.norm(vector))
    return vector / length if length > 0.0 else vector


def mixed(likeness: Floats, some: Floats, others: Floats) -> Floats:
    """Distances (N, M) of misfits, 0 to 1: by the references' likeness and by where what is left lies.

    likeness: (N, M), of references; 0 for the same, 1 and more where they have nothing in common. some, others: their
    remainders, (N, K) and (M, K).
    """
    apart = np.clip(1.0 - some @ others.T, 0.0, 1.0)
    return np.asarray(_LIKENESS * np.minimum(likeness, 1.0) + (1.0 - _LIKENESS) * apart)


def _seen(shape: ReferenceShape) -> Floats:
    """(V, 64, 64): nearness of a mesh or of points in each view, or the ink of a drawing in one, 0 to 1."""
    if isinstance(shape, Drawing):
        return coverage(shape, _SIZE)[None]
    return render([shape.normalised()], _VIEWS, _SIZE, supersample=1, threads=1)[0, :, 1] / 255.0
