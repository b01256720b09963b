import pytest

import shapewright as sw
from shapewright.feedback.writing.edit import NewParameter, NewRule, parameter_line, with_range, with_rule
from shapewright.feedback.writing.source import EditError, can_edit, free_name, snippet

STOOL = '''"""Stools."""

from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box

Width = Annotated[float, Range(0.2, 0.6, steps=(0.2, 0.6))]


@procedure
def stool(
    height: Annotated[float, Range(low=0.3, high=0.9, steps=4)] = 0.5,  # of a man: é
    width: Width = 0.4,
    round: bool = False,  # not yet
):
    def half(x):
        return x / 2

    if round: return box((width, height, width))
    if width > 0.5:
        seat = box((width, 0.05, width))
        return seat
    return (
        box((width, 0.05, width), at=(0, half(height), 0)).label("seat")
        | box((0.05, height, 0.05)).label("leg")
    )
'''
FOOT = NewRule(
    (NewParameter("foot", "bool", "False"), NewParameter("reach", "Annotated[float, Range(0.1, 0.5)]", "0.2")),
    "def add_foot(shape, reach):\n    return shape | cylinder((reach, 0.02, reach), (0, shape.bounds[0, 1], 0))",
    "add_foot({shape}, reach)",
    "foot",
    {"shapewright.modelling.solids": ("cylinder",), "typing": ("Annotated",)},
)


def loaded(tmp_path, source):
    path = tmp_path / f"procedure{len(list(tmp_path.iterdir()))}.py"
    path.write_text(source, encoding="utf-8")
    return sw.load_procedure(path)


def test_a_range_is_widened_where_it_is_written(tmp_path):
    source = with_range(STOOL, "stool", "height", "0.1", None, "5")
    assert source == STOOL.replace("low=0.3, high=0.9, steps=4", "low=0.1, high=0.9, steps=5")
    named = with_range(source, "stool", "width", None, "0.8", "(0.2, 0.6, 0.8)")
    space = loaded(tmp_path, named).space
    assert (space["height"].low, space["height"].steps, space["width"].high) == (0.1, 5, 0.8)
    assert parameter_line(source, "stool", "height").startswith("height: Annotated[float, Range(low=0.1")
    with pytest.raises(EditError, match="the annotation of round spells no Range"):
        with_range(STOOL, "stool", "round", "0", "1", None)
    with pytest.raises(EditError, match="no annotated parameter depth"):
        with_range(STOOL, "stool", "depth", "0", "1", None)


def test_a_rule_reaches_every_return_and_leaves_the_rest_as_it_was(tmp_path):
    source = with_rule(STOOL, "stool", FOOT)
    kept = [line for line in STOOL.splitlines() if "return" not in line and "import box" not in line]
    assert all(line in source for line in kept if "box((width, 0.05, width), at" not in line)
    assert "from shapewright.modelling.solids import box, cylinder" in source
    assert source.count("return x / 2") == 1 and source.count("add_foot(") == 4
    old, new = loaded(tmp_path, STOOL), loaded(tmp_path, source)
    assert new.space.names == ("height", "width", "round", "foot", "reach")
    for parameters in old.space.sample(6, seed=1):
        assert (new(**parameters).vertices == old(**parameters).vertices).all()
        assert len(new(**parameters, foot=True).faces) > len(old(**parameters).faces)


def test_rules_follow_one_another(tmp_path):
    second = NewRule((NewParameter("bare", "bool", "False"),), "", '{shape}.without("leg")', "bare", {})
    source = with_rule(with_rule(STOOL, "stool", FOOT), "stool", second)
    procedure = loaded(tmp_path, source)
    assert procedure(bare=True).label_names == ("seat",)
    assert len(procedure(bare=True, foot=True).faces) > len(procedure(bare=True).faces)


def test_the_snippet_runs_at_the_end_of_the_old_file(tmp_path):
    source = with_rule(STOOL, "stool", FOOT)
    pasted = loaded(tmp_path, STOOL + "\n\n" + snippet(STOOL, source))
    assert pasted.space.names == loaded(tmp_path, source).space.names
    assert len(pasted(foot=True).faces) > len(pasted().faces)
    assert "class" not in snippet(STOOL, source) and '"""Stools."""' not in snippet(STOOL, source)


@pytest.mark.parametrize(
    "signature",
    [
        "def bar(length: Annotated[float, Range(1, 2)] = 1.5):",
        "def bar(length: Annotated[float, Range(1, 2)] = 1.5, *, old: bool = False):",
        "def bar(\n    length: Annotated[float, Range(1, 2)] = 1.5):",
        "def bar(\n    length: Annotated[float, Range(1, 2)] = 1.5  # metres\n):",
        "def bar(\n    length: Annotated[\n        float, Range(1, 2)\n    ] = 1.5,  # metres\n    # more to come\n):",
    ],
)
def test_signatures_of_any_layout(tmp_path, signature):
    head = "from typing import Annotated\nfrom shapewright import Range, procedure\n"
    head += "from shapewright.modelling.solids import box\n\n@procedure\n"
    source = head + signature + "\n    return box((length, 1, 1))\n"
    procedure = loaded(tmp_path, with_rule(source, "bar", FOOT))
    assert procedure.space.names[-2:] == ("foot", "reach")
    assert len(procedure(foot=True).faces) > 12


def test_long_calls_take_several_lines(tmp_path):
    names = [f"a_parameter_with_quite_a_long_name_{i}" for i in range(4)]
    parameters = tuple(NewParameter(name, "Annotated[float, Range(0, 1)]", "0.5") for name in names)
    function = f"def change(shape, {', '.join(names)}):\n    return shape"
    flag = NewParameter("much", "bool", "False")
    rule = NewRule((flag, *parameters), function, f"change({{shape}}, {', '.join(names)})", "much", {})
    source = with_rule(STOOL, "stool", rule)
    assert len(loaded(tmp_path, source)(much=True).faces) > 0
    assert max(len(line) for line in source.splitlines() if "def change" not in line and "if round" not in line) <= 120


def test_what_can_be_edited():
    assert can_edit(STOOL, "stool") and not can_edit(STOOL, "table")
    assert not can_edit("", "stool") and not can_edit("    def stool():\n", "stool")


def test_names_that_are_free():
    assert free_name(STOOL, "stool", "shelf") == "shelf"
    assert free_name(STOOL, "stool", "seat") == "seat_2" and free_name(STOOL, "stool", "stool") == "stool_2"
    assert free_name(STOOL, "stool", "box") == "box_2" and free_name(STOOL, "stool", "class") == "class_2"
    assert free_name(STOOL, "stool", "3 Legs") == "part_3_legs"


AUTHORED = '''# Bars, as my grandfather made them: été
from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.solids import (
    box,  # for all of it
)

OAK = {  "wood" : 'oak',}


@procedure  # the one
def bar(
    length: Annotated[float, Range(1, 2 , )] = 1.5,  # metres

    # of oak
    wide : "bool"=False ,  # really
    # more to come
) :
    """Bars."""

    if wide :
        return  box( (length, 2, 1,) )  # wide

    # as they were
    return box((
        length, 1, 1  # ells
    ))  # narrow


# nothing else
'''


@pytest.mark.parametrize(
    "kind", [lambda s: s, lambda s: s.replace("\n", "\r\n"), lambda s: s.replace("    ", "\t"), lambda s: "\ufeff" + s]
)
def test_every_other_byte_stays(kind):
    source = kind(AUTHORED)
    assert with_range(source, "bar", "length", None, "3", None) == kind(AUTHORED.replace("2 , )", "3 , )"))
    returned, changed = "return add_foot(shape, reach) if foot else shape\n", AUTHORED
    parameters = "    foot: bool = False,\n    reach: Annotated[float, Range(0.1, 0.5)] = 0.2,\n"
    for old, new in (
        ("  # really\n", f"  # really\n{parameters}"),
        ("return  box(", "shape = box("),
        ("  # wide\n", f"  # wide\n        {returned}"),
        ("return box((", "shape = box(("),
        ("  # narrow\n", f"  # narrow\n    {returned}\n\n{FOOT.function}\n"),
        ("# for all of it\n)\n", "# for all of it\n)\nfrom shapewright.modelling.solids import cylinder\n"),
    ):
        assert changed.count(old) == 1
        changed = changed.replace(old, new)
    assert with_rule(source, "bar", FOOT) == kind(changed)
