"""Drawings in pictures, as Pillow reads them: what is dark on light or light on dark, outlined between the pixels."""

from __future__ import annotations

import io
import math
import warnings
from collections.abc import Callable
from typing import Any, TypeAlias, TypeVar, cast

import numpy as np
import shapely
from contourpy import FillType, contour_generator
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.contents import held
from shapewright.shapes import Drawing

KINDS = (".png", ".jpg", ".jpeg", ".webp", ".avif", ".gif", ".bmp", ".tif", ".tiff")
"""Extensions of pictures. What a file holds decides how it is read, whichever of them it has."""
_FORMATS = ("PNG", "JPEG", "WEBP", "AVIF", "GIF", "BMP", "TIFF")
MOST = 2048
"""Pixels along the longer side. A larger picture is reduced by a whole number, and a dark pixel stays dark."""
_OUTLINES = 4000
"""Outlines at most. A finer picture is dithered or a photograph: it is halved as long as it has more of them."""
_LEAST = 64
"""Pixels along the longer side, below which no picture is halved."""
_SPECK = 4.0
"""Pixels that a spot of a noisy picture covers at least: a smaller one is noise."""
_SLACK = 0.3
"""Pixels that an outline may be simplified by: less than half a pixel, so it stays between a dark and a light one."""
_CONTRAST, _STEP = 0.2, 0.02
"""The darkest grey is darker by this share of the lightest one, and by this share of white. Less is noise: that of a
JPEG reaches .05 of white and more beside lines. 12 bits stored as 16 use .06 of all values."""
_RIM = 0.9
"""Share of the rim: where more of it is dark, the page is dark."""
_Grey: TypeAlias = NDArray[Any]  # of whole numbers or float32
_Taken = TypeVar("_Taken")


def read_picture(data: bytes) -> tuple[Drawing, tuple[str, ...]]:
    """The drawn part of a picture, in pixels, y up, and notes; what is transparent counts as white.

    The darker side of the middle between its lightest and its darkest grey is drawn, or the lighter side on a dark
    page. Raises UnreadableError where nothing is, and for a file that holds no picture.
    """
    grey, white, notes = _pixels(data)
    lightest, darkest = float(grey.max()), float(grey.min())
    if lightest - darkest < max(_CONTRAST * lightest, _STEP * white):
        if lightest > white / 2:
            raise UnreadableError("nothing in the picture is dark: a drawing is dark on white, or white on dark")
        return Drawing(outline(np.ones(grey.shape, dtype=np.float32))), notes
    dark = grey < (lightest + darkest) / 2
    if np.concatenate([dark[0], dark[-1], dark[:, 0], dark[:, -1]]).mean() > _RIM:
        if dark.mean() > 0.5:
            grey = grey.max() - grey + grey.min()
            notes = (*notes, "dark all round: its light part is the drawing")
        else:
            notes = (*notes, "dark all round, and light for the most part: its dark part is the drawing")
    factor = math.ceil(max(grey.shape) / MOST)
    if factor > 1:
        notes = (*notes, f"reduced to 1/{factor} of its {grey.shape[1]} x {grey.shape[0]} pixels")
        grey = _pooled(grey, factor)
    darkness = (np.float32(lightest) - grey.astype(np.float32)) / np.float32(lightest - darkest)
    clear = _cleared(darkness)
    if clear.shape == darkness.shape:
        return Drawing(outline(clear)), notes
    spots = shapely.get_parts(outline(clear))
    areas = shapely.area(spots)
    kept = shapely.union_all(spots[areas >= min(_SPECK, areas.max())])
    note = f"dithered or noisy: seen at {clear.shape[1]} x {clear.shape[0]} pixels"
    return Drawing(cast("shapely.Polygon | shapely.MultiPolygon", kept)), (*notes, note)


def outline(darkness: NDArray[np.float32]) -> shapely.Polygon | shapely.MultiPolygon:
    """The area where a picture (H, W) of values in [0, 1] is above one half, by marching squares; y up, in pixels.

    Two dark pixels that touch in a corner are joined where the mean of the four around it is above one half.
    """
    points, offsets, parts = _contours(darkness)
    rings: Any = shapely.linearrings(points, indices=np.repeat(np.arange(len(offsets) - 1), np.diff(offsets)))
    polygons: Any = shapely.polygons(rings, indices=np.repeat(np.arange(len(parts) - 1), np.diff(parts)))
    simple: Any = shapely.simplify(polygons, _SLACK)  # each for itself, in a tenth of the time
    valid = shapely.get_parts(shapely.get_parts(shapely.make_valid(simple)))  # of which some are collections, and lines
    pieces = valid[shapely.area(valid) > 0.0]
    if not len(pieces):
        raise UnreadableError("no line drawing: its dark part has no area")
    whole: Any = pieces[0] if len(pieces) == 1 else shapely.multipolygons(pieces)
    return cast("shapely.Polygon | shapely.MultiPolygon", whole if whole.is_valid else shapely.union_all(pieces))


def _cleared(darkness: NDArray[np.float32]) -> NDArray[np.float32]:
    """A picture without dither and specks: halved until it has few outlines. Raises UnreadableError where none stay."""
    while (outlines := len(_contours(darkness)[1]) - 1) > _OUTLINES and max(darkness.shape) >= 2 * _LEAST:
        darkness = _halved(darkness)
    if outlines > _OUTLINES:
        raise UnreadableError(f"no line drawing: it consists of {outlines} spots, as a photograph or noise does")
    if not outlines:
        raise UnreadableError("no line drawing: its dark and light spots are too small")
    return darkness


def _contours(darkness: NDArray[np.float32]) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """The points (N, 2) of all rings, where each ring begins among them, and where each part among the rings.

    A part is a rim and its holes.
    """
    grid = np.pad(darkness.astype(np.float64), 1)
    height, width = grid.shape
    kind = FillType.ChunkCombinedOffsetOffset
    contours = contour_generator(np.arange(width) - 1.0, 1.0 - np.arange(height), grid, fill_type=kind)
    filled: Any = contours.filled(0.5, np.inf)
    (points,), (offsets,), (parts,) = filled
    if points is None:
        return np.empty((0, 2)), np.zeros(1, np.int64), np.zeros(1, np.int64)
    return points, offsets.astype(np.int64), parts.astype(np.int64)


def _pixels(data: bytes) -> tuple[_Grey, float, tuple[str, ...]]:
    """The greys (H, W) of a picture, the value of white, and notes; what is transparent is white."""
    (grey, white), notes = decoded(data, _greys)
    return grey, white, notes


def decoded(data: bytes, taken: Callable[[Any], _Taken]) -> tuple[_Taken, tuple[str, ...]]:
    """What is taken of a picture as Pillow opens it, and notes. Raises UnreadableError where it cannot be opened."""
    from PIL import Image, UnidentifiedImageError

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        warnings.simplefilter("error", Image.DecompressionBombWarning)
        try:
            with Image.open(io.BytesIO(data), formats=_FORMATS) as image:
                frames = getattr(image, "n_frames", 1)
                notes = (f"the first of its {frames} pictures",) if frames > 1 else ()
                return taken(image), notes
        except UnidentifiedImageError as error:
            raise UnreadableError(f"holds {held(data)}, not a picture that is read") from error
        except (Image.DecompressionBombWarning, Image.DecompressionBombError) as error:
            most = (Image.MAX_IMAGE_PIXELS or 0) // 10**6
            raise UnreadableError(f"too large: more than {most} million pixels") from error
        except MemoryError:
            raise
        except Exception as error:  # a broken file can make a decoder fail in any way
            raise UnreadableError(f"broken: the picture cannot be decoded: {error}") from error


def _greys(opened: Any) -> tuple[_Grey, float]:
    from PIL import ImageChops, ImageOps

    image = ImageOps.exif_transpose(opened)
    if image.mode.startswith("I;16"):
        return np.asarray(image).astype(np.uint16), 65535.0
    if image.mode in ("I", "F"):
        values = np.nan_to_num(np.asarray(image, dtype=np.float32), posinf=0.0, neginf=0.0)
        return values - min(0.0, float(values.min())), 65535.0 if image.mode == "I" else float(np.ptp(values))
    if image.has_transparency_data:
        coloured = image.convert("RGBA")
        cover = coloured.getchannel("A")
        grey = coloured.convert("RGB").convert("L")
        shown = np.asarray(ImageChops.invert(ImageChops.multiply(ImageChops.invert(grey), cover)))
        if np.ptp(shown) < _CONTRAST * 255.0 <= np.ptp(np.asarray(cover)):  # light ink on nothing
            shown = 255 - np.asarray(cover)
        return shown, 255.0
    if image.mode not in ("1", "L"):
        image = image.convert("RGB")
    return np.asarray(image.convert("L")), 255.0


def _pooled(grey: _Grey, factor: int) -> _Grey:
    """A picture reduced by a whole number; each pixel is the darkest of those that it covers."""
    height, width = (-(-side // factor) for side in grey.shape)
    padded = np.pad(grey, [(0, height * factor - grey.shape[0]), (0, width * factor - grey.shape[1])], mode="edge")
    return np.asarray(padded.reshape(height, factor, width, factor).min(axis=(1, 3)))


def _halved(darkness: NDArray[np.float32]) -> NDArray[np.float32]:
    """A picture at half its size; each pixel is the mean of those that it covers."""
    padded = np.pad(darkness, [(0, side % 2) for side in darkness.shape], mode="edge")
    means = padded.reshape(padded.shape[0] // 2, 2, padded.shape[1] // 2, 2).mean(axis=(1, 3), dtype=np.float32)
    return np.asarray(means)
