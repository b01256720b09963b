import io

import numpy as np
from PIL import Image

from shapewright.comparison.surfaces import sample
from shapewright.feedback.trials.cards import Example, card
from shapewright.modelling.solids import box


def test_a_card_marks_what_is_missing_on_the_reference_alone():
    top, foot = box((1, 0.2, 1), at=(0, 0.4, 0)), box((1, 0.2, 1), at=(0, -0.4, 0))
    reference = (top | foot | box((0.2, 1, 0.2))).mesh().normalised()
    points = sample(reference, 4000).points
    example = Example(reference, points[points[:, 1] < -0.3], top.mesh(), reference)
    picture = np.array(Image.open(io.BytesIO(card([example, example], 120))))
    assert picture.shape == (240, 360, 4)
    assert not picture[0, 0, 3] and picture[60:120, 30:90, 3].max() == 255  # the ground is whatever it is shown on
    coloured = np.ptp(picture[:, :, :3].astype(int), axis=2) > 20
    assert coloured[60:120, :120].mean() > 0.1 and not coloured[:50, :120].any() and not coloured[:, 120:].any()
    shown = picture[:120, :120, 3] > 0
    assert shown.any(axis=1).mean() > 0.85 or shown.any(axis=0).mean() > 0.85  # as large as its cell
    assert (picture[:120] == picture[120:]).all()


def test_hidden_points_leave_no_mark():
    mesh = box(1).mesh()
    behind = np.array([[0.0, 0.0, -0.5], [-0.5, 0.0, 0.0], [0.0, 0.0, 0.0]])
    picture = np.array(Image.open(io.BytesIO(card([Example(mesh, behind, mesh, mesh)], 100))))
    assert np.ptp(picture[:, :, :3].astype(int), axis=2).max() == 0
