import numpy as np
import pytest
from scipy.optimize import minimize

from shapewright.search.descent import bounded_step, learn_slope


def problem(seed, count=4, size=60):
    rng = np.random.default_rng(seed)
    jacobian = rng.standard_normal((count, size)) * 100
    return jacobian, -(rng.uniform(-0.2, 0.2, count) @ jacobian) + rng.laplace(size=size)


@pytest.mark.parametrize("seed", range(5))
def test_the_step_is_nearly_as_good_as_a_long_search_finds(seed):
    jacobian, residual = problem(seed)
    low, high = np.full(4, -0.1), np.full(4, 0.1)

    def cost(step):
        return float(np.abs(residual + step @ jacobian).sum())

    step = bounded_step(jacobian, residual, low, high, 1.0)
    best = min(
        minimize(cost, start, method="Nelder-Mead", bounds=[(-0.1, 0.1)] * 4, options={"maxiter": 4000}).fun
        for start in (np.zeros(4), step)
    )
    assert (step >= low).all() and (step <= high).all()
    assert cost(step) <= 1.02 * best < cost(np.zeros(4))


def test_a_parameter_without_room_or_effect_stays():
    jacobian, residual = problem(0)
    jacobian[2] = 0.0
    high = np.array([0.1, 0.0, 0.1, 0.1])
    step = bounded_step(jacobian, residual, -high, high, 1.0)
    assert step[1] == 0.0 and step[2] == 0.0 and step[0] != 0.0


def test_slopes_agree_with_the_last_step_and_stay_across_it():
    slopes = np.array([[1.0, 2.0], [3.0, 4.0]])
    step, change = np.array([0.1, 0.0]), np.array([0.5, 0.5])
    learn_slope(slopes, step, change)
    assert np.allclose(step @ slopes, change) and np.allclose(slopes[1], [3.0, 4.0])
    learn_slope(slopes, np.zeros(2), change)
    assert np.isfinite(slopes).all()
