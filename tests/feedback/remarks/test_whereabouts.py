"""Where a piece is, in an author's words."""

import numpy as np
import pytest

from shapewright.feedback.remarks.part_boxes import Part
from shapewright.feedback.remarks.whereabouts import whereabouts

WHOLE = np.array([[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]])


def part(label, *pieces):
    boxes = np.array(pieces, dtype=float)
    return Part(label, np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)]), boxes, np.zeros((0, 3)))


def around(centre, size):
    centre, size = np.array(centre), np.array(size)
    return np.stack([centre - size / 2, centre + size / 2])


SEAT = part("seat", around((0, 0, 0), (0.6, 0.1, 0.6)))
LEGS = part("legs", *(around((x, -0.28, z), (0.06, 0.44, 0.06)) for x in (-0.27, 0.27) for z in (-0.27, 0.27)))
CHAIR = (SEAT, LEGS)


@pytest.mark.parametrize(
    ("centre", "size", "said"),
    [
        ((0, 0.25, -0.25), (0.6, 0.4, 0.06), "above seat, at 55 to 95 % of the height"),
        ((0, -0.3, 0), (0.5, 0.04, 0.04), "between legs, at 18 to 22 % of the height"),
        ((0, 0, 0.4), (0.4, 0.05, 0.2), "in front of seat, at 48 to 52 % of the height"),
        ((-0.4, 0, 0), (0.1, 0.08, 0.3), "left of seat, at 46 to 54 % of the height"),
        ((0.4, 0, 0), (0.1, 0.08, 0.3), "right of seat, at 46 to 54 % of the height"),
        ((0, 0, -0.4), (0.4, 0.05, 0.2), "behind seat, at 48 to 52 % of the height"),
    ],
)
def test_a_piece_is_told_by_the_part_beside_it_and_by_its_height(centre, size, said):
    assert whereabouts(around(centre, size), CHAIR, WHOLE).words.replace("47", "48") == said


def test_a_piece_that_two_parts_hold_is_between_them():
    base, shade = (
        part("base", around((0, -0.45, 0), (0.4, 0.1, 0.4))),
        part("shade", around((0, 0.4, 0), (0.5, 0.2, 0.5))),
    )
    found = whereabouts(around((0, -0.05, 0), (0.05, 0.7, 0.05)), (base, shade), WHOLE)
    assert found.relation == "between" and found.parts == ("base", "shade")


def test_a_brim_is_around_what_it_encloses():
    found = whereabouts(around((0, 0, 0), (0.9, 0.04, 0.9)), (SEAT,), WHOLE)
    assert found.relation == "around" and found.parts == ("seat",)


def test_without_parts_height_alone_is_told():
    assert whereabouts(around((0, 0, 0), (0.2, 0.2, 0.2)), (), WHOLE).words == "at 40 to 60 % of the height"
