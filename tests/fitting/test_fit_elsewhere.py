"""A fit, an evaluation and an explanation through an executor: the same results as here."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import shapewright as sw
from shapewright.building import ExecutorError
from shapewright.fitting.pacing.opening import Opening
from shapewright.modelling.solids import box

STOOL = """
from typing import Annotated, Literal
from shapewright import Infeasible, Range, procedure
from shapewright.modelling.solids import box, cylinder

@procedure
def stool(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    seat: Literal["square", "round"] = "square",
    legs: Annotated[int, Range(1, 3)] = 1,
):
    if legs == 2 and seat == "round":
        raise Infeasible("it falls over")
    top = (cylinder if seat == "round" else box)((1, 0.1, 1), at=(0, height, 0))
    return top | box((0.15, height, 0.15), at=(0, height / 2, 0)).array(legs, (0.2, 0, 0))
"""
SETTINGS = sw.Settings(seed=1, samples=160, epochs=2, image_size=32, workers=2, refine_shapes=40)
_TIMES = ("seconds", "build_seconds", "train_seconds", "created", "first_answer", "notices")


class Counting:
    """An executor that counts what it is asked for."""

    def __init__(self, pool):
        self.pool, self.asked = pool, 0

    def submit(self, function, *args):
        self.asked += 1
        return self.pool.submit(function, *args)


@pytest.fixture
def stool(tmp_path):
    (tmp_path / "stool.py").write_text(STOOL)
    return sw.load_procedure(tmp_path / "stool.py")


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(each) for key, each in value.items() if key not in _TIMES}
    return [without_times(each) for each in value] if isinstance(value, list) else value


def test_a_fit_finds_the_same_to_the_bit(stool):
    references = {"low": stool(height=0.4, seat="round"), "pair": stool(legs=3, height=0.8), "block": box((1, 1, 1))}
    collection = sw.Collection.of(references)
    here = sw.fit(stool, collection, SETTINGS)
    with ThreadPoolExecutor(2) as pool:
        executor = Counting(pool)
        far = sw.fit(stool, collection, SETTINGS, executor=executor)
        parts = sw.fit(stool, collection, SETTINGS, executor=pool, chunk=2)
    assert executor.asked > 20
    assert without_times(parts.record) == without_times(here.record)
    assert without_times(far.record) == without_times(here.record)
    for name in references:
        assert np.array_equal(far[name].replica.vertices, here[name].replica.vertices)


def test_an_evaluation_measures_the_same_to_the_bit(stool):
    here = sw.evaluate(stool, SETTINGS, refined=5)
    with ThreadPoolExecutor(2) as pool:
        far = sw.evaluate(stool, SETTINGS, refined=5, executor=pool)
    assert far[0].metrics == here[0].metrics and far[0].refined == here[0].refined
    assert far[0].measured == here[0].measured and far[0].grades == here[0].grades


def test_an_opening_has_an_executor_of_its_own(stool):
    with ThreadPoolExecutor(1) as pool, Opening(stool, SETTINGS, executor=(counting := Counting(pool))) as opening:
        with pytest.raises(ValueError, match="give it to the opening"):
            sw.fit(stool, sw.Collection.of({"a": stool()}), SETTINGS, opening=opening, executor=pool)
        opening.builds()
    assert counting.asked


def test_an_executor_that_is_lost_ends_a_fit_with_its_reason(stool):
    class Lost:
        def submit(self, function, *args):
            raise ConnectionError("the scheduler is gone")

    with pytest.raises(ExecutorError, match=r"takes no more work: ConnectionError: the scheduler is gone; .*repeat"):
        sw.fit(stool, sw.Collection.of({"a": stool()}), SETTINGS, executor=Lost())
