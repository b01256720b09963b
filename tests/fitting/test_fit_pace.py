"""A fit of a procedure that builds slowly, or never the same."""

from dataclasses import replace

import numpy as np
import pytest

import shapewright as sw
from shapewright.modelling.solids import box
from shapewright.settings import Settings

SLOW = """
import time
from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def block(height: Annotated[float, Range(0.2, 1.0)] = 0.5, depth: Annotated[float, Range(0.2, 1.0)] = 0.5):
    time.sleep(0.02)
    return box((1.0, height, depth))
"""
RANDOM = SLOW.replace("height, depth", "height, depth + 0.3 * np.random.rand()").replace(
    "import time", "import time\nimport numpy as np"
)
SETTINGS = sw.Settings(samples=60, epochs=2, image_size=32, workers=2)


def load(tmp_path, text):
    path = tmp_path / "block.py"
    path.write_text(text)
    return sw.load_procedure(path)


@pytest.fixture(scope="module")
def references():
    return sw.Collection.of({"one": box((1, 0.4, 0.8)), "two": box((1, 0.9, 0.3))})


def outcome(iteration):
    return [(r.name, r.parameters, r.fidelity, r.distance, r.replica.vertices.tobytes()) for r in iteration]


def test_the_numbers_that_a_limit_of_time_gave_are_recorded_and_give_the_same_again(tmp_path, references):
    block = load(tmp_path, SLOW)
    limited = sw.fit(block, references, replace(SETTINGS, samples=3000, within=4.0))
    used = limited.settings
    assert used.within is None and used.samples < 1000 and used.refine_shapes >= 1
    assert limited.metrics["notices"][0]["kind"] == "within"
    again = sw.fit(block, references, Settings.from_record(limited.record["settings"]))
    assert outcome(again) == outcome(limited) and again.settings == used


def test_kept_samples_change_nothing_in_the_result(tmp_path, references):
    block = load(tmp_path, SLOW)
    plain, first, second = (
        sw.fit(block, references, SETTINGS, cache=cache) for cache in (None, tmp_path / "cache", tmp_path / "cache")
    )
    kinds = [[notice["kind"] for notice in it.metrics["notices"]] for it in (plain, first, second)]
    assert kinds == [[], [], ["kept"]]
    validation = [it.metrics["validation"] for it in (plain, first, second)]
    assert validation[0] == validation[1] == validation[2]
    assert [r.parameters for r in first] == [r.parameters for r in second]


def test_a_procedure_that_draws_at_random_is_told_and_recorded_once(tmp_path, references):
    told = []
    iteration = sw.fit(load(tmp_path, RANDOM), references, SETTINGS, told.append, tmp_path / "cache")
    notices = [event.notice for event in told if event.notice]
    assert [notice.kind for notice in notices] == ["stochastic"]
    assert "block.py:11: numpy.random.rand draws without a seed" in notices[0].text
    assert iteration.metrics["notices"] == [vars(notices[0])] and not (tmp_path / "cache" / "samples").exists()
    assert np.isfinite([result.fidelity for result in iteration]).all()
