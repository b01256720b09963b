import numpy as np

from shapewright.axes.turns import AFTER, AS_IT_IS, INVERSE, SOURCES, TURNS, UPRIGHT, UPS, VIEWS, turn_index
from shapewright.modelling.solids import box
from shapewright.rendering.surround import Surround
from shapewright.shapes import Mesh


def test_they_are_the_24_rotations_and_none_mirrors():
    assert len({turn.tobytes() for turn in TURNS}) == 24
    np.testing.assert_allclose(np.linalg.det(TURNS), 1.0)
    np.testing.assert_array_equal(TURNS[AS_IT_IS], np.eye(3))


def test_one_after_another_is_a_turn_again():
    for first in range(24):
        for second in range(24):
            np.testing.assert_array_equal(TURNS[AFTER[second, first]], TURNS[second] @ TURNS[first])
        assert AFTER[INVERSE[first], first] == AFTER[first, INVERSE[first]] == AS_IT_IS
        assert turn_index(TURNS[first]) == first


def test_turns_about_the_up_axis_keep_what_is_up():
    np.testing.assert_array_equal(TURNS[UPRIGHT] @ [0, 1, 0], [[0, 1, 0]] * 4)
    for one in range(24):
        up = [other for other in range(24) if np.array_equal(TURNS[one][1], TURNS[other][1])]
        assert [other for other in range(24) if UPS[other] == UPS[one]] == up
        assert len(up) == 4


def test_a_turned_shape_has_the_same_pictures_in_other_places():
    corner = box((1, 0.3, 0.6)) | box((0.2, 0.9, 0.3), at=(-0.4, 0.5, 0.1)) | box((0.3, 0.3, 0.9), at=(0.35, 0.3, 0.4))
    shape = corner.mesh().normalised()
    before = Surround.of(shape, slice(0, len(VIEWS))).nearness
    for turn, sources in zip(TURNS, SOURCES, strict=True):
        after = Surround.of(Mesh(shape.vertices @ turn.T, shape.faces), slice(0, len(VIEWS))).nearness
        moved = np.stack([np.rot90(before[view], quarters) for view, quarters in sources])
        assert np.mean(np.abs(after - moved) > 1e-3) < 0.01  # a pixel on an edge may fall to either side
