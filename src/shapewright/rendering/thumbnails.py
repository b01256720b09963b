"""Thumbnails: small grey pictures of shapes, with their edges drawn, on a transparent ground."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray
from PIL import Image

from shapewright.rendering import ink, splats
from shapewright.rendering.anywhere import camera_at
from shapewright.rendering.cameras import THUMBNAIL, Camera
from shapewright.rendering.raster import AMBIENT, view
from shapewright.shapes import Drawing, Floats, Mesh, Points, ReferenceShape, Views
from shapewright.shapes.views import REACH
from shapewright.threads import in_threads

SUPERSAMPLE = 3  # samples of a pixel along either side
CREASE = math.radians(36.0)
"""Edges are drawn where the surface bends by more than this angle: rounded parts of 12 sides and more stay clean."""
STEP = 0.012
"""Edges are drawn where one part stands in front of another by more than this, in units of the largest extent."""
_DARKEST, _INK = 0.42, 0.4
"""The darkest grey, off black, so that a tint over it keeps its hue; and edges, as a part of their surroundings."""
DRAWN = 0.75
"""Part of the side of a thumbnail that the page of a drawing takes; around it is a margin."""
_GREYS = 32  # fewer greys make smaller files, and nobody can tell 32 from 256 on flat faces
_FAINT = 0.2  # of what was taken for the background of a picture
_PLAIN = 150  # the grey of drawings, of 255: light enough for a tint over it to show


def thumbnail(shape: ReferenceShape, size: int = 256, camera: Camera = THUMBNAIL) -> bytes:
    """A picture of a shape as PNG bytes: grey and alpha, size x size pixels; a mesh or points as a camera sees
    them, points as discs and without edges.

    Of an object in views their pictures are shown, in colours, with what was taken for background faint.

    The shape is normalised first, so that the whole of it is in the picture whatever its size and place.
    Raises ValueError for a mesh without faces, and for a shape of no size.
    """
    if isinstance(shape, Views):
        return _png(_pictures(shape, size))
    return _png(Image.fromarray(_plain(shape, size) if isinstance(shape, Drawing) else _shaded(shape, size, camera)))


def seen_from(mesh: Mesh, places: Sequence[Floats], size: int = 256) -> bytes:
    """A mesh from each place (3,) of ``anywhere``, shown as ``thumbnail`` shows an object in as many views."""
    normal, side = mesh.normalised(), _side(len(places), size)
    return _png(_tiled([_framed(normal, np.asarray(place), side) for place in places], size))


def thumbnails(shapes: Sequence[ReferenceShape], size: int = 256, threads: int | None = None) -> list[bytes]:
    """``thumbnail`` of each shape, in order; the bytes do not depend on the number of threads."""
    return in_threads(lambda shape: thumbnail(shape, size), shapes, threads)


def _png(picture: Image.Image) -> bytes:
    buffer = io.BytesIO()
    picture.save(buffer, "PNG")
    return buffer.getvalue()


def _pictures(shape: Views, size: int) -> Image.Image:
    tiles = []
    for each in shape.views:
        colours = np.full((*each.mask.shape, 3), _PLAIN, np.uint8) if each.picture is None else each.picture
        faint = 0.0 if each.picture is None else _FAINT
        alpha = (each.mask * (1.0 - faint) + 255.0 * faint).astype(np.uint8)
        side = _side(len(shape), size)
        tiles.append(Image.fromarray(np.dstack([colours, alpha])).resize((side, side), Image.Resampling.BOX))
    return _tiled(tiles, size)


def _framed(normal: Mesh, place: Floats, size: int) -> Image.Image:
    """A normalised mesh from a place, its box where that of a view is."""
    camera = camera_at(place)
    right, up, towards = camera.frame() @ normal.triangles.reshape(-1, 3).T
    flat = np.stack([right, -up]) / (camera.distance - towards)
    low, high = flat.min(axis=1), flat.max(axis=1)
    middle, half = (low + high) / 2.0, float((high - low).max()) / (2.0 * REACH)
    reach = float(np.abs(middle).max()) + half  # of a picture that holds the whole
    camera = replace(camera, field_of_view=math.degrees(2.0 * math.atan(reach)))
    wide = Image.fromarray(_shaded(normal, 2 * size, camera))
    box = (np.concatenate([middle - half, middle + half]) / reach + 1.0) * size
    left, top, right, bottom = box.clip(0.0, 2.0 * size).tolist()
    return wide.resize((size, size), Image.Resampling.BOX, (left, top, right, bottom)).convert("RGBA")


def _side(count: int, size: int) -> int:
    """Of each of so many pictures that share the page of a thumbnail."""
    return int(size * DRAWN) // math.ceil(math.sqrt(count))


def _tiled(pictures: Sequence[Image.Image], size: int) -> Image.Image:
    """One picture as large as a drawing's page, or several beside each other in it."""
    whole, corner = Image.new("RGBA", (size, size)), (size - int(size * DRAWN)) // 2
    across = math.ceil(math.sqrt(len(pictures)))
    for i, picture in enumerate(pictures):
        whole.paste(picture, (corner + picture.width * (i % across), corner + picture.width * (i // across)))
    return whole


def _plain(drawing: Drawing, size: int) -> NDArray[np.uint8]:
    """One grey, light enough for a tint over it to show, on a page inside a margin."""
    inner = int(size * DRAWN)
    start = (size - inner) // 2
    alpha = np.pad(ink.picture(drawing, inner, SUPERSAMPLE)[0], (start, size - inner - start))
    return np.stack([np.full_like(alpha, _PLAIN), alpha], axis=-1)


def _shaded(shape: Mesh | Points, size: int, camera: Camera) -> NDArray[np.uint8]:
    side = size * SUPERSAMPLE
    picture = np.empty((size, size, 2), dtype=np.uint8)
    if isinstance(shape, Points):
        shade, _ = splats.view(shape.normalised(), camera, side)
        _resolve(shade, np.zeros(shade.shape, dtype=np.bool_), picture)
        return picture
    shade, inverse_depth = view(shape.normalised(), camera, side)
    _ink(shade, inverse_depth, 2.0 / (side * camera.focal_length), picture)
    return picture


@njit(nogil=True, cache=True)
def _ink(shade: Any, inverse_depth: Any, pixel: float, picture: Any) -> None:
    """Draw the edges over the shading. pixel: size of a sample at distance 1."""
    side = len(shade)
    ink = np.zeros((side, side), dtype=np.bool_)
    for i in range(1, side - 2):
        for j in range(1, side - 2):
            w = inverse_depth
            if _edge_between(w[i, j - 1], w[i, j], w[i, j + 1], w[i, j + 2], pixel):
                ink[i, j] = ink[i, j + 1] = True
            if _edge_between(w[i - 1, j], w[i, j], w[i + 1, j], w[i + 2, j], pixel):
                ink[i, j] = ink[i + 1, j] = True
    _resolve(shade, ink, picture)


@njit(nogil=True, cache=True)
def _edge_between(a: float, b: float, c: float, d: float, pixel: float) -> bool:
    """Whether an edge runs between the second and the third of four neighbouring samples.

    a to d: inverse depths, 0 for background. On a plane they are linear in the picture, so two on either side give
    the surface there exactly, and the two surfaces are compared by their angle and their gap.
    """
    if (b == 0.0) != (c == 0.0):
        return True
    if b == 0.0 or a == 0.0 or d == 0.0 or abs((b - a) - (d - c)) < 1e-6:
        return False
    depth = 1.0 / b
    per_length = depth * depth / (pixel * depth)
    before, after = (b - a) * per_length, (d - c) * per_length
    if abs(np.arctan(before) - np.arctan(after)) > CREASE:
        return True
    gap = min(abs(2.0 * b - a - c), abs(2.0 * c - d - b))
    return bool(gap * depth * depth > STEP)


@njit(nogil=True, cache=True)
def _resolve(shade: Any, ink: Any, picture: Any) -> None:
    """Mean grey and coverage of each pixel's samples, as bytes; a sample of no shade is background."""
    samples = SUPERSAMPLE * SUPERSAMPLE
    for row in range(picture.shape[0]):
        for column in range(picture.shape[1]):
            grey, covered = 0.0, 0
            for i in range(row * SUPERSAMPLE, (row + 1) * SUPERSAMPLE):
                for j in range(column * SUPERSAMPLE, (column + 1) * SUPERSAMPLE):
                    if shade[i, j] > 0.0:
                        covered += 1
                        light = _DARKEST + (1.0 - _DARKEST) * (shade[i, j] - AMBIENT) / (1.0 - AMBIENT)
                        grey += light * _INK if ink[i, j] else light
            level = np.floor(grey / max(covered, 1) * (_GREYS - 1) + 0.5) / (_GREYS - 1)
            picture[row, column, 0] = np.uint8(level * 255.0 + 0.5)
            picture[row, column, 1] = np.uint8(covered / samples * 255.0 + 0.5)
