"""Pictures of objects, read as views."""

import numpy as np
import pytest
import shapely
from PIL import Image

import shapewright as sw
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.views.reader import read_view, view_of
from stools import cut_out, encoded, overlap, photograph, stool, view

TRUTH = view(stool()).mask


@pytest.mark.parametrize("kind", ["PNG", "WEBP"])
def test_what_is_not_transparent_is_the_object(kind):
    found, notes = read_view(encoded(cut_out(stool()), kind))
    assert overlap(found.mask, TRUTH) > 0.95 and notes == ("the object is what is not transparent",)


def test_a_mask_beside_a_picture_decides():
    busy = Image.fromarray(np.random.default_rng(0).integers(0, 255, (256, 256, 3)).astype(np.uint8))
    mask = cut_out(stool()).getchannel("A").resize((128, 128))
    found, notes = read_view(encoded(busy), encoded(mask))
    assert overlap(found.mask, TRUTH) > 0.9 and notes == ("the object is what its mask shows",)
    with pytest.raises(UnreadableError, match="its mask has another form: 128 x 64"):
        read_view(encoded(busy), encoded(mask.resize((128, 64))))
    with pytest.raises(UnreadableError, match="its mask shows nothing"):
        read_view(encoded(busy), encoded(Image.new("L", (256, 256))))


def test_a_photograph_before_a_plain_wall():
    picture, _ = photograph(stool())
    found, notes = read_view(encoded(picture, "JPEG"))
    assert overlap(found.mask, TRUTH) > 0.9 and notes[0].startswith("the plain background was removed")
    assert found.picture is not None and found.picture[160, 160, 0] > found.picture[160, 160, 2]  # in its colours


def test_a_silhouette_in_black_on_white():
    black = Image.fromarray(np.where(TRUTH > 127, 0, 255).astype(np.uint8))
    assert overlap(read_view(encoded(black))[0].mask, TRUTH) > 0.98


def test_a_sketch_is_filled():
    lines = (TRUTH > 127) ^ np.pad(TRUTH > 127, 2)[4:, 2:-2] | (TRUTH > 127) ^ np.pad(TRUTH > 127, 2)[2:-2, 4:]
    found, notes = read_view(encoded(Image.fromarray(np.where(lines, 0, 255).astype(np.uint8))))
    assert notes[0].startswith("a line sketch") and overlap(found.mask, TRUTH) > 0.6


def test_an_object_that_leaves_the_picture_is_told():
    picture, _ = photograph(stool())
    mask = cut_out(stool()).getchannel("A").crop((0, 0, 256, 150))
    _, notes = read_view(encoded(picture.crop((0, 0, 256, 150))), encoded(mask))
    assert notes[1] == "the object leaves the picture at the bottom: what is there is not seen"


def test_a_file_that_is_no_picture_is_refused():
    with pytest.raises(UnreadableError, match="not a picture that is read"):
        read_view(b"solid nothing")


def test_a_drawing_is_its_silhouette():
    mask = view_of(sw.Drawing(shapely.box(0, 0, 4, 2))).mask
    rows, columns = (np.flatnonzero((mask > 127).any(axis=axis)) for axis in (1, 0))
    assert len(columns) == pytest.approx(2 * len(rows), abs=2)
