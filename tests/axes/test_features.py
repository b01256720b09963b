import numpy as np

from shapewright.axes.everyday import everyday
from shapewright.axes.features import features
from shapewright.axes.sides import Sides
from shapewright.axes.turns import AFTER, TURNS
from shapewright.modelling.solids import box
from shapewright.shapes import Mesh

CORNER = box((1, 0.3, 0.6)) | box((0.2, 0.9, 0.3), at=(-0.4, 0.5, 0.1)) | box((0.3, 0.3, 0.9), at=(0.35, 0.3, 0.4))
SHAPE = CORNER.mesh()


SQUARE = Mesh([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]], [[0, 1, 2], [0, 2, 3]])


def test_features_of_a_turned_shape_are_those_of_the_turn():
    before = features(Sides.of(SHAPE))
    assert before.shape == (24, len(everyday()["mean"]))
    for number, turn in enumerate(TURNS):
        after = features(Sides.of(SHAPE.transformed(turn)))
        np.testing.assert_allclose(after, before[AFTER[:, number]], atol=0.02)


def test_what_stands_on_legs_touches_the_ground_in_few_places():
    stool = box((1, 0.1, 1), at=(0, 0.5, 0))
    for x, z in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        stool = stool | box((0.1, 0.5, 0.1), at=(0.45 * x, 0.25, 0.45 * z))
    below_above = features(Sides.of(stool.mesh()))[0, -3]
    assert below_above < -0.9  # of the box: the ground under it, less its top


def test_no_feature_is_lost_for_a_flat_shape():
    assert np.isfinite(features(Sides.of(SQUARE))).all()
