import numpy as np
import pytest

from shapewright.comparison import light_field
from shapewright.comparison.light_field.aligned import AlignedCost
from shapewright.modelling.solids import box, cylinder
from shapewright.shapes import Mesh


def table(height, leg=0.08):
    post = box((leg, height, leg), at=(0.4, 0, 0.3))
    return (box((1, 0.06, 0.8), at=(0, height / 2, 0)) | post.mirror("x", keep=True).mirror("z", keep=True)).mesh()


def test_the_cost_is_nought_for_the_shape_itself_in_any_size_and_place():
    cost = AlignedCost(table(0.7))
    assert cost(table(0.7)) == 0.0
    assert cost(Mesh(table(0.7).vertices * 3.0 + 5.0, table(0.7).faces)) < 30.0


def test_the_cost_bounds_the_raw_distance_from_above_and_orders_shapes_as_it_does():
    reference = table(0.7)
    cost = AlignedCost(reference)
    shapes = [table(0.72), table(0.8), table(1.2), cylinder((1, 0.3, 1)).mesh()]
    costs = [cost(shape) for shape in shapes]
    raw = [light_field.raw_distance(reference, shape) for shape in shapes]
    assert all(c >= r for c, r in zip(costs, raw, strict=True))
    assert costs == sorted(costs) and raw == sorted(raw)


def test_what_no_view_shows_costs_without_end():
    needle = Mesh(np.array([[0.0, 0, 0], [1e-9, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))
    assert AlignedCost(table(0.7))(needle) == pytest.approx(np.inf)


def test_depth_tells_what_silhouettes_cannot():
    case = box((1, 1, 0.4)) - box((0.9, 0.9, 0.4), at=(0, 0, 0.05))
    shelf, other = ((case | box((0.9, 0.04, 0.35), at=(0, y, 0))).mesh() for y in (0.0, 0.3))
    cost, residual = AlignedCost(shelf), AlignedCost(shelf).residual(other)
    assert np.abs(residual).sum() > 2.0 * np.abs(residual[:470]).sum()
    assert cost(other) < 300.0 and len(residual) == len(cost.residual(shelf)) and not cost.residual(shelf).any()
