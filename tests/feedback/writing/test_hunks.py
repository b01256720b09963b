"""A change in parts, joined with what an author has written since."""

import itertools

import pytest

from shapewright.feedback.writing.change import FileChange, NewLimits
from shapewright.feedback.writing.hunks import accepted, merging
from shapewright.feedback.writing.source import EditError

BEFORE = """from typing import Annotated

from shapewright import Range, procedure


@procedure
def table(
    height: Annotated[float, Range(0.3, 1.2)] = 0.6,
    width: Annotated[float, Range(0.5, 1.5)] = 1.0,
):
    return top(height, width)


def top(height, width):
    return height * width
"""
WIDER = BEFORE.replace("Range(0.3, 1.2)", "Range(0.3, 2)")
BOTH = WIDER.replace("return height * width", "return 2 * height * width")
CHANGE = FileChange("table", (NewLimits("height", None, "2", None),))


def parts(after: str, now: str, change: FileChange | None = None):
    return merging(change, BEFORE, after, now)


def test_all_parts_make_the_whole_and_none_makes_nothing():
    hunks = parts(BOTH, BEFORE).hunks
    assert len(hunks) == 2
    assert accepted(BEFORE, hunks, (0, 1)) == BOTH and accepted(BEFORE, hunks, ()) == BEFORE
    assert accepted(BEFORE, hunks, (0,)) == WIDER


def test_any_order_of_accepting_gives_the_same():
    for order in itertools.permutations((0, 1)):
        text = BEFORE
        for number in order:
            text = accepted(text, parts(BOTH, text).hunks, (number,))
        assert text == BOTH
        assert all(hunk.there for hunk in parts(BOTH, text).hunks)


def test_parts_keep_what_was_written_since():
    now = "# mine\n" + BEFORE.replace("width)\n\n\ndef", "width)\n\n\n# and mine\ndef")
    found = parts(BOTH, now)
    assert found.refused and not any(hunk.refused or hunk.there for hunk in found.hunks)
    text = accepted(now, found.hunks, (0, 1))
    assert text.startswith("# mine\n") and "# and mine" in text
    assert "Range(0.3, 2)" in text and "2 * height * width" in text


def test_a_change_that_is_known_as_facts_fits_beside_an_edit_of_the_next_line():
    now = BEFORE.replace("Range(0.5, 1.5)", "Range(0.4, 1.6)")
    found = parts(WIDER, now, CHANGE)
    assert found.refused is None
    text = accepted(now, found.hunks, range(len(found.hunks)))
    assert "Range(0.3, 2)" in text and "Range(0.4, 1.6)" in text


def test_a_part_of_which_the_author_has_edited_the_lines_is_refused_and_the_others_fit():
    now = BEFORE.replace("Range(0.3, 1.2)", "Range(0.3, 1.4)")
    found = parts(BOTH, now, CHANGE)
    first, second = found.hunks
    assert found.refused and "edited" in found.refused
    assert first.refused and "the same lines" in first.refused and second.refused is None
    with pytest.raises(EditError, match="part 1 does not fit"):
        accepted(now, found.hunks, (0, 1))
    assert "2 * height" in accepted(now, found.hunks, (1,)) and "1.4" in accepted(now, found.hunks, (1,))


def test_two_that_add_lines_at_one_place_meet():
    added = BEFORE + "\n\nPI = 3\n"
    (hunk,) = parts(added, BEFORE + "\n\nMINE = 1\n").hunks
    assert hunk.refused
    (hunk,) = parts(added, "MINE = 1\n" + BEFORE).hunks
    assert hunk.refused is None
    assert accepted("MINE = 1\n" + BEFORE, (hunk,), (0,)) == "MINE = 1\n" + added


def test_a_part_that_is_no_python_alone_is_refused():
    after = BEFORE.replace("    return top(height, width)\n", "    if height:\n        return 1\n    return 2\n")
    split = parts(after, BEFORE).hunks
    broken = (type(split[0])(split[0].at, split[0].removed, split[0].added[:1]),)
    with pytest.raises(EditError, match="no Python"):
        accepted(BEFORE, broken, (0,))


def test_a_number_that_is_none_is_refused():
    for number in (-1, 2, 10**9):
        with pytest.raises(EditError, match="no part"):
            accepted(BEFORE, parts(BOTH, BEFORE).hunks, (number,))


def test_a_last_line_without_an_end_gets_one_where_lines_follow():
    (hunk,) = merging(None, "a = 1", "a = 1\nb = 2\n", "a = 1").hunks
    assert accepted("a = 1", (hunk,), (0,)) == "a = 1\nb = 2\n"
