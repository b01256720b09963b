import numpy as np
import pytest

from shapewright.feedback.surfaces.oriented_boxes import fit_box


def filled(size, seed=0, count=500):
    return (np.random.default_rng(seed).random((count, 3)) - 0.5) * size


def test_upright_points_get_an_upright_box():
    found = fit_box(filled((1, 0.2, 0.4)) + np.array([1, 2, 3]))
    assert np.array_equal(found.axes, np.eye(3))
    assert np.allclose(found.centre, (1, 2, 3), atol=0.02) and np.allclose(found.size, (1, 0.2, 0.4), atol=0.02)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_turned_bar_gets_a_turned_box(axis):
    angle = np.radians(30)
    turn = np.eye(3)
    u, v = (i for i in range(3) if i != axis)
    turn[[u, u, v, v], [u, v, u, v]] = np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)
    size = np.full(3, 0.05)
    size[u] = 1.0
    found = fit_box(filled(size) @ turn.T)
    assert np.allclose(found.size, size, atol=0.02)
    assert np.linalg.det(found.axes) == pytest.approx(1.0) and np.all(np.diagonal(found.axes) > 0)


def test_flat_and_few_points_have_boxes():
    flat = fit_box(filled((1, 0, 1)))
    assert flat.size[1] == 0.0
    line = fit_box(np.linspace([0, 0, 0], [1, 1, 1], 20))
    assert np.isclose(np.prod(line.size + 1e-3), 0.0, atol=1e-3) and line.size.max() == pytest.approx(
        np.sqrt(3), rel=0.2
    )
