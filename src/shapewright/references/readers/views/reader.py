"""A picture of an object as a view: its silhouette, and how that was found."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageOps

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.pictures import decoded
from shapewright.references.readers.views.ground import foreground
from shapewright.references.readers.views.sketch import filled, is_sketch
from shapewright.rendering.ink import coverage
from shapewright.shapes import Drawing
from shapewright.shapes.views import REACH, SIDE, View

Mask: TypeAlias = NDArray[np.bool_]

_MOST = 1024  # pixels along the longer side of the picture that is looked at
_CLEAR = 0.01  # share of a picture that has to be transparent for its transparency to count
_TOUCHED = 0.5  # share of a side of the picture along which the object may leave it
_CONTRAST = 0.2  # of white, by which ink is darker than its page
_GREY = 12.0  # levels between the colours of a drawing's pixels, at most


def read_view(data: bytes, mask: bytes | None = None) -> tuple[View, tuple[str, ...]]:
    """The object in a picture, and notes; ``mask`` is another picture, white where the object is.

    Without a mask the object is what is not transparent; or what a line sketch encloses; or what stands out from a
    plain background. Raises UnreadableError where none of these finds it.
    """
    image, notes = decoded(data, lambda opened: _reduced(_coloured(opened)))
    view, found = _found(image, None if mask is None else decoded(mask, _coloured)[0])
    return view, (*notes, *found)


def view_of(drawing: Drawing) -> View:
    """The silhouette that a drawing is."""
    return View(np.asarray(coverage(drawing, SIDE) * 255.0 + 0.5).astype(np.uint8))


def _found(image: Any, given: Any | None) -> tuple[View, tuple[str, ...]]:
    """The view of an RGBA picture, and notes. given: its mask."""
    colours = np.asarray(_on_white(image), dtype=np.float32)
    if given is not None:
        if abs(given.width / given.height - image.width / image.height) > 0.02 * image.width / image.height:
            raise UnreadableError(f"its mask has another form: {given.width} x {given.height} pixels")
        shown = np.asarray(_on_black(given).convert("L").resize(image.size, Image.Resampling.BOX))
        return _view(shown > 127, colours, "the object is what its mask shows")
    alpha = np.asarray(image.getchannel("A"))
    if (alpha < 128).mean() >= _CLEAR and (alpha >= 128).any():
        return _view(alpha >= 128, colours, "the object is what is not transparent")
    light = colours.mean(axis=2)
    if np.ptp(colours, axis=2).mean() <= _GREY and _is_bright(light):
        ink = light < light.max() - max(_CONTRAST * 255.0, 0.5 * np.ptp(light))
        if is_sketch(ink):
            return _view(*_then(filled(ink), colours))
    return _view(*_then(foreground(colours), colours))


def _then(found: tuple[Mask, str], colours: NDArray[np.float32]) -> tuple[Mask, NDArray[np.float32], str]:
    return found[0], colours, found[1]


def _view(mask: Mask, colours: NDArray[np.float32], note: str) -> tuple[View, tuple[str, ...]]:
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    if not len(rows):
        raise UnreadableError("its mask shows nothing")
    notes: tuple[str, ...] = (note,)
    sides = {"left": mask[:, 0], "right": mask[:, -1], "top": mask[0], "bottom": mask[-1]}
    extent = {"left": len(rows), "right": len(rows), "top": len(columns), "bottom": len(columns)}
    cut = [name for name, pixels in sides.items() if pixels.sum() > _TOUCHED * extent[name]]
    if cut:
        notes = (*notes, f"the object leaves the picture at the {' and the '.join(cut)}: what is there is not seen")
    box = np.array([columns[0], rows[0], columns[-1] + 1, rows[-1] + 1], dtype=np.float64)
    half = float(max(box[2] - box[0], box[3] - box[1])) / 2.0 / REACH
    middle = (box[:2] + box[2:]) / 2.0
    margin = int(np.ceil(half)) + 1
    frame = tuple((np.concatenate([middle - half, middle + half]) + margin).tolist())
    framed = Image.fromarray(np.pad(mask, margin).astype(np.uint8) * 255)
    around = [(margin, margin), (margin, margin), (0, 0)]
    shown = Image.fromarray(np.pad(colours, around, mode="edge").astype(np.uint8))
    pixels = [np.asarray(one.resize((SIDE, SIDE), _way(2.0 * half), frame)) for one in (framed, shown)]
    return View(pixels[0], pixels[1]), notes


def _way(size: float) -> Image.Resampling:
    return Image.Resampling.BOX if size > SIDE else Image.Resampling.BILINEAR


def _is_bright(light: NDArray[np.float32]) -> bool:
    """Whether most of a picture is page: near its lightest grey."""
    return bool((light > light.max() - 0.15 * 255.0).mean() > 0.5)


def _reduced(image: Any) -> Any:
    longest = max(image.size)
    if longest <= _MOST:
        return image
    factor = _MOST / longest
    size = (max(1, round(image.width * factor)), max(1, round(image.height * factor)))
    return image.resize(size, Image.Resampling.BOX)


def _coloured(opened: Any) -> Any:
    """A picture as Pillow opens it, upright, in RGBA of 8 bits."""
    image = ImageOps.exif_transpose(opened)
    if image.mode.startswith("I") or image.mode == "F":
        values = np.nan_to_num(np.asarray(image, dtype=np.float64), posinf=0.0, neginf=0.0)
        image = Image.fromarray((255.0 * values / max(float(values.max()), 1e-9)).clip(0.0, 255.0).astype(np.uint8))
    return image.convert("RGBA")


def _on_white(image: Any) -> Any:
    """A picture in colours, on white where it is transparent."""
    return Image.alpha_composite(Image.new("RGBA", image.size, (255, 255, 255, 255)), image).convert("RGB")


def _on_black(image: Any) -> Any:
    return Image.alpha_composite(Image.new("RGBA", image.size, (0, 0, 0, 255)), image).convert("RGB")
