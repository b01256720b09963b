import re

import numpy as np
import pytest

import boxes
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.text import lines, numbers, plain, rows


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32"])
@pytest.mark.parametrize("kind", ["obj", "off", "ply", "stl"])
def test_text_in_any_unicode_encoding_with_and_without_its_mark_gives_the_box(tmp_path, kind, encoding):
    path = tmp_path / f"box.{kind}"
    path.write_bytes(getattr(boxes, kind)().encode(encoding))
    assert boxes.is_box(read(path)[0])


@pytest.mark.parametrize("kind", ["obj", "off", "ply", "stl"])
@pytest.mark.parametrize("end", ["\r", "\r\n", " \t\n\n"])
def test_line_ends_of_every_system_and_zeros_at_the_end(tmp_path, kind, end):
    path = tmp_path / f"box.{kind}"
    path.write_bytes(getattr(boxes, kind)().replace("\n", end).encode() + b"\x1a\0\0")
    assert boxes.is_box(read(path)[0])


def test_utf_16_that_ends_in_half_a_letter_is_broken():
    with pytest.raises(UnreadableError, match="UTF-16"):
        plain("v 0 0 0".encode("utf-16") + b"\0")


def test_numbers_that_are_not_finite_in_every_spelling():
    found = numbers(b"1.#INF -1.#IND 1.#QNAN00 -1.#INF nan inf -Infinity 1e3")
    assert np.isposinf(found[[0, 5]]).all() and np.isneginf(found[[3, 6]]).all() and np.isnan(found[[1, 2, 4]]).all()
    assert found[7] == 1000


@pytest.mark.parametrize("word", ["1,5", "1_0", "0x10", "1.0D+3", "12abc", "1.5.2"])
def test_a_word_that_is_no_number_is_named(word):
    with pytest.raises(UnreadableError, match=f"{re.escape(word)}' is no number"):
        numbers(f"1 2 {word} 3".encode())


def test_a_decimal_comma_is_told():
    with pytest.raises(UnreadableError, match="decimals need a point"):
        numbers(b"1,5")


def test_rows_are_the_lines_that_hold_something():
    table = rows(b"\n 1 2\r\n\r\n3\t4  5\n\n6")
    assert table.values.tolist() == [1, 2, 3, 4, 5, 6]
    assert table.starts.tolist() == [0, 2, 5, 6] and table.lengths.tolist() == [2, 3, 1] and len(table) == 3
    assert len(rows(b"")) == len(rows(b" \n ")) == 0


@pytest.mark.parametrize("end", [b"\n", b"\r", b"\r\n"])
def test_long_texts_give_the_same_lines_as_short_ones(end):
    text = end.join(b"v %d 0 0" % i for i in range(600_000))
    assert list(lines(text)) == text.splitlines()
