import numpy as np

from shapewright.axes.linear import Linear, log_softmax


def test_what_tells_the_right_turn_is_learned():
    rng = np.random.default_rng(0)
    looks, right = rng.normal(size=(60, 24, 3)), np.zeros((60, 24), dtype=bool)
    right[np.arange(60), (2.0 * looks[..., 0] - looks[..., 1]).argmax(axis=1)] = True
    linear = Linear.learned(looks[:40], right[:40])
    assert right[40:][np.arange(20), linear.log_likely(looks[40:]).argmax(axis=1)].mean() > 0.8
    assert abs(linear.weights[2]) < 0.3 * abs(linear.weights[0])


def test_turns_that_are_all_right_teach_nothing():
    looks = np.random.default_rng(1).normal(size=(10, 24, 3))
    np.testing.assert_allclose(Linear.learned(looks, np.ones((10, 24), dtype=bool)).weights, 0.0, atol=1e-6)


def test_likelihoods_add_up_to_one_however_large_the_values():
    logs = log_softmax(np.array([[1e4, 0.0, -1e4], [0.0, 0.0, 0.0]]))
    np.testing.assert_allclose(np.exp(logs).sum(axis=1), 1.0)
