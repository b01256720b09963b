"""Fits of procedures that state facts: the true size is found, and shapes stand as their references do."""

from typing import Annotated

import numpy as np
import pytest
import trimesh

import shapewright as sw
from shapewright import Range

SETTINGS = sw.Settings(seed=1, samples=300, epochs=12, image_size=32, workers=2)


@sw.procedure(up="z", size="given")
def table(
    width: Annotated[float, Range(40, 160)] = 100.0,
    height: Annotated[float, Range(40, 160)] = 100.0,
):
    move = trimesh.transformations.translation_matrix
    top = trimesh.creation.box((width, 60, 10), transform=move((0, 0, height)))
    legs = [trimesh.creation.box((10, 50, height), transform=move((x * width / 3, 0, height / 2))) for x in (-1, 1)]
    return {"top": top, "legs": legs}


WANTED = [(60.0, 60.0), (120.0, 120.0), (150.0, 50.0), (70.0, 140.0)]


@pytest.fixture(scope="module")
def references():
    return sw.Collection.of(
        {
            f"{w:.0f} {h:.0f}": trimesh.util.concatenate([*table.function(w, h)["legs"], table.function(w, h)["top"]])
            for w, h in WANTED
        }
    )


@pytest.fixture(scope="module")
def iteration(references):
    return sw.fit(table, references, SETTINGS)


def test_lengths_are_found_as_they_are_and_not_their_proportions_alone(iteration):
    for name, result in zip(iteration.names, iteration.results, strict=True):
        width, height = map(float, name.split())
        assert result.parameters["width"] == pytest.approx(width, rel=0.03), name
        assert result.parameters["height"] == pytest.approx(height, rel=0.03), name
        assert result.grade == "replicated"


def test_a_run_says_the_facts(iteration):
    assert iteration.procedure["up"] == "z" and iteration.procedure["size"] == "given"
    assert "unit" not in iteration.procedure


def test_references_stand_in_the_axes_of_the_procedure_unless_their_author_says_others(references, iteration):
    assert iteration.results[2].reference.extent.argmin() == 2  # 150 wide, 55 high, 60 deep
    high = sw.Collection.of({"high": references["70 140"].shape}, up="x")
    assert np.array_equal(high.standing("z")["high"].shape.vertices, high["high"].shape.vertices)


def test_an_explanation_stands_its_references_up_as_the_fit_did(iteration, references):
    explained = sw.explain(iteration, table, references, suggest=False)
    assert all(case.replica.apart <= 1.0 for case in explained.references.values())
