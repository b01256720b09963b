"""What the Customizer's annotations say, as the manual of OpenSCAD has them and as public files write them."""

from pathlib import Path
from typing import Annotated, Literal

import pytest

from shapewright import Range
from shapewright.procedures.openscad.customizer import AnnotationError, settings


def only(text):
    (setting,) = settings(text)
    return setting


WHOLE = Annotated[int, Range(0, 10)]
FORMS = {
    "n = 5; // [0:10]": WHOLE,
    "n = 5; // [10]": WHOLE,
    "n = 5; // [0:1:10]": WHOLE,
    "n=5;//[0:10]": WHOLE,
    "n = 5; // [0:10] how many": WHOLE,
    "n = 0; // [-3:+3]": Annotated[int, Range(-3, 3)],
    "n = 6; // [4:2:8]": Annotated[int, Range(4, 8, [4, 6, 8])],
    "n = 5; // [4:2:8]": Annotated[int, Range(4, 8, [4, 5, 6, 8])],
    "n = 100; // [50:2:150]": Annotated[int, Range(50, 150)],
    "h = 5.5; // [0:10]": Annotated[float, Range(0, 10)],
    "h = 5; // [0:10.0]": Annotated[float, Range(0, 10.0)],
    "h = 5; // [0:0.5:10]": Annotated[float, Range(0, 10, 21)],
    "h = 1; // [.25:.25:4]": Annotated[float, Range(0.25, 4, 16)],
    "h = 1e1; // [0:2e1]": Annotated[float, Range(0, 20.0)],
    "h = 0; // [0:0.3:1]": Annotated[float, Range(0, 1)],  # the steps do not reach the end
    "d = 12; // [6, 12, 18]": Literal[6, 12, 18],
    "d = 20; // [10:S, 20:M, 30:L]": Literal[10, 20, 30],
    "d = 0.875; // [1:1 inch, 0.875: 7/8 inch]": Literal[1, 0.875],
    'kind = "S"; // [S, M, L]': Literal["S", "M", "L"],
    'kind = "no lid"; // [no lid, flat lid]': Literal["no lid", "flat lid"],
    'kind = "S"; // ["S", "M, L"]': Literal["S", "M, L"],
    'kind = "S"; // [S:Small, M:Medium]': Literal["S", "M"],
    'axis = "+X"; // [+X, -X, +Y]': Literal["+X", "-X", "+Y"],
    "round = true;": bool,
    "round = false; // round the corners?": bool,
    "v = [1, 2]; // [0:10]": tuple[WHOLE, WHOLE],
    "v = [1, 2.5]; // [0:10]": tuple[WHOLE, Annotated[float, Range(0, 10)]],
    "v = [0, 0.5, 1]; // [-1:0.5:1]": tuple[(Annotated[float, Range(-1, 1, 5)],) * 3],
}
HELD = [
    "n = 5;",
    "n = 5; // how many",
    "n = 5; // .5",
    "n = 5; // [mm]",
    "v = [1, 2];",
    'text = "BOX"; // 8',
    "n = 20; // [20:20]",
    "v = [20, 20]; // [20:20]",
    'file = ""; // [image_surface:100x100]',
]


@pytest.mark.parametrize("text", FORMS, ids=str)
def test_a_form_of_annotation_is_a_space(text):
    assert only(text).hint == FORMS[text]


@pytest.mark.parametrize("text", HELD, ids=str)
def test_a_value_without_annotation_is_held(text):
    assert only(text).hint is None


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("n = 5; // [10:1]", r"n: \[10:1\] has no values; write the lower end first"),
        ("n = 5; // [10:10]", "has no values"),
        ("n = 5; // [0:0:10]", "a step of 0"),
        ("n = 5; // [4, six, 8]", "'six' is none"),
        ("n = 5; // [5]", None),
        ("n = 5; // [5, ]", "has one value"),
    ],
)
def test_an_annotation_that_is_no_space_names_its_line(text, message):
    if message is None:
        assert only(text).hint == Annotated[int, Range(0, 5)]
        return
    with pytest.raises(AnnotationError, match=message) as raised:
        settings(f"// a box\n\n{text}")
    assert raised.value.line == 3


@pytest.mark.parametrize(
    ("text", "hint", "said"),
    [
        ("n = 50; // [0:40]", Annotated[int, Range(0, 50)], "its annotation [0:40] leaves out 50"),
        ("n = -2; // [9]", Annotated[int, Range(-2, 9)], "[9] leaves out -2"),
        ("n = 5.5; // [0:0.5:5]", Annotated[float, Range(0, 5.5, 12)], "leaves out 5.5"),
        ("n = 11; // [2:4:10]", Annotated[int, Range(2, 11, [2, 6, 10, 11])], "leaves out 11"),
        ("v = [1, 12]; // [0:10]", tuple[WHOLE, Annotated[int, Range(0, 12)]], "leaves out 12"),
        ("n = 5; // [4, 6:six, 8]", Literal[4, 6, 8, 5], "6: six, its annotation [4, 6:six, 8] leaves out 5"),
        ('kind = "XL"; // [S, M, L]', Literal["S", "M", "L", "XL"], "leaves out XL"),
    ],
)
def test_a_value_that_its_annotation_leaves_out_is_taken_in_and_told(text, hint, said):
    """OpenSCAD builds such a file, and its Customizer shows the value."""
    assert only(text).hint == hint and only(text).description.endswith(said)


def test_what_stands_behind_the_first_brace_is_no_parameter():
    text = 'a = 1; // [0:3] { in a comment\nb = "{"; // 5\nmodule m() { c = 1; // [0:3]\n}\nd = 1; // [0:3]\n'
    assert [setting.name for setting in settings(text)] == ["a", "b"]


def test_hidden_sections_special_variables_and_expressions_are_none():
    text = (
        "/* [Size] */\na = 1; // [0:3]\n$fn = 32; // [8:64]\nb = a + 1; // [0:3]\n/*[Hidden]*/\nc = 1; // [0:3]\n"
        "/* [More] */\nd = 1; // [0:3]\n// e = 1; // [0:3]\n/* f = 1; // [0:3]\n*/"
    )
    assert [setting.name for setting in settings(text)] == ["a", "d"]


def test_the_comment_line_above_is_the_description_and_labels_stand_behind_it():
    first, second, third = settings(
        "// how wide, in mm\nwidth = 1; // [0:3]\n\n// a remark\n\nheight = 1; // [0:3]\n"
        '// what closes it\nlid = "no"; // [no:No lid, flat:Flat, knob]\n'
    )
    assert (first.description, first.line) == ("how wide, in mm", 2)
    assert second.description == ""
    assert third.description == "what closes it; no: No lid, flat: Flat"


def test_several_assignments_on_a_line_and_one_that_is_repeated():
    first, second = settings("a = 1; b = 2; // [0:3]\na = 3;\n")
    assert (first.name, first.value, first.hint, second.name) == ("a", 3, None, "b")
    assert second.hint == Annotated[int, Range(0, 3)]


def test_values_are_read_as_they_are_written():
    values = [setting.value for setting in settings('a=-.5; b=1e3; c="x\\"y"; d=[1,-2.0,]; e=true; f=+7;')]
    assert values == [-0.5, 1000.0, 'x"y', (1, -2.0), True, 7]
    assert [type(value) for value in values] == [float, float, str, tuple, bool, int]


def test_the_block_of_the_page_says_what_it_says():
    page = (Path(__file__).resolve().parents[3] / "docs" / "generators.md").read_text(encoding="utf-8")
    block = page.partition("```openscad\n")[2].partition("```")[0]
    hints = {setting.name: setting.hint for setting in settings(block)}
    assert hints == {
        "width": Annotated[int, Range(40, 160)],
        "height": Annotated[float, Range(10, 60, 101)],
        "teeth": Annotated[int, Range(8, 24, list(range(8, 25, 2)))],
        "bore": Literal[4, 6, 8],
        "lid": Literal["none", "flat", "knob"],
        "rounded": bool,
        "plate": tuple[(Annotated[int, Range(20, 200)],) * 2],
        "wall": None,
    }
