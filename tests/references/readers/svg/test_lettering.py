import base64
import io

import numpy as np
import pytest
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen

from shapewright.references.readers.svg import read_svg
from shapewright.references.readers.svg.fonts import faces


def font(
    letters: str = "ab", high: int = 500, family: str = "Blocks", weight: int = 400, slanted: bool = False
) -> bytes:
    """Each letter is a block, half as wide as the letter: from 0 to 500 of 1000 units, and as high as told."""
    names = [".notdef", "space", *letters]
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder(names)
    builder.setupCharacterMap({32: "space"} | {ord(letter): letter for letter in letters})
    pen = TTGlyphPen(None)
    pen.moveTo((0, 0))
    for point in ((0, high), (500, high), (500, 0)):
        pen.lineTo(point)
    pen.closePath()
    empty = TTGlyphPen(None).glyph()
    block = pen.glyph()
    builder.setupGlyf({name: block if name in letters else empty for name in names})
    builder.setupHorizontalMetrics(dict.fromkeys(names, (1000, 0)))
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": family, "styleName": "Regular"})
    builder.setupOS2(usWeightClass=weight, fsSelection=int(slanted))
    builder.setupPost()
    builder.save(buffer := io.BytesIO())
    return buffer.getvalue()


@pytest.fixture(autouse=True)
def machine(monkeypatch, tmp_path_factory):
    """This machine has one font of two weights."""
    folder = tmp_path_factory.mktemp("fonts")
    (folder / "a.ttf").write_bytes(font())
    (folder / "b.ttf").write_bytes(font(high=900, weight=700))
    found = [face for path in sorted(folder.iterdir()) for face in faces.faces_in(path)]
    monkeypatch.setattr(faces, "machine_faces", lambda: tuple(found))


def drawn(text: str, more: str = ""):
    data = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{more}{text}</svg>'
    drawing, notes = read_svg(data.encode())
    parts = [np.array(part.bounds) for part in getattr(drawing.geometry, "geoms", [drawing.geometry])]
    boxes = sorted([b[0], -b[3], b[2], -b[1]] for b in parts)  # left, top, right, bottom, y down
    return np.round(boxes, 6).tolist(), notes


def text(inner: str, attributes: str = 'x="10" y="50"') -> str:
    return f'<text font-family="blocks" font-size="10" {attributes}>{inner}</text>'


def test_letters_stand_on_their_line_one_after_the_other():
    assert drawn(text("a b"))[0] == [[10, 45, 15, 50], [30, 45, 35, 50]]


@pytest.mark.parametrize(("anchor", "left"), [("start", 50), ("middle", 40), ("end", 30)])
def test_an_anchor_is_where_a_chunk_begins_ends_or_has_its_middle(anchor, left):
    boxes = drawn(text("ab", f'x="50" y="50" text-anchor="{anchor}"'))[0]
    assert [box[0] for box in boxes] == [left, left + 10]


def test_lists_place_letters_one_by_one():
    assert drawn(text("ab", 'x="10 40" y="20 60" dx="0 1" dy="5"'))[0] == [[10, 20, 15, 25], [41, 55, 46, 60]]


def test_a_span_moves_what_follows_and_has_a_style_of_its_own():
    boxes = drawn(text('a<tspan dy="20" font-size="20">b</tspan>a'))[0]
    assert boxes == [[10, 45, 15, 50], [20, 60, 30, 70], [40, 65, 45, 70]]


def test_white_space_counts_once_and_not_at_the_ends():
    assert drawn(text("\n  a \n\t b  "))[0] == drawn(text("a b"))[0]
    assert drawn(text("  a", 'x="10" y="50" xml:space="preserve"'))[0] == [[30, 45, 35, 50]]


def test_the_nearest_weight_is_chosen():
    assert drawn(text("a", 'x="10" y="50" font-weight="800"'))[0] == [[10, 41, 15, 50]]


def test_the_shorthand_of_style_sheets_names_family_size_and_weight():
    styled = '<style>text { font: bold 20px/1.5 "Nothing", Blocks }</style>'
    assert drawn('<text x="10" y="50">a</text>', styled)[0] == [[10, 32, 20, 50]]


def test_letters_are_stroked_and_moved_as_shapes_are():
    styled = 'x="10" y="50" transform="translate(5)" stroke="black" stroke-width="2"'
    assert drawn(text("a", styled))[0] == [[14, 44, 21, 51]]


def test_a_font_of_the_file_comes_before_those_of_the_machine_and_is_not_noted():
    data = base64.b64encode(font(high=200)).decode()
    rule = f"<style>@font-face {{ font-family: Blocks; src: url(data:font/ttf;base64,{data}) }}</style>"
    assert drawn(text("a"), rule) == ([[10, 48, 15, 50]], ())


def test_a_font_of_the_machine_is_named():
    assert drawn(text("ab"))[1] == ("2 x letter, drawn in blocks of this machine",)


@pytest.mark.parametrize(
    ("inner", "attributes", "note"),
    [
        ("c", 'x="1" y="1"', "1 x letter that its font does not have left out"),
        ("a", 'font-family="Other"', "1 x letter of the font Other, which is not on this machine, left out"),
        ("א", 'x="1" y="1"', "1 x letter of a script that is joined or runs to the left left out"),
        ("a", 'writing-mode="tb"', "1 x letter of a line that runs down left out"),
        ('<textPath href="#x">a</textPath>', "", "1 x textPath left out"),
    ],
)
def test_what_cannot_be_drawn_is_noted(inner, attributes, note):
    found = text(inner, attributes) if "font-family" not in attributes else f"<text {attributes}>{inner}</text>"
    assert note in drawn(found + '<rect width="5" height="5"/>')[1]


def test_a_broken_font_of_the_file_is_passed_over():
    rule = "<style>@font-face { font-family: Blocks; src: url(data:font/ttf;base64,AAEAAAAKAIAAAwAg) }</style>"
    assert drawn(text("a"), rule)[0] == [[10, 45, 15, 50]]


def test_hidden_text_is_not_drawn():
    rectangle = '<rect x="1" y="1" width="5" height="5"/>'
    assert drawn(text("a", 'visibility="hidden"') + text("a", 'display="none"') + rectangle)[0] == [[1, 1, 6, 6]]


def test_fonts_of_a_folder_come_in_the_order_of_their_paths(tmp_path):
    for name, family in (("b.ttf", "Second"), ("a.ttf", "First"), ("c.txt", "None")):
        (tmp_path / name).write_bytes(font(family=family))
    (tmp_path / "d.ttf").write_bytes(b"no font")
    assert [face.family for face in faces._found([tmp_path])] == ["first", "second"]
