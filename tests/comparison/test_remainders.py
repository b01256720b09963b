import numpy as np
import pytest

from shapewright.comparison.remainders import mixed, remainder
from shapewright.modelling.drawing import box as area
from shapewright.modelling.solids import box
from shapewright.shapes import Drawing

TOP = box((1, 0.06, 0.6), at=(0, 0.77, 0))
LEGS = box((0.06, 0.8, 0.06), at=(0.47, 0.4, 0.27)).mirror("x", keep=True).mirror("z", keep=True)
TABLE, SHELF, BACK = TOP | LEGS, box((0.94, 0.05, 0.54), at=(0, 0.3, 0)), box((1, 0.5, 0.04), at=(0, 0.55, -0.28))
LOW = box((1, 0.06, 0.9), at=(0, 0.5, 0)) | box((0.1, 0.5, 0.1), at=(0.45, 0.25, 0.4)).mirror("x", keep=True).mirror(
    "z", keep=True
)


def test_nothing_is_left_of_equal_shapes():
    assert not remainder(TABLE.mesh(), TABLE.mesh()).any()


def test_what_is_missing_is_not_what_is_too_much():
    missing, surplus = remainder((TABLE | SHELF).mesh(), TABLE.mesh()), remainder(TABLE.mesh(), (TABLE | SHELF).mesh())
    half = len(missing) // 2
    assert np.linalg.norm(missing) == pytest.approx(1.0) and not missing[half:].any() and not surplus[:half].any()
    assert missing[:half] == pytest.approx(surplus[half:])


def test_misfits_that_lack_the_same_are_nearer_than_those_that_look_alike():
    lacking = [(TABLE | SHELF, TABLE), (TABLE | BACK, TABLE), (LOW | SHELF, LOW)]
    left = np.stack([remainder(reference.mesh(), replica.mesh()) for reference, replica in lacking])
    alike = np.array([[0.0, 0.3, 0.6], [0.3, 0.0, 0.6], [0.6, 0.6, 0.0]])  # of the references: the first two look alike
    apart = mixed(alike, left, left)
    assert apart[0, 2] < apart[0, 1] and apart == pytest.approx(apart.T)
    assert np.diag(apart) == pytest.approx(0.0) and apart.max() <= 1.0


def test_without_a_replica_all_of_the_reference_is_missing():
    left = remainder(TABLE.mesh(), None)
    assert left[: len(left) // 2].any() and not left[len(left) // 2 :].any()


def test_drawings_are_compared_by_their_ink():
    frame = area((1, 0.1), at=(0, 0.95)) | area((0.1, 1), at=(0.45, 0.5)).mirror("x", keep=True)
    barred = Drawing((frame | area((0.8, 0.06), at=(0, 0.3))).geometry)
    left = remainder(barred, Drawing(frame.geometry)).reshape(2, 16, 16)
    assert not left[1].any() and left[0].sum(axis=1).argmax() in (10, 11, 12)  # below the middle
