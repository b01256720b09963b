"""A space as JSON Schema."""

import json
from typing import Annotated, Literal

import shapewright as sw
from shapewright import Range, When
from shapewright.parameters.schema import condition_text


@sw.procedure
def table(
    height: Annotated[float, Range(0.5, 1.0, steps=8)] = 0.75,
    size: Annotated[float, Range(0.01, 1.0, log=True)] = 0.1,
    level: Annotated[float, Range(0, 2, steps=(0, 1, 2), when=lambda p: p.shelves > 0)] = 1.0,
    shelves: Annotated[int, Range(0, 3)] = 0,
    width: Annotated[int, Range(40, 160)] = 60,
    legs: Literal["four", "pedestal"] = "four",
    wheels: Annotated[bool, When(lambda p: p.legs == "four" and p.height < 0.8)] = False,
):
    return [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]


def test_every_parameter_is_a_property():
    schema = table.space.to_schema()
    assert schema["type"] == "object" and schema["additionalProperties"] is False
    assert schema["properties"] == {
        "height": {"type": "number", "minimum": 0.5, "maximum": 1.0, "x-steps": 8, "default": 0.75},
        "size": {"type": "number", "minimum": 0.01, "maximum": 1.0, "x-scale": "log", "default": 0.1},
        "level": {
            "type": "number",
            "minimum": 0.0,
            "maximum": 2.0,
            "x-steps": [0.0, 1.0, 2.0],
            "x-when": "p.shelves > 0",
            "default": 1.0,
        },
        "shelves": {"type": "integer", "minimum": 0, "maximum": 3, "default": 0},
        "width": {"type": "integer", "minimum": 40, "maximum": 160, "default": 60},
        "legs": {"enum": ["four", "pedestal"], "default": "four"},
        "wheels": {"type": "boolean", "x-when": 'p.legs == "four" and p.height < 0.8', "default": False},
    }
    assert json.loads(json.dumps(schema)) == schema


def test_a_condition_may_be_a_function_or_stand_in_an_annotation_that_is_text(tmp_path):
    def several(p):
        first = p.a
        return first > 0

    assert condition_text(several) == "several" and condition_text(eval("lambda p: p.a")) == "..."
    path = tmp_path / "model.py"
    path.write_text(
        "from __future__ import annotations\nfrom typing import Annotated\nfrom shapewright import Range, procedure\n"
        "@procedure\ndef part(n: Annotated[int, Range(0, 3)] = 1, "
        "w: Annotated[float, Range(1, 2, when=lambda p: p.n > 0)] = 1.5):\n    return None\n"
    )
    assert sw.load_procedure(path).space.to_schema()["properties"]["w"]["x-when"] == "p.n > 0"


def test_a_parameter_that_may_be_none_matters_where_it_is_given():
    @sw.procedure
    def box(lid: bool = True, hole: Annotated[float | None, Range(1, 5, when=lambda p: p.lid)] = None):
        return None

    properties = box.space.to_schema()["properties"]
    assert properties["hole"]["x-when"] == "p.with_hole"
    assert properties["with_hole"]["x-when"] == "p.lid"
