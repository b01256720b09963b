"""Line sketches, filled inside their outline."""

import numpy as np
import pytest
from PIL import Image, ImageDraw

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.views.sketch import filled, is_sketch


def sketch(gap=0, width=3):
    image = Image.new("1", (200, 200))
    pen = ImageDraw.Draw(image)
    pen.line([(100 + gap, 30), (170, 30), (170, 160), (30, 160), (30, 30), (100, 30)], fill=1, width=width)
    pen.line([(30, 90), (170, 90)], fill=1, width=width)
    return np.asarray(image)


def test_an_outline_is_filled():
    mask, note = filled(sketch())
    assert mask[31:159, 31:169].all() and not mask[:25].any() and note == "a line sketch: filled inside its outline"


def test_small_gaps_are_closed_and_told():
    mask, note = filled(sketch(gap=4))
    assert mask[40:150, 40:160].all() and not mask[:20].any() and "over gaps of up to" in note


def test_an_open_outline_is_refused_with_the_way_out():
    lines = np.zeros((200, 200), bool)
    lines[30:170, 40:43] = lines[167:170, 40:160] = True
    with pytest.raises(UnreadableError, match=r"open.*NAME\.mask\.png"):
        filled(lines)


def test_lines_are_thin_and_areas_are_not():
    assert is_sketch(sketch()) and not is_sketch(filled(sketch())[0]) and not is_sketch(np.zeros((9, 9), bool))
