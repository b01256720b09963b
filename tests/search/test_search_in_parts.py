"""A search through an executor finds what it finds here, to the bit, whatever the parts."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_context

import numpy as np
import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.judging.judge import Judge
from shapewright.parameters import Prediction
from shapewright.search.budgets import QUICK
from shapewright.search.objective import Criterion
from shapewright.search.search import SearchStart, refine

SOURCE = """
from typing import Annotated, Literal
from shapewright import Infeasible, Range, procedure
from shapewright.modelling.solids import box

def capped(p):
    return p.form != "bare"

@procedure
def post(
    height: Annotated[float, Range(0.2, 2.0, steps=STEPS)] = 1.1,
    form: Literal["square", "thin", "bare"] = "square",
    cap: Annotated[float, Range(0.0, 1.0, steps=STEPS, when=capped)] = 0.5,
):
    if form == "bare" and height > 1.8:
        raise Infeasible("too tall to be bare")
    shaft = box((0.25 if form == "square" else 0.15, height, 0.25))
    return shaft if form == "bare" else shaft | box((1, 0.1, 0.3 + cap), at=(0, height / 2, 0))
"""
TRUTH = [(0.4, "square", 0.2), (1.9, "thin", 0.9), (1.2, "bare", 0.5), (0.7, "square", 0.8), (1.5, "thin", 0.1)]


@pytest.fixture(params=["None", "3"], ids=["many shapes", "few shapes"])
def post(tmp_path, request):
    (tmp_path / "post.py").write_text(SOURCE.replace("STEPS", request.param))
    return sw.load_procedure(tmp_path / "post.py")


def judged(procedure, crew=None):
    shapes = [procedure(height=h, form=f, cap=c) for h, f, c in TRUTH]
    return Judge.of(sw.Collection.of({f"{i}": s for i, s in enumerate(shapes)}), sw.Settings(workers=2), crew=crew)


def begun(procedure):
    known = [{**procedure.space.defaults, "height": 1.0 + 0.1 * i} for i in range(len(TRUTH))]
    likely = Prediction.of(procedure.space, known, doubt=0.3)
    return SearchStart(likely, [None, known[0], None, None, None], beside=[known[:1]] * len(TRUTH))


@pytest.mark.parametrize("count", [1, 4])
@pytest.mark.parametrize("kind", ["threads", "spawned"])
def test_parts_find_what_one_search_finds(post, count, kind):
    budget = replace(QUICK, moves=QUICK.moves[:6])
    with Workers(post, 2) as crew:
        here = refine(begun(post), judged(post).criterion(range(5)), crew, budget, seed=3)
    told = []
    pools = {"threads": lambda: ThreadPoolExecutor(2), "spawned": lambda: ProcessPoolExecutor(2, get_context("spawn"))}
    with pools[kind]() as executor, Workers(post, count, executor=executor) as crew:
        criterion = judged(post, crew).criterion(range(5))
        there = refine(begun(post), criterion, crew, budget, 3, lambda *step: told.append(step))
        assert crew.costs
    assert there == here
    assert told[-1] == (5, 5)


def test_a_measure_of_the_callers_own_is_taken_here(post):
    shapes = []

    def measure(pairs):
        shapes.extend(pairs)
        return [np.ones(3) for _ in pairs]

    with ThreadPoolExecutor(1) as executor, Workers(post, 1, executor=executor) as crew:
        refine(begun(post), Criterion(measure), crew, replace(QUICK, moves=QUICK.moves[:1]))
    assert shapes
