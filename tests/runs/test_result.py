"""Replicas as a run keeps them."""

import numpy as np
import pytest
import shapely

from shapewright.modelling.solids import box
from shapewright.runs.result import read_replica, replica_path
from shapewright.shapes import Drawing
from shapewright.shapes.files import encode

SOLID = (box(1).label("seat") | box(1, at=(2, 0, 0))).mesh()
DRAWING = Drawing(shapely.box(0, 0, 2, 1))


@pytest.mark.parametrize(("shape", "suffix"), [(SOLID, "glb"), (DRAWING, "svg")])
def test_a_replica_is_read_back(tmp_path, shape, suffix):
    path = replica_path(shape, "a")
    assert path == f"replicas/a.{suffix}"
    (tmp_path / "replicas").mkdir()
    (tmp_path / path).write_bytes(encode(shape))
    again = read_replica(tmp_path, {"replica": path})
    np.testing.assert_allclose(again.bounds, shape.bounds)
    if shape is SOLID:
        assert sorted(map(str, again.labels)) == sorted(map(str, shape.labels))


def test_an_entry_without_a_replica_has_none(tmp_path):
    assert replica_path(None, "a") is None
    assert read_replica(tmp_path, {"replica": None}) is None
