import numpy as np
import pytest

from shapewright.feedback.surfaces.areas import areas
from shapewright.modelling.drawing import box
from shapewright.shapes import Drawing

FRAME = box((1, 0.1), at=(0, 0.95)) | box((0.1, 1), at=(0.45, 0.5)).mirror("x", keep=True)
BARRED = FRAME | box((0.8, 0.06), at=(0, 0.3))


def drawn(sketch):
    return Drawing(sketch.geometry)


def test_what_the_replica_lacks_is_found_in_its_place():
    (region,) = areas(drawn(BARRED), drawn(FRAME))
    assert region.side == "unexplained"
    assert region.box.centre == pytest.approx([0.0, -0.2, 0.0], abs=0.01)
    assert sorted(region.box.size) == pytest.approx([0.0, 0.06, 0.76], abs=0.02)
    assert region.share == pytest.approx(0.06 * 0.76 / drawn(BARRED).geometry.area, abs=0.005)


def test_what_the_replica_has_too_much_is_surplus():
    found = areas(drawn(FRAME), drawn(BARRED))
    assert [region.side for region in found] == ["surplus"] and found.of("unexplained") == ()


def test_a_line_that_is_a_little_aside_is_not_a_region():
    aside = FRAME | box((0.8, 0.06), at=(0, 0.31))
    assert not areas(drawn(BARRED), drawn(aside)).regions


def test_drawings_are_not_turned_or_mirrored():
    one_sided = box((1, 0.1), at=(0, 0.95)) | box((0.1, 1), at=(0.45, 0.5))
    found = areas(drawn(one_sided), drawn(one_sided.mirror("x")))
    middles = {region.side: region.box.centre[0] for region in found}
    assert middles["unexplained"] > 0.3 and middles["surplus"] < -0.3


def test_points_lie_in_their_region():
    (region,) = areas(drawn(BARRED), drawn(FRAME))
    assert len(region.points) > 100 and np.abs(region.points[:, 1] + 0.2).max() < 0.04
