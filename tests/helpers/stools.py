"""A stool with one side unlike the other: a seat, a back, four legs and a shelf on one side; and pictures of it."""

import io
from typing import Annotated

import numpy as np
from PIL import Image

import shapewright as sw
from shapewright import Range
from shapewright.modelling.solids import box
from shapewright.rendering.framed import framed
from shapewright.rendering.thumbnails import seen_from
from shapewright.shapes.views import SIDE

PLACE = np.array([35.0, 20.0, 0.4])


@sw.procedure
def stool(
    width: Annotated[float, Range(0.4, 1.0)] = 0.6,
    back: Annotated[float, Range(0.1, 0.8)] = 0.5,
    leg: Annotated[float, Range(0.05, 0.2)] = 0.08,
    plinth: bool = False,
):
    shape = box((width, 0.08, 0.6), at=(0, 0.5, 0)) | box((width, back, 0.08), at=(0, 0.5 + back / 2, -0.26))
    shape = shape | box((0.08, 0.25, 0.5), at=(width / 2 - 0.04, 0.6, 0))  # one arm
    if plinth:
        return shape | box((width, 0.5, 0.6), at=(0, 0.25, 0))
    for x in (-1, 1):
        for z in (-1, 1):
            shape = shape | box((leg, 0.5, leg), at=(x * (width - leg) / 2, 0.25, z * (0.6 - leg) / 2))
    return shape


def view(mesh, place=PLACE):
    return sw.View(framed(mesh.normalised(), np.asarray(place)[None], SIDE, 2)[0])


def views(mesh, *places):
    return sw.Views(tuple(view(mesh, place) for place in places or (PLACE,)))


def cut_out(mesh, place=PLACE):
    """A picture (256, 256) with alpha, as an image."""
    return Image.open(io.BytesIO(seen_from(mesh, [place])))


def photograph(mesh, place=PLACE, wall=(225, 228, 230), noise=3.0):
    """The same before a wall that gets darker downwards, with a soft shadow on it; and where the object is."""
    rng = np.random.default_rng(0)
    picture = np.asarray(cut_out(mesh, place)).astype(float)
    alpha = picture[:, :, 3:] / 255.0
    rows, columns = np.mgrid[0:256, 0:256]
    ground = np.array(wall) * (1.0 - 0.15 * rows / 256.0)[:, :, None]
    shadow = np.exp(-(((columns - 150) / 60.0) ** 2 + ((rows - 205) / 18.0) ** 2))[:, :, None]
    ground = ground * (1.0 - 0.3 * shadow)
    colours = picture[:, :, :3] * (0.75, 0.5, 0.35) * alpha + ground * (1.0 - alpha)
    colours += rng.normal(0.0, noise, colours.shape)
    return Image.fromarray(colours.clip(0, 255).astype(np.uint8)), alpha[:, :, 0] > 0.5


def encoded(image, kind="PNG"):
    buffer = io.BytesIO()
    image.save(buffer, kind, **({"quality": 88} if kind == "JPEG" else {}))
    return buffer.getvalue()


def overlap(one, other):
    one, other = one > 127, other > 127
    return (one & other).sum() / (one | other).sum()
