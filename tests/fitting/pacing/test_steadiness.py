import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.fitting.pacing.steadiness import unsteady

HEAD = """
import random, time
from typing import Annotated
import numpy as np
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def rock(size: Annotated[float, Range(1.0, 2.0)] = 1.5):
"""
UNSTEADY = [
    ("    return box((size + 0.1 * np.random.randn(), 1, 1))\n", "numpy.random.randn draws without a seed"),
    ("    return box((size * random.uniform(1, 2), 1, 1))\n", "random.uniform draws without a seed"),
    (
        "    return box((size + 0.1 * RNG.random(), 1, 1))\nRNG = np.random.default_rng()\n",
        "numpy.random.default_rng draws without a seed",
    ),
    ("    return box((size + time.time() % 1, 1, 1))\n", "time.time is another each time"),
    (
        "    depth = 1.0\n    for name in {'apple', 'pear', 'fig', 'plum', 'nut', 'kiwi', 'lime', 'date'}:\n"
        "        depth = 0.5 * depth + ord(name[0])\n    return box((size, depth, 1))\n",
        "the order of a set decides",
    ),
]
STEADY = (
    "    return box((size, 1, 1))\n",
    "    return box((size + 0.1 * np.random.default_rng(0).random(), 1, 1))\n",
    "    np.random.seed(3)\n    return box((size + 0.1 * np.random.randn(), 1, 1))\n",
    "    return box((size, sum(x for x in {1.0, 2.0}), 1))\n",
)


def notice(tmp_path, body, workers=2):
    path = tmp_path / "rock.py"
    path.write_text(HEAD + body)
    rock = sw.load_procedure(path)
    with Workers(rock, workers) as crew:
        return unsteady(crew, crew.build(rock.space.sample(8, seed=0)))


@pytest.mark.parametrize(("body", "why"), UNSTEADY)
def test_another_shape_from_the_same_parameters_is_told_with_the_line_and_a_way_out(tmp_path, body, why):
    told = notice(tmp_path, body)
    assert told is not None and told.kind == "stochastic"
    assert why in told.text and "rock.py:" in told.text and "built again" in told.text


@pytest.mark.parametrize("body", STEADY)
def test_a_seed_inside_the_function_makes_it_steady(tmp_path, body):
    assert notice(tmp_path, body) is None


def test_one_worker_finds_it_too_and_keeps_no_process_more(tmp_path):
    path = tmp_path / "rock.py"
    path.write_text(HEAD + UNSTEADY[0][0])
    rock = sw.load_procedure(path)
    with Workers(rock, 1) as crew:
        told = unsteady(crew, crew.build(rock.space.sample(8, seed=0)))
        assert len(crew.builders.pool.idle) == 1
    assert told is not None and "8 of 8 times" in told.text


def test_a_shape_that_ends_its_process_the_second_time_is_no_error(tmp_path):
    body = "    import os, pathlib\n    file = pathlib.Path(__file__).with_name(f'built-{size}')\n"
    body += "    if file.exists():\n        os._exit(3)\n    file.write_text('')\n    return box((size, 1, 1))\n"
    told = notice(tmp_path, body)
    assert told is not None and "another shape" in told.text
