import numpy as np

from shapewright.modelling.solids import box
from shapewright.studio.bench.exploring.layout import layout
from shapewright.studio.bench.exploring.looks import look_at

POSTS = [box((0.1, 1, 0.1 + 0.02 * i)).mesh().normalised() for i in range(4)]
PLATES = [box((1, 0.1, 0.8 + 0.05 * i)).mesh().normalised() for i in range(4)]


def test_alike_shapes_are_near_each_other_and_the_map_is_the_same_each_time():
    seen = np.stack([look_at(shape) for shape in (*POSTS, *PLATES)])
    places = layout(seen)
    assert places.shape == (8, 2) and np.abs(places).max() == 1.0
    within = max(np.ptp(places[:4], axis=0).max(), np.ptp(places[4:], axis=0).max())
    assert np.linalg.norm(places[:4].mean(axis=0) - places[4:].mean(axis=0)) > within
    assert (layout(seen) == places).all()
    assert np.allclose(layout(seen[::-1])[::-1], places)


def test_few_shapes_and_equal_ones_have_places_too():
    one = look_at(POSTS[0])
    assert layout(np.empty((0, *one.shape), np.uint8)).shape == (0, 2)
    assert (layout(one[None]) == 0.0).all()
    assert np.isfinite(layout(np.stack([one, one, one]))).all()
