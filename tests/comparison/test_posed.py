import math
from itertools import pairwise

import numpy as np
import pytest

from shapewright.comparison.light_field.aligned import AlignedCost
from shapewright.comparison.posed import PosedDifference
from shapewright.modelling.drawing import circle
from shapewright.modelling.solids import box, cone, cylinder, revolve
from shapewright.shapes import Mesh

NEEDLE = Mesh(np.array([[0.0, 0, 0], [1e-9, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))


def wine_glass():
    return revolve([(0, 0), (0.3, 0), (0.3, 0.04), (0.04, 0.06), (0.04, 0.5), (0.3, 0.7), (0.28, 1), (0, 0.55)])


def fir():
    crowns = [cone((1.0 - 0.25 * tier, 0.5, 1.0 - 0.25 * tier), at=(0, 0.5 + 0.3 * tier, 0)) for tier in range(3)]
    return cylinder((0.15, 0.3, 0.15), at=(0, 0.15, 0)) | crowns[0] | crowns[1] | crowns[2]


def seat(arm=0.3):
    """It has one arm, so it is not its own mirror image."""
    back = box((1, 0.8, 0.1), at=(0, 0.6, -0.45))
    return box((1, 0.2, 1)) | back | box((0.1, arm, 1), at=(0.45, 0.1 + arm / 2, 0))


def on_its_head(solid):
    return solid.rotate(180, "x")


def cost(reference, replica):
    return PosedDifference(reference.mesh())(replica.mesh())


def test_equal_shapes_differ_in_nothing_wherever_they_stand_and_whatever_their_size():
    for solid in (wine_glass(), fir(), seat()):
        difference = PosedDifference(solid.mesh())
        assert not difference.residual(solid.mesh()).any() and difference(solid.mesh()) == 0.0
        moved = Mesh(solid.mesh().vertices * 2.0 + 4.0, solid.mesh().faces)
        assert difference(moved) < 0.02 * difference(box((1, 1, 1)).mesh())


@pytest.mark.parametrize("solid", [wine_glass(), fir()])
def test_a_shape_on_its_head_costs_much_though_the_light_field_hardly_sees_it(solid):
    light = AlignedCost(solid.mesh())
    wider = solid.scale((1.05, 1, 1.05))
    assert light(on_its_head(solid).mesh()) < 0.25 * light(wider.mesh())
    assert cost(solid, on_its_head(solid)) > 4.0 * cost(solid, wider)


def test_the_pictures_change_evenly_with_a_leg_whose_edges_move_by_less_than_a_sample():
    def table(leg):
        return box((1, 0.1, 0.6)) | box((leg, 0.6, leg), at=(0.2, -0.3, 0.1))

    difference = PosedDifference(table(0.1).mesh())
    light = len(AlignedCost(table(0.1).mesh()).light(table(0.1).mesh().normalised()))
    residuals = [difference.residual(table(0.1 + 0.002 * step).mesh()) for step in range(1, 9)]
    steps = np.diff([0.0, *(np.abs(residual[light:]).sum() for residual in residuals)])
    assert steps.min() > 0.0 and steps.max() < 3.0 * steps.min()  # 11 times where the cameras have no roll


def test_a_mirrored_shape_costs_more_than_one_whose_arm_is_a_little_higher():
    assert cost(seat(), seat().mirror("x")) > 5.0 * cost(seat(), seat(arm=0.35))


def test_a_hollow_counts_about_alike_from_whichever_side_it_opens():
    sides = [sign * 0.45 * np.eye(3)[axis] for axis in range(3) for sign in (-1, 1)]
    costs = [cost(box(1), box(1) - box(0.8, at=tuple(side))) for side in sides]
    assert min(costs) > 0.7 * max(costs) > 0.0


def test_it_grows_evenly_with_a_difference():
    difference = PosedDifference(seat(arm=0.3).mesh())
    residuals = [difference.residual(seat(arm).mesh()) for arm in np.linspace(0.3, 0.4, 21)]
    costs = [np.abs(residual).sum() for residual in residuals]
    steps = [np.abs(after - before).sum() for before, after in pairwise(residuals)]
    assert costs == sorted(costs)
    assert max(steps) < 2.5 * np.mean(steps)


def test_what_cannot_be_compared_has_no_residual():
    difference = PosedDifference(seat().mesh())
    for replica in (NEEDLE, circle(1).drawing()):
        assert difference.residual(replica) is None and difference(replica) == math.inf
