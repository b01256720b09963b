import numpy as np
import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.feedback.causes.leaning import leaning
from shapewright.feedback.surfaces.placement import Overlay
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.modelling.solids import box, cylinder

SOURCE = """
from typing import Annotated, Literal
from shapewright import Range, procedure
from shapewright.modelling.solids import box, cylinder

@procedure
def table(height: Annotated[float, Range(0.4, 0.8)] = 0.6, legs: Literal["post", "four", "none"] = "post"):
    top = box((1, 0.06, 0.6), at=(0, height - 0.03, 0)).label("top")
    if legs == "none":
        return top
    if legs == "post":
        return top | cylinder((0.12, height, 0.12), at=(0, height / 2, 0)).label("post")
    leg = box((0.06, height, 0.06), at=(0.47, height / 2, 0.27)).label("legs")
    return top | leg.mirror("x", keep=True).mirror("z", keep=True)
"""
POST = {"height": 0.6, "legs": "post"}
TOP = box((1, 0.06, 0.6), at=(0, 0.57, 0))


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "table.py"
    path.write_text(SOURCE)
    return sw.load_procedure(path)


def legs(factor):
    leg = box((0.06, 0.6, 0.06), at=(0.47, 0.3, 0.27))
    return leg.mirror("x", keep=True).mirror("z", keep=True).taper(factor, "-y")


def leanings(table, references, found):
    overlays = [Overlay(VisibleSurface.of(solid.mesh().normalised())) for solid in references]
    with Workers(table, 1) as crew:
        return leaning(crew, list(zip(found, overlays, strict=True)), 1), overlays


def test_legs_that_lean_are_found_from_shapes_without_legs(table):
    (inwards, outwards), (one, other) = leanings(table, [TOP | legs(0.4), TOP | legs(1.4)], [POST, POST])
    assert (inwards.label, inwards.factor) == ("legs", 0.4) and (outwards.label, outwards.factor) == ("legs", 1.4)
    assert inwards.apart < 0.45 * one(table(**POST)) and outwards.apart < 0.45 * other(table(**POST))


def test_legs_stay_as_thick_as_they_are(table):
    leg = box((0.06, 0.6, 0.06), at=(0.47, 0.3, 0.27)).path((-0.376, 0, -0.216), (0, 0, 0))
    ((found,), (one,)) = leanings(table, [TOP | leg.mirror("x", keep=True).mirror("z", keep=True)], [POST])
    assert found.label == "legs" and found.factor < 0.3 and found.apart < 0.25 * one(table(**POST))


def test_leaning_brings_upright_shapes_no_nearer(table):
    upright, post = legs(1.0), cylinder((0.12, 0.6, 0.12), at=(0, 0.3, 0))
    (four, one), (first, second) = leanings(table, [TOP | upright, TOP | post], [POST, POST])
    assert four.apart > 2.0 * first(table(height=0.6, legs="four"))
    assert one.apart >= second(table(**POST))  # what stands in the middle has nowhere to lean


def test_nothing_leans_where_nothing_stands(tmp_path):
    path = tmp_path / "slab.py"
    path.write_text(SOURCE.replace('if legs == "none":', "if height > 0:"))
    slab = sw.load_procedure(path)
    (found,), _ = leanings(slab, [TOP | legs(0.4)], [{"height": 0.6, "legs": "none"}])
    assert found is None and np.isfinite(slab().bounds).all()
