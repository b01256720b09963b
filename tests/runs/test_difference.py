"""Two texts line by line."""

from shapewright.runs.difference import CONTEXT, changed, difference

BEFORE = "\n".join(f"line {i}" for i in range(20))
AFTER = BEFORE.replace("line 10", "other\nmore")


def test_lines_are_the_same_removed_or_added():
    lines = list(difference(BEFORE, AFTER))
    assert [line.text for line in lines if line.kind == "removed"] == ["line 10"]
    assert [(line.after, line.text) for line in lines if line.kind == "added"] == [(11, "other"), (12, "more")]
    assert "\n".join(line.text for line in lines if line.kind != "removed") == AFTER
    assert all(line.before == line.after for line in lines[:10])


def test_only_what_is_near_a_change_is_shown():
    lines = changed(BEFORE, AFTER)
    assert len(lines) == 3 + 2 * CONTEXT and lines[0].text == "line 7" and lines[-1].text == "line 13"
    assert changed(BEFORE, BEFORE) == []
