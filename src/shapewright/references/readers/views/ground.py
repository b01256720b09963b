"""Which part of a photograph is its object, where the background is plain: a wall, a sheet, a page."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from shapewright.references.errors import UnreadableError

Mask: TypeAlias = NDArray[np.bool_]
Colours: TypeAlias = NDArray[np.float32]

_RIM = 0.02  # share of the sides that is looked at as background
_PLAIN = 14.0
"""Grey levels from the fitted background that half of the rim keeps within; a photographed wall has 2 to 6."""
_LEAST, _TIMES = 12.0, 4.0
"""Grey levels from the background, at least, and in spreads of the rim, from which on a pixel is the object."""
_DARKEST, _TINT = 0.45, 14.0
"""A shadow is no darker than this part of the background, and no more grey levels off its hue."""
_EDGES = (9.0, 6.0, 4.0)
"""Grey levels a pixel, of a blurred picture, at which an object begins: shadows begin softly. The first that does."""
_MOST = 0.35  # share of what is not background that shadows take at most
_COLOURED = 30.0  # grey levels between the colours of a background, from which its hue tells it from objects
_SMALL = 2e-4  # share of the picture below which a spot, or a hole, is none
_BESIDE = 0.02  # share of the largest piece that another one has to have


def foreground(colours: Colours) -> tuple[Mask, str]:
    """Where the object is in colours (H, W, 3) of 0 to 255, and a note of what was done.

    The background is what the rim shows, getting lighter or darker evenly. What hardly differs from it is background,
    in holes too; so is a shadow: of the same hue, darker, and without a sharp edge towards the background.
    Raises UnreadableError where the rim is not plain, and where nothing is left.
    """
    ground, spread = _background(colours)
    away = np.abs(colours - ground).max(axis=2)
    other = away > max(_LEAST, _TIMES * spread)
    shadow = _shadows(colours, ground, ~other)
    mask = _cleared(other & ~shadow)
    if not mask.any():
        raise UnreadableError("nothing in the picture stands out from its background")
    faded = (other & shadow).mean() > _SMALL
    return mask, "the plain background was removed" + (", with a soft shadow on it" if faded else "")


def _background(colours: Colours) -> tuple[Colours, float]:
    """The colours of the background, fitted to the rim, and how far half of the rim is from them."""
    height, width, _ = colours.shape
    margin = max(2, round(_RIM * min(height, width)))
    rim = np.ones((height, width), dtype=bool)
    rim[margin:-margin, margin:-margin] = False
    rows, columns = np.mgrid[0:height, 0:width]
    x, y = columns / width - 0.5, rows / height - 0.5
    terms = np.stack([np.ones_like(x), x, y, x * x, y * y, x * y], axis=-1)
    kept, ground = rim.copy(), colours
    for _ in range(3):  # what the object covers of the rim is left out, bit by bit
        weights, *_ = np.linalg.lstsq(terms[kept], colours[kept], rcond=None)
        ground = (terms @ weights).astype(np.float32)
        away = np.abs(colours - ground).max(axis=2)
        spread = float(np.median(away[rim]))
        kept = rim & (away <= max(2.5 * spread, 2.0))
    if spread > _PLAIN:
        raise UnreadableError(
            "its background is not plain: cut the object out (a transparent background), or put a mask beside it, "
            "white where the object is, as NAME.mask.png"
        )
    return ground, spread


def _shadows(colours: Colours, ground: Colours, background: Mask) -> Mask:
    """Where shadows lie: reached from the background without a sharp edge, or anywhere on a background of strong hue.

    What would take much of all that stands out is no shadow but a grey object, whose edges are soft as well.
    """
    light, below = colours.mean(axis=2), np.maximum(ground.mean(axis=2), 1.0)
    share = light / below
    hue = np.abs(colours - ground * share[:, :, None]).max(axis=2)
    may = (share >= _DARKEST) & (share <= 1.02) & (hue <= _TINT)
    steep = ndimage.gaussian_gradient_magnitude(light, 1.0)
    coloured = np.median(np.ptp(ground, axis=2)) > _COLOURED
    for edge in _EDGES:
        labels, count = ndimage.label(background | (may & (steep < edge)))
        reached = np.zeros(count + 1, dtype=bool)
        reached[np.unique(labels[background])] = True
        reached[0] = False
        shadow = np.asarray(reached[labels]) | (may & coloured)
        if (shadow & ~background).sum() <= _MOST * (~background).sum():
            return np.asarray(shadow)
    return background


def _cleared(mask: Mask) -> Mask:
    """Without specks and pinholes, and without pieces that are small beside the largest."""
    least = max(4.0, _SMALL * mask.size)
    mask = _without(mask, least)
    mask = ~_without(~mask, least)
    labels, count = ndimage.label(mask, np.ones((3, 3)))
    if count > 1:
        areas = np.bincount(labels.ravel())
        areas[0] = 0
        mask = np.asarray((areas >= _BESIDE * areas.max())[labels])
    return mask


def _without(mask: Mask, least: float) -> Mask:
    labels, _ = ndimage.label(mask)
    areas: Any = np.bincount(labels.ravel())
    areas[0] = 0
    return np.asarray((areas >= least)[labels])
