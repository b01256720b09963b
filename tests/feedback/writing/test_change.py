"""A suggestion's change, made in files that have been edited since."""

import json

import pytest

import shapewright as sw
from shapewright.feedback.writing.change import FileChange, NewLimits
from shapewright.feedback.writing.edit import NewParameter, NewRule
from shapewright.feedback.writing.source import EditError

BEFORE = """from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import box


@procedure
def post(
    height: Annotated[float, Range(0.2, 1.0)] = 0.6,
    kind: Literal["post", "wall"] = "post",
):
    return box((0.5, height, 0.1)).label("post")
"""
LONGER = FileChange("post", (NewLimits("height", None, "2.0", None),))
KNOB = FileChange(
    "post",
    rule=NewRule(
        (
            NewParameter("knob", "bool", "False"),
            NewParameter("knob_size", "Annotated[float, Range(0.1, 0.3, when=lambda p: p.knob)]", "0.2"),
        ),
        'def add_knob(shape, knob_size):\n    return shape | box(knob_size, at=(0, 0, 0.2)).label("knob")',
        "add_knob({shape}, knob_size)",
        "knob",
        {"shapewright.modelling.solids": ("box",)},
    ),
)
EDITED = (
    BEFORE.replace("    kind:", "    deep: bool = False,\n    kind:")
    .replace("return box((0.5, height, 0.1))", "return box((0.5, height, 0.3 if deep else 0.1))")
    .replace("@procedure", "SIZE = 1.0  # mine\n\n\n@procedure")
)


def loaded(text, tmp_path):
    path = tmp_path / "post.py"
    path.write_text(text)
    return sw.load_procedure(path)


@pytest.mark.parametrize("change", [LONGER, KNOB])
def test_a_file_as_it_was_gets_the_text_that_was_tried(change):
    assert change.merged(BEFORE, BEFORE) == change.written(BEFORE) != BEFORE


def test_edits_since_stay_and_the_change_joins_them(tmp_path):
    text = KNOB.merged(BEFORE, LONGER.merged(BEFORE, EDITED))
    post = loaded(text, tmp_path)
    assert post.space.names == ("height", "deep", "kind", "knob", "knob_size") and "SIZE = 1.0  # mine" in text
    assert post.space["height"].high == 2.0
    assert set(post(deep=True, knob=True).label_names) == {"post", "knob"} and post(deep=True).extent[2] == 0.3


def test_a_range_that_the_author_has_edited_is_not_written_over():
    with pytest.raises(EditError, match="you have edited height"):
        LONGER.merged(BEFORE, BEFORE.replace("1.0)", "1.5)"))


@pytest.mark.parametrize(
    "own", ["knob = 3\n", "def add_knob(size):\n    return size\n", "from shapewright import When as knob_size\n"]
)
def test_a_name_that_the_author_has_taken_is_not_taken_again(own):
    with pytest.raises(EditError, match=r"knob.* already"):
        KNOB.merged(BEFORE, BEFORE.replace("@procedure", f"{own}\n\n@procedure"))


def test_the_same_suggestion_is_not_added_twice():
    once = KNOB.merged(BEFORE, BEFORE)
    with pytest.raises(EditError, match="already"):
        KNOB.merged(BEFORE, once)


def test_a_file_without_the_procedure_is_refused():
    with pytest.raises(EditError, match="no function post"):
        KNOB.merged(BEFORE, EDITED.replace("def post", "def pole"))


def test_a_condition_switches_the_part_off_elsewhere(tmp_path):
    post = loaded(KNOB.only_when('p.kind == "post"').written(BEFORE), tmp_path)
    assert {v["knob"] for v in post.space.sample(40, 0) if v["kind"] == "wall"} == {False}
    assert {v["knob"] for v in post.space.sample(40, 0) if v["kind"] == "post"} == {False, True}


@pytest.mark.parametrize("change", [LONGER, KNOB, KNOB.only_when("p.height > 0.5")])
def test_it_goes_through_json(change):
    assert FileChange.from_record(json.loads(json.dumps(change.record))).written(BEFORE) == change.written(BEFORE)


def test_a_record_without_a_change_says_what_to_do():
    with pytest.raises(EditError, match="explain it again"):
        FileChange.from_record({})
