from typing import Annotated

import numpy as np
import pytest

import shapewright as sw
from shapewright import Range
from shapewright.axes.turns import TURNS
from shapewright.fitting.standing import stand
from shapewright.modelling.solids import box
from shapewright.references import Orientation
from shapewright.report import write_report
from shapewright.report.axes_sheet import SHEET


@sw.procedure
def seat(
    width: Annotated[float, Range(0.5, 1.5)] = 1.0,
    back: Annotated[float, Range(0.3, 1.0)] = 0.6,
):
    return box((width, 0.4, 1)) | box((width, back, 0.15), at=(0, 0.2 + back / 2, -0.4))


GIVEN = {"a": 7, "b": 0, "c": 19}  # of TURNS
QUICK = sw.Settings(samples=60, epochs=1, image_size=32, refine="off")


@pytest.fixture
def turned():
    shapes = {name: seat(width=0.7 + 0.1 * turn / 24).transformed(TURNS[turn]) for name, turn in GIVEN.items()}
    return sw.Collection.of(shapes, up="auto")


def test_each_reference_stands_as_the_procedures_shapes_do(turned):
    found = stand(seat, turned, QUICK)
    for reference, turn in zip(found, GIVEN.values(), strict=True):
        assert reference.orientation == Orientation().then(TURNS[turn].T)


def test_axes_that_are_told_are_left_alone():
    told = sw.Collection.of({"a": seat()}, up="z")
    assert stand(seat, told, QUICK) is told


def test_a_fit_records_them_and_its_report_shows_them(turned, tmp_path):
    iteration = sw.fit(seat, turned, QUICK)
    axes = iteration.collection["axes"]
    assert {name: axes[name]["by"] for name in axes} == {"a": "found", "b": "default", "c": "found"}
    assert axes["a"]["up"] == Orientation().then(TURNS[7].T).up
    run = iteration.save(tmp_path / "run", write_report)
    assert (run / SHEET).read_bytes().startswith(b"\x89PNG")
    assert f'href="{SHEET}"' in (run / "report.html").read_text()


def test_an_explanation_takes_the_references_as_the_fit_did(turned):
    iteration = sw.fit(seat, turned, QUICK)
    given = {name: seat(width=0.7 + 0.1 * turn / 24).transformed(TURNS[turn]) for name, turn in GIVEN.items()}
    explained = sw.explain(iteration, seat, sw.Collection.of(given), suggest=False)
    assert set(explained.references) == set(GIVEN)
    for name, case in explained.references.items():
        np.testing.assert_allclose(case.reference.vertices, iteration[name].reference.vertices, atol=1e-12)
