import numpy as np
import pytest

from shapewright.axes.sides import Sides
from shapewright.axes.turns import TURNS, UPRIGHT
from shapewright.modelling.solids import box, cylinder
from shapewright.shapes import Mesh

ALIKE = 0.05


def table(width=1.0, depth=1.0):
    legs = [
        box((0.1, 0.7, 0.1), at=(x * (width / 2 - 0.05), 0.35, z * (depth / 2 - 0.05)))
        for x in (1, -1)
        for z in (1, -1)
    ]
    top = box((width, 0.1, depth), at=(0, 0.7, 0))
    for leg in legs:
        top = top | leg
    return top.mesh()


def test_a_box_looks_the_same_on_all_sides_but_for_its_proportions():
    looks, whole = Sides.of(box((1, 0.4, 0.7)).mesh()).apart()
    assert looks.max() < ALIKE
    assert sorted(np.flatnonzero(whole < ALIKE)) == [
        i for i, t in enumerate(TURNS) if np.array_equal(np.abs(t), np.eye(3))
    ]


def test_a_square_table_looks_the_same_turned_and_other_on_its_head():
    looks, whole = Sides.of(table()).apart()
    assert set(np.flatnonzero(whole < ALIKE)) == set(UPRIGHT)
    assert np.delete(looks, UPRIGHT).min() > 0.2


def test_a_long_table_has_two_fronts():
    assert (Sides.of(table(depth=0.5)).apart()[1][UPRIGHT] < ALIKE).sum() == 2


def test_a_round_shape_is_alike_from_all_four_sides():
    assert Sides.of(cylinder(1.0, segments=64).mesh()).apart()[1][UPRIGHT].max() < ALIKE


def test_the_middle_of_the_surface_and_the_box_turn_with_the_shape():
    shape = (box((2, 1, 1)) | box((0.5, 3, 0.5), at=(0.5, 1, 0.1))).mesh()
    sides = Sides.of(shape)
    for turn in TURNS:
        turned = Sides.of(shape.transformed(turn))
        np.testing.assert_allclose(turned.centre, turn @ sides.centre, atol=1e-9)
        np.testing.assert_allclose(turned.extent, np.abs(turn) @ sides.extent)


def test_a_flat_shape_has_sides_and_a_point_has_none():
    flat = Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    assert Sides.of(flat).nearness.shape == (6, 64, 64)
    with pytest.raises(ValueError, match="no size"):
        Sides.of(Mesh(np.zeros((3, 3)), [[0, 1, 2]]))
