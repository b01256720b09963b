"""The labelled parts of a replica that is laid over its reference."""

import numpy as np
import pytest

from shapewright.feedback.remarks.part_boxes import parts_of
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.modelling.solids import box


def legs():
    return box((0.1, 0.6, 0.1), at=(0.4, 0.3, 0.2)).mirror("x", keep=True).mirror("z", keep=True).label("legs")


def top():
    return box((1, 0.1, 0.6), at=(0, 0.65, 0)).label("top")


def test_a_part_has_a_box_for_each_of_its_pieces():
    mesh = (legs() | top()).mesh()
    parts = {part.label: part for part in parts_of(residuals(mesh, mesh))}
    assert set(parts) == {"legs", "top"} and len(parts["legs"].pieces) == 4 and len(parts["top"].pieces) == 1
    assert np.ptp(parts["legs"].bounds[:, 0]) == pytest.approx(0.9)


def test_parts_stand_where_the_replica_is_laid():
    reference = (legs() | top() | box((0.1, 0.5, 0.1), at=(0, 0.95, 0))).mesh()  # a pole above moves the middle
    parts = {part.label: part for part in parts_of(residuals(reference, (legs() | top()).mesh()))}
    own = reference.normalised().bounds
    assert parts["legs"].bounds[0, 1] == pytest.approx(own[0, 1], abs=0.01)
    assert parts["top"].bounds[1, 1] == pytest.approx(own[0, 1] + 0.7 / 1.2, abs=0.01)


def test_a_replica_without_labels_has_no_parts():
    from shapewright.shapes import Mesh

    solid = top().mesh()
    assert parts_of(residuals(solid, Mesh(solid.vertices, solid.faces))) == ()
