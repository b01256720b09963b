"""What a network sees of objects in pictures, and of samples to learn from."""

import numpy as np
import pytest

from shapewright.parameters import Prediction
from shapewright.prediction.views.silhouettes import joined, most_similar, redrawn, view_dataset
from shapewright.rendering.cameras import ANYWHERE
from stools import stool, views

VALUES = [
    {"width": width, "back": back, "leg": 0.1, "plinth": plinth}
    for width, back, plinth in ((0.4, 0.2, False), (0.9, 0.7, False), (0.6, 0.5, True), (0.9, 0.2, True))
]


def data(seed=0):
    shapes = [stool(**values).normalised() for values in VALUES]
    return view_dataset(stool.space, VALUES, shapes, 32, seed, threads=1)


def test_each_sample_is_seen_once_from_somewhere():
    samples = data()
    assert samples.images.shape == (4, 1, 2, 32, 32) and samples.cameras == (ANYWHERE,)
    assert (samples.images == data().images).all() and (samples.images != data(1).images).any()


def test_another_epoch_sees_the_same_samples_from_elsewhere():
    samples = data()
    again = redrawn(samples, np.random.default_rng(5), threads=1)
    assert (again.targets == samples.targets).all() and (again.images != samples.images).any()


def test_the_most_similar_samples_of_a_picture_are_those_that_it_shows():
    shown = [views(stool(**values)) for values in VALUES]
    found = most_similar(shown, data(), seed=0, threads=1)
    assert sum(several[0]["plinth"] == values["plinth"] for several, values in zip(found, VALUES, strict=True)) >= 3
    assert all(len({str(values) for values in several}) == 4 for several in found)


def test_views_of_one_object_say_more_together():
    space = stool.space
    chances = np.array([[0.6, 0.4], [0.7, 0.3], [0.1, 0.9]], np.float32)
    scalar = np.array([0.2, 0.4, 0.9], np.float32)
    spread = np.array([0.1, 0.3, 0.1], np.float32)
    columns = tuple(chances if p.classes else scalar for p in space)
    spreads = tuple(None if p.classes else spread for p in space)
    both = joined(Prediction(space, columns, spreads), [2, 1])
    assert len(both) == 2
    assert both.columns[-1][0, 0] == pytest.approx(0.42 / (0.42 + 0.12)) and both.columns[-1][1, 1] == pytest.approx(
        0.9
    )
    assert both.columns[0][0] == pytest.approx(0.25) and both.columns[0][1] == pytest.approx(0.9)
    assert both.spreads[0][0] == pytest.approx(0.15)
