"""Views of objects as shapes."""

import numpy as np
import pytest

from shapewright.shapes import View, Views, shape_digest
from shapewright.shapes.views import SIDE

MASK = np.zeros((SIDE, SIDE), np.uint8)
MASK[100:200, 50:270] = 255


@pytest.mark.parametrize("mask", [MASK[:10], MASK.astype(float), MASK[None]])
def test_a_mask_of_another_form_is_refused(mask):
    with pytest.raises(ValueError, match="mask has the form"):
        View(mask)


def test_a_picture_of_another_form_is_refused():
    with pytest.raises(ValueError, match="picture has the form"):
        View(MASK, np.zeros((SIDE, SIDE), np.uint8))


def test_a_mask_that_shows_nothing_is_refused():
    with pytest.raises(ValueError, match="shows nothing"):
        View(np.zeros_like(MASK))


def test_an_object_has_at_least_one_view():
    with pytest.raises(ValueError, match="no views"):
        Views(())


def test_views_are_framed_already_and_known_by_their_masks():
    views, others = Views((View(MASK),)), Views((View(MASK[::-1].copy()),))
    assert views.normalised() is views and views.normalisation().scale == 1.0
    assert shape_digest(views) == shape_digest(Views((View(MASK.copy()),))) != shape_digest(others)
    assert len(views) == 1 and repr(Views((View(MASK),) * 2)) == "Views(2 views)"
