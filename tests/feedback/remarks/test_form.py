"""The form of pieces that a replica lacks."""

import numpy as np
import pytest

from shapewright.feedback.remarks.form import form_of
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.modelling.solids import box, cylinder

BASE = box((1, 0.1, 1), at=(0, -0.45, 0))


def form(*extra):
    whole = BASE
    for solid in extra:
        whole = whole | solid
    reference = whole.mesh()
    missing = residuals(reference, BASE.mesh()).of("unexplained")
    return form_of(missing[0], missing, reference.normalised())


@pytest.mark.parametrize(
    ("solid", "kind", "lie"),
    [
        (box((0.08, 0.8, 0.08), at=(0, 0, 0)), "bar", "upright"),
        (box((0.8, 0.06, 0.06), at=(0, 0.2, 0)), "bar", "lying"),
        (box((0.9, 0.05, 0.8), at=(0, 0.2, 0)), "plate", "lying"),
        (box((0.9, 0.7, 0.05), at=(0, 0, -0.4)), "plate", "upright"),
        (box((0.5, 0.5, 0.5), at=(0, 0, 0)), "block", "lying"),
        ((cylinder((0.8, 0.06, 0.8)) - cylinder((0.66, 0.2, 0.66))).rotate(90, "x"), "ring", "upright"),
        (box((0.06, 0.9, 0.06)).rotate(40, "z"), "bar", "sloping"),
    ],
)
def test_a_single_piece(solid, kind, lie):
    found = form(solid)
    assert found.kind == kind and found.copies == 1
    assert found.lie == lie or kind == "block"


def test_copies_are_counted_and_told_with_their_size():
    found = form(*(cylinder((0.08, 0.7, 0.08), at=(x, 0, 0.3)) for x in (-0.3, 0.3)))
    assert found.copies == 2 and found.symmetric
    assert found.words.startswith("2 upright bars of about 0.0") and found.size[1] == pytest.approx(0.7, abs=0.06)


def test_what_stands_on_one_side_alone_is_not_symmetric():
    assert not form(box((0.08, 0.7, 0.08), at=(0.3, 0, 0))).symmetric
    assert form(box((0.08, 0.7, 0.08), at=(0, 0, 0.2))).symmetric


def test_a_hood_is_a_shell():
    hood = box((0.6, 0.5, 0.6), at=(0, 0.3, 0)) - box((0.54, 0.5, 0.54), at=(0, 0.2, 0))
    assert form(hood).kind == "shell" and np.isfinite(form(hood).size).all()
