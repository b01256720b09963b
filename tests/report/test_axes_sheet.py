from typing import get_args

import pytest

from shapewright.references.orientation import AxesBy
from shapewright.report.axes_sheet import draw_sheet


@pytest.mark.parametrize("by", get_args(AxesBy))
def test_whoever_says_how_a_reference_stands_is_named(tmp_path, by):
    axes = {"scan": {"up": "z", "front": "x", "by": by}}
    sheet = draw_sheet(tmp_path, [{"name": "scan", "slug": "scan"}], axes)
    assert len(sheet.crop((0, 192, 192, 222)).getcolors()) > 2
