"""Objects before a plain background."""

import numpy as np
import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.views.ground import foreground
from stools import photograph, stool

WALLS = [(225, 228, 230), (120, 160, 125), (245, 244, 240), (70, 72, 80)]


def agreement(found, truth):
    return (found & truth).sum() / (found | truth).sum()


@pytest.mark.parametrize("wall", WALLS)
def test_a_plain_wall_and_a_soft_shadow_are_not_the_object(wall):
    picture, truth = photograph(stool(), wall=wall)
    found, note = foreground(np.asarray(picture, np.float32))
    assert agreement(found, truth) > 0.93
    assert note.startswith("the plain background was removed")


def test_what_shows_through_an_object_is_background():
    picture, truth = photograph(stool(), (0.0, 2.0, 0.2), noise=1.0)
    found, _ = foreground(np.asarray(picture, np.float32))
    rows, columns = np.nonzero(truth)
    between = slice(int(rows.max() * 0.5 + rows.min() * 0.5) + 30, rows.max() - 5)
    middle = int(columns.mean())
    assert not truth[between, middle].any() and not found[between, middle].any()


def test_a_background_that_is_not_plain_is_refused_with_the_way_out():
    noise = np.random.default_rng(0).integers(0, 255, (80, 80, 3)).astype(np.float32)
    with pytest.raises(UnreadableError, match=r"not plain.*NAME\.mask\.png"):
        foreground(noise)


def test_an_empty_wall_is_refused():
    with pytest.raises(UnreadableError, match="nothing in the picture stands out"):
        foreground(np.full((60, 80, 3), 200.0, np.float32))
