"""The kernels read what the readers of short texts read, to the bit, and leave to them what is odd."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapewright.references.errors import UnreadableError
from shapewright.references.readers import obj, stl, text
from shapewright.references.readers.kernels.words import numbers_of_rows

FACET = "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1e-1 0 {}\n  vertex 0 1.5 0\n endloop\nendfacet\n"
QUAD = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 vertex 0 1 0 endloop endfacet\n"
SOLID = "solid a\n" + FACET.format("0.25") * 3 + "endsolid a\n"
OBJ = "v 0 0 0\nv 1 0 .5 1\nv 0 1e-3 0 0.5 0.5 0.5\nvt 0 1\nvn 0 0 1\n"
WORD = st.one_of(
    st.floats(allow_nan=False, allow_infinity=False).map(repr),
    st.floats(width=32, allow_nan=False, allow_infinity=False).map(lambda number: f"{number:.9g}"),
    st.decimals(allow_nan=False, allow_infinity=False).map(str),
    st.integers().map(str),
    st.sampled_from(
        [
            "nan",
            "inf",
            "1.#IND",
            "-0",
            "+5.",
            ".5",
            "1e",
            "1e+",
            "1,5",
            "1_0",
            "0x10",
            "--",
            ".",
            "1e22",
            "1e23",
            "9007199254740993",
            "5e-324",
            "1e400",
        ]
    ),
)


def outcome(read, data, monkeypatch, long):
    """What a reader makes of a text that counts as long or as short: arrays, notes and parts, or the reason."""
    for module in (text, obj, stl):
        monkeypatch.setattr(module, "LONG", 1 if long else 2**60)
    try:
        found = read(data)
    except UnreadableError as error:
        return str(error)
    if not hasattr(found, "corners"):
        return found.positions.tobytes(), found.notes
    parts = found.parts and (found.parts.names, found.parts.of_faces.tobytes())
    return found.vertices.tobytes(), found.corners.tobytes(), found.counts.tobytes(), found.notes, parts


@settings(max_examples=300, deadline=None)
@given(st.lists(st.lists(WORD, max_size=5).map(" ".join), max_size=6).map("\n".join))
def test_numbers_are_those_of_python_to_the_bit_or_left_to_it(lines):
    found = numbers_of_rows(np.frombuffer(lines.encode(), np.uint8))
    if found is None:
        return
    words = [float(word) for word in lines.split()]
    assert np.array_equal(found[0].view(np.int64), np.array(words).view(np.int64))
    counts = [len(line.split()) for line in lines.split("\n") if line.split()]
    assert np.diff([*found[1], len(words)]).tolist() == counts


def test_numbers_that_programs_write_are_not_left_to_python():
    lines = b"0 -0 1 -1.5 +2. .5\r\n\t1e-5 1E+22 123456.789012 0.00000001\n\n000123 -0.000000e+00"
    values, starts = numbers_of_rows(np.frombuffer(lines, np.uint8))
    assert values.tolist() == [0, -0.0, 1, -1.5, 2, 0.5, 1e-5, 1e22, 123456.789012, 1e-8, 123, -0.0]
    assert starts.tolist() == [0, 6, 10] and np.signbit(values[[1, 11]]).all()


@pytest.mark.parametrize("piece", [1, 2**20])
@pytest.mark.parametrize("sign", [b"\n", b"\r", b"\r\n"])
def test_rows_are_the_same_however_long_the_text_is(monkeypatch, piece, sign):
    lines = sign.join([b"", b"1 2 3", b"4", b" ", b"5 nan", b"-6e3 7.12345678901234567", b"8"])
    monkeypatch.setattr(text, "LONG", 2**60)
    short = text.rows(lines)
    monkeypatch.setattr(text, "LONG", 1)
    monkeypatch.setattr(text, "_PIECE", piece)
    long = text.rows(lines)
    assert np.array_equal(long.values, short.values, equal_nan=True) and long.starts.tolist() == short.starts.tolist()


@pytest.mark.parametrize(
    "data",
    [
        OBJ + "f 1 2 3\nf 1/1 2/1 3/1\nf -3//1 -2//1 -1//1\nf 1/1/1 2/1/1 3/1/1\n" * 3,
        OBJ + "g a\nf 1 2 3\ng b\nf 3 2 1\nusemtl oak\ns 1\nf 2 3 1\no\nf 1 2 3",
        OBJ + "v 0.12345678901234567 0 nan\n  f   1 2 3 4  \nf 1 2 3 # a comment\n# another\n\n\nf 1 2 4",
        (OBJ + "f 1 2 3\nl 1 2\nfo 1 2 3\ncurv 1\nhello\n").replace("\n", "\r\n"),
        OBJ + "f 1 2 3\nf -4 2 3\nf 0 1 2\n",
        OBJ.replace("\n", "\r") + "f 1 2 3\r",
        OBJ,
        OBJ + "f 1 2 x",
        OBJ + "f 1.5 2 3",
        OBJ + "f\n",
        OBJ + "f 99999999999999999999 1 2",
        OBJ + "v 1 2\nf 1 2 3",
        OBJ + "v 1 2 3,5\nf 1 2 3",
        OBJ + "f 1 2 3\n7 8 9",
        OBJ + "f 1 2 3\n\0\0\0",
    ],
)
@pytest.mark.parametrize("block", [16, 2**22])
def test_an_obj_is_the_same_however_long_it_is(monkeypatch, data, block):
    monkeypatch.setattr(obj, "_BLOCK", block)
    monkeypatch.setattr(obj, "_ODD", 8)
    monkeypatch.setattr(obj, "_WORTH", 0)
    short, long = (outcome(obj.read_obj, data.encode(), monkeypatch, long) for long in (False, True))
    assert long == short


@pytest.mark.parametrize(
    "data",
    [
        SOLID,
        SOLID.upper(),
        SOLID * 2,
        "solid\n"
        + FACET.format("0")
        + QUAD
        + FACET.format("1.#IND")
        + FACET.format("0.12345678901234567")
        + "endsolid",
        "solid x\n" + FACET.format(0).replace("0 0 1", "nan nan nan") + FACET.format(0).replace(" 0 0 1", ""),
        SOLID[:-30],
        SOLID[: len(SOLID) // 2],
        SOLID.replace("endfacet", "endfacets", 1),
        SOLID.replace("vertex", "vertx", 1),
        SOLID.replace("outer loop", "outerloop", 1),
        SOLID.replace("  vertex 0 1.5 0\n", "", 1),
        SOLID.replace("0.25", "0.25.5"),
        SOLID + "rubbish",
    ],
)
def test_an_stl_is_the_same_however_long_it_is(monkeypatch, data):
    monkeypatch.setattr(stl, "_ODD", 1)
    short, long = (outcome(stl.read_stl, data.encode(), monkeypatch, long) for long in (False, True))
    assert long == short
