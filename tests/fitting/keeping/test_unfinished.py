"""What is done of a fit is kept piece by piece, whole or not at all."""

import os
import time

import pytest

from broken_disk import full_after, hidden, killed
from shapewright.fitting.keeping.unfinished import Form, Unfinished
from shapewright.runs.folder import RunError

WORDS = Form(lambda words: (" ".join(words).encode(), [b"rest"]), lambda head, rest: head.decode().split())
FACTS = {"seed": 1}


def never():
    raise AssertionError("it is kept already")


def begun(root, facts=FACTS, least=0.0, **how):
    unfinished = Unfinished(root, least=least, **how)
    unfinished.begin(facts)
    return unfinished


def test_a_piece_is_made_once(tmp_path):
    assert begun(tmp_path).piece("a", WORDS, lambda: ["one", "two"]) == ["one", "two"]
    assert begun(tmp_path).piece("a", WORDS, never) == ["one", "two"]


def test_other_facts_are_another_fit_and_fresh_forgets(tmp_path):
    begun(tmp_path).piece("a", WORDS, lambda: ["one"])
    assert begun(tmp_path, {"seed": 2}).known("a", WORDS) is None
    assert begun(tmp_path).known("a", WORDS) == ["one"]
    assert begun(tmp_path, fresh=True).known("a", WORDS) is None


def test_it_says_whether_it_goes_on(tmp_path):
    assert not Unfinished(tmp_path).begin(FACTS)
    begun(tmp_path).piece("a", WORDS, lambda: ["one"])
    assert Unfinished(tmp_path).begin(FACTS)
    assert not Unfinished(tmp_path, fresh=True).begin(FACTS)


def test_what_took_no_time_is_not_kept(tmp_path):
    begun(tmp_path, least=60.0).piece("a", WORDS, lambda: ["one"])
    assert begun(tmp_path).known("a", WORDS) is None
    begun(tmp_path, least=60.0).piece("a", WORDS, lambda: ["one"], always=True)
    assert begun(tmp_path).known("a", WORDS) == ["one"]


def test_a_kill_while_a_piece_is_written_leaves_none(tmp_path):
    unfinished = begun(tmp_path)
    killed(lambda: unfinished.keep("a", WORDS, ["one"]))
    assert unfinished.known("a", WORDS) is None and unfinished.names("") == [] and len(hidden(tmp_path)) == 1
    assert unfinished.piece("a", WORDS, lambda: ["two"]) == ["two"]
    assert unfinished.names("") == ["a"]


def test_a_damaged_piece_is_made_again(tmp_path):
    unfinished = begun(tmp_path)
    unfinished.keep("a", Form(lambda _: (b"\xff\xfe", ()), lambda head, _: head), None)
    assert unfinished.piece("a", WORDS, lambda: ["two"]) == ["two"]


def test_a_full_disk_ends_only_what_needs_it(tmp_path):
    unfinished = begun(tmp_path)
    unfinished.keep("before", WORDS, ["one"])
    with full_after(100):
        assert unfinished.piece("a", WORDS, lambda: ["long"] * 100) == ["long"] * 100
        with pytest.raises(RunError, match="what was done before is kept: free some space and repeat the command"):
            unfinished.piece("b", WORDS, lambda: ["long"] * 100, always=True)
    assert unfinished.names("") == ["before"] and not hidden(tmp_path)
    assert begun(tmp_path).known("before", WORDS) == ["one"]


def test_a_fact_stays_as_it_was(tmp_path):
    assert begun(tmp_path).once("shapes", 40) == 40
    assert begun(tmp_path).once("shapes", 50) == 40
    assert Unfinished().once("shapes", 50) == 50


def test_nothing_is_left_of_a_run_that_is_written(tmp_path):
    root = tmp_path / ".unfinished"
    unfinished = begun(root)
    unfinished.piece("a", WORDS, lambda: ["one"])
    unfinished.remove()
    assert not root.exists()


def test_another_fit_stays_when_one_is_written(tmp_path):
    other = begun(tmp_path, {"seed": 2})
    other.piece("a", WORDS, lambda: ["one"])
    begun(tmp_path).piece("a", WORDS, lambda: ["two"])
    begun(tmp_path).remove()
    assert other.known("a", WORDS) == ["one"]


def test_what_nobody_goes_on_with_is_removed_at_last(tmp_path):
    begun(tmp_path, {"seed": 2}).piece("a", WORDS, lambda: ["one"])
    (folder,) = tmp_path.iterdir()
    long_ago = time.time() - 40 * 24 * 3600
    os.utime(folder, (long_ago, long_ago))
    begun(tmp_path)
    assert not folder.exists()


def test_without_a_folder_what_memory_cannot_hold_is_kept_until_the_end(tmp_path):
    unfinished = Unfinished()
    unfinished.begin(FACTS)
    unfinished.piece("small", WORDS, lambda: ["one"])
    unfinished.piece("large", WORDS, lambda: ["two"], always=True)
    assert unfinished.known("large", WORDS) == ["two"] and unfinished.known("small", WORDS) is None
    unfinished.remove()
    assert unfinished.known("large", WORDS) == ["two"]
