"""JSON Schemas of spaces, checked by a library that knows the standard."""

import json
from pathlib import Path
from typing import Annotated, Literal

import pytest

import shapewright as sw
from shapewright import Range, When

jsonschema = pytest.importorskip("jsonschema", reason="jsonschema checks schemas; run `make test-adapters`")
SPECS = sorted((Path(__file__).resolve().parents[2] / "examples" / "generators").rglob("*.toml"))


@sw.procedure
def table(
    height: Annotated[float, Range(0.5, 1.0, steps=8)] = 0.75,
    size: Annotated[float, Range(0.01, 1.0, log=True)] = 0.1,
    level: Annotated[float, Range(0, 2, steps=(0, 1, 2), when=lambda p: p.shelves > 0)] = 1.0,
    shelves: Annotated[int, Range(0, 3)] = 0,
    legs: Literal["four", "pedestal", 2, 1.5] = "four",
    wheels: Annotated[bool, When(lambda p: p.legs == "four")] = False,
):
    return None


def assert_of_the_standard(space):
    schema = json.loads(json.dumps(space.to_schema()))
    jsonschema.Draft202012Validator.check_schema(schema)
    check = jsonschema.Draft202012Validator(schema)
    for values in space.sample(50, 0):
        check.validate(values)
    for name, entry in schema["properties"].items():
        wrong = "x" if "enum" in entry else "2" if "minimum" not in entry else entry["maximum"] + 1
        assert not check.is_valid({**space.defaults, name: wrong})
    assert not check.is_valid({**space.defaults, "another": 1})


def test_samples_hold_by_the_schema_and_other_values_do_not():
    assert_of_the_standard(table.space)


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_so_do_those_of_specs(path):
    if "scene_synthesizer" in path.read_text(encoding="utf-8"):
        pytest.importorskip("scene_synthesizer")
    assert_of_the_standard(sw.load_procedure(path).space)
