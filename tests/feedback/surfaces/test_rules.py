"""Regions know the rule of the grammar that made what they lie on."""

import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.shapes import concatenate

SOURCE = """
from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.grammar import Grammar

grammar = Grammar()

@grammar.rule("chair")
def parts(box, seat):
    below, plate, above = box.split("y", seat - 0.05, 0.05, ...)
    yield below.tag("base")
    yield plate.tag("seat")
    yield above.tag("above")

@grammar.rule("base")
def four_legs(box):
    for corner in box.corners(0.06):
        yield corner.tag("leg")

@grammar.rule("above")
def upright(box):
    yield box.sub((None, None, 0.05), anchor=(0.5, 0, 0)).tag("back")

@procedure
def chair(seat: Annotated[float, Range(0.3, 0.7)] = 0.5):
    return grammar.derive((0.5, 1, 0.5), seat=seat)
"""


@pytest.fixture(scope="module")
def chair(tmp_path_factory):
    path = tmp_path_factory.mktemp("rules") / "chair.py"
    path.write_text(SOURCE)
    return sw.load_procedure(path)


def test_replicas_from_workers_bear_labels_and_rules(chair):
    with Workers(chair, 1) as crew:
        (build,) = crew.build([chair.space.defaults])
    assert set(zip(build.shape.labels, build.shape.rules, strict=True)) == {
        ("leg", "four_legs"),
        ("seat", "parts"),
        ("back", "upright"),
    }


def test_surplus_regions_bear_label_and_rule(chair):
    whole = chair()
    kept = [i for i, label in enumerate(whole.labels) if label != "back"]
    stool = sw.Mesh(whole.vertices, whole.faces[kept])
    found = residuals(stool, whole)
    surplus = [region for region in found if region.side == "surplus"]
    assert surplus and (surplus[0].label, surplus[0].rule) == ("back", "upright")


def test_a_procedure_without_a_grammar_has_no_rules(tmp_path):
    path = tmp_path / "block.py"
    path.write_text(
        "from typing import Annotated\n"
        "from shapewright import Range, procedure\n"
        "from shapewright.modelling.solids import box\n"
        "@procedure\n"
        "def block(height: Annotated[float, Range(0.5, 1.0)] = 0.7):\n"
        "    return box((1, height, 1)).label('block')\n"
    )
    block = sw.load_procedure(path)
    tall = concatenate([block(), block().transformed([[0.2, 0, 0], [0, 1, 0], [0, 0, 0.2]]), block(height=1.0)])
    found = residuals(tall, block())
    assert all(region.rule is None for region in found)
