import numpy as np

from shapewright.comparison.light_field.aligned import AlignedCost
from shapewright.feedback.ideas.hypotheses import hypotheses
from shapewright.feedback.ideas.hypothesis import ALL_OTHERS, Hypothesis, applied
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.modelling.solids import box, cylinder


def top():
    return box((1, 0.06, 0.7), at=(0, 0.32, 0)).label("top")


def legs(spread=1.0):
    x, z = 0.47 * spread, 0.32 * spread
    return box((0.06, 0.64, 0.06), at=(x, 0, z)).mirror("x", keep=True).mirror("z", keep=True).label("legs")


def found(reference, replica):
    cost = AlignedCost(reference)
    shape = reference.normalised()
    return hypotheses(residuals(shape, replica), shape, replica, lambda meshes: [cost(mesh) for mesh in meshes])


def test_a_missing_shelf_is_found():
    replica = (top() | legs()).mesh()
    best = found((top() | legs() | box((0.9, 0.04, 0.6), at=(0, -0.1, 0))).mesh(), replica)[0]
    (shelf,) = best.pieces
    assert best.removed == () and shelf.noun == "plate" and best.cost < 0.3 * best.before
    np.testing.assert_allclose(shelf.centre, (0, -0.1, 0), atol=0.03)


def test_a_pedestal_in_place_of_legs():
    pedestal = cylinder((0.1, 0.6, 0.1)) | cylinder((0.5, 0.05, 0.5), at=(0, -0.29, 0))
    best = found((top() | pedestal).mesh(), (top() | legs()).mesh())[0]
    assert best.removed == ("legs",) and {piece.noun for piece in best.pieces} >= {"column", "disc"}
    assert best.cost < 0.4 * best.before


def test_legs_that_stand_further_in():
    several = found((top() | legs(0.7)).mesh(), (top() | legs()).mesh())
    (drawn,) = [each for each in several if each.inset == ("legs",)]
    assert drawn.scale[0] < 0.8 and drawn.cost < 0.5 * drawn.before and not drawn.pieces


def splayed(by):
    return legs().taper((by, 1.0), "-y").label("legs")


def test_legs_that_lean_outwards():
    several = found((top() | splayed(1.5)).mesh(), (top() | legs()).mesh())
    assert several[0].splayed == ("legs",) and not several[0].removed
    assert several[0].scale == (1.4, 1.0) and several[0].cost < 0.5 * several[0].before


def test_legs_that_lean_outwards_where_a_runner_goes():
    runner = box((0.06, 0.06, 0.7), at=(0.47, -0.29, 0)).mirror("x", keep=True).label("runner")
    best = found((top() | splayed(1.8)).mesh(), (top() | legs() | runner).mesh())[0]
    assert best.splayed == ("legs",) and best.removed == ("runner",) and best.scale == (1.7, 1.0)


def test_only_what_stands_on_the_floor_leans():
    sloping = top().taper((1.4, 1.0), "-y").label("top")
    assert not any(each.splayed for each in found((sloping | legs()).mesh(), (top() | legs()).mesh()))


def test_a_round_foot_that_is_square():
    pole = box((0.05, 1, 0.05)).label("pole")
    square, disc = box((0.5, 0.04, 0.5), (0, -0.48, 0)), cylinder((0.56, 0.04, 0.56), (0, -0.48, 0))
    for theirs, ours, kind in ((square, disc, "box"), (disc, square, "cylinder")):
        best = found((pole | theirs).mesh(), (pole | ours.label("foot")).mesh())[0]
        assert best.removed == ("foot",) and [piece.kind for piece in best.pieces] == [kind]
        assert best.cost < 0.5 * best.before


def test_nothing_is_proposed_for_equal_shapes():
    mesh = (top() | legs()).mesh()
    assert found(mesh, mesh) == []


def test_applying_a_hypothesis():
    replica = (top() | legs()).mesh()
    bare = applied(Hypothesis(removed=("legs",)), replica)
    np.testing.assert_allclose(bare.bounds[:, 1], [0.29, 0.35])
    inset = applied(Hypothesis(removed=("top",), inset=(ALL_OTHERS,), scale=(0.5, 1.0)), replica)
    np.testing.assert_allclose(inset.extent, [0.5, 0.64, 0.7], atol=0.01)
    apart = applied(Hypothesis(splayed=("legs",), scale=(1.5, 1.0)), replica)
    np.testing.assert_allclose(apart.extent, [1.5, 0.67, 0.7], atol=0.01)
    assert np.abs(apart.vertices[apart.vertices[:, 1] > 0.28, 0]).max() < 0.52
    assert applied(Hypothesis(), replica).faces.shape == replica.faces.shape
