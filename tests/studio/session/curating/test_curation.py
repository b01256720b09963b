"""What the author says of many references at once is kept, can be undone, and does what it says."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import trimesh

from shapewright.references import Collection
from shapewright.studio.session.curating.curation import _pattern
from shapewright.survey.preparation import _is_named
from studio_client import PROCEDURE, Studio, ready, studio

SIZES = {"a": (1, 0.7, 0.6), "b": (1, 0.5, 0.2), "c": (0.3, 1, 0.2), "a again": (1, 0.7, 0.6)}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    home = tmp_path / "blocks"
    (home / "references").mkdir(parents=True)
    for name, size in SIZES.items():
        trimesh.creation.box(size).export(home / "references" / f"{name}.stl")
    (home / "procedure.py").write_text(PROCEDURE)
    return home


@pytest.fixture
def running(folder: Path) -> Iterator[Studio]:
    with studio(folder, "--no-auto-fit", "--workers", "1") as started:
        started.wait_for(ready)
        yield started


def note(running: Studio, *slugs: str, **order: Any) -> int:
    number: int = running.send("PATCH", "/api/notes", {"slugs": slugs, **order})["number"]
    return number


def undo(running: Studio, number: int) -> Any:
    return running.send("POST", f"/api/told/{number}/undo", {})["number"]


def noted(running: Studio) -> Any:
    return running.get("/api/state")["noted"]


def test_notes_are_told_one_by_one_last_over_a_restart_and_are_taken_back_one_by_one(folder: Path) -> None:
    with studio(folder, "--no-auto-fit") as running:
        running.wait_for(ready)
        running.listen()
        first = note(running, "a", "b", add=["tall", "mine"])
        assert running.next(lambda m: m["type"] == "noted")["noted"]["a"]["tags"] == ["tall", "mine"]
        second = note(running, "a", note="  the good one ")
        third = note(running, "b", "c", add=["odd"], remove=["tall"])
        assert note(running, "a", add=["tall"]) is None  # it has it already: nothing to undo
        assert noted(running) == {
            "a": {"tags": ["tall", "mine"], "note": "the good one", "not_mine": False},
            "b": {"tags": ["mine", "odd"], "note": "", "not_mine": False},
            "c": {"tags": ["odd"], "note": "", "not_mine": False},
        }
    with studio(folder, "--no-auto-fit") as running:
        running.wait_for(ready)
        assert noted(running)["b"]["tags"] == ["mine", "odd"]
        undo(running, first)  # what was said since stays
        assert noted(running) == {
            "a": {"tags": [], "note": "the good one", "not_mine": False},
            "b": {"tags": ["odd"], "note": "", "not_mine": False},
            "c": {"tags": ["odd"], "note": "", "not_mine": False},
        }
        undo(running, undo(running, first) or second)
        told = {one["number"]: one for one in running.get("/api/told")}
        assert told[third]["added"] == ["odd"] and told[third]["removed"] == ["tall"]
        assert told[third]["references"] == ["b", "c"] and told[first]["undone"]
    assert json.loads((folder / "notes.json").read_text())


def test_what_is_not_mine_leaves_the_count_and_the_next_fit_and_comes_back(running: Studio) -> None:
    number = note(running, "b", "c", not_mine=True)
    collection = running.get("/api/state")["collection"]
    assert collection["count"] == 2 and set(collection["left_out"]) == {"b", "c"} and len(collection["tiles"]) == 4
    assert sum(collection["counts"][grade] for grade in ("replicated", "close", "different")) == 2
    running.send("PATCH", "/api/settings", {"samples": 200, "epochs": 1, "refine": "off"})
    running.send("POST", "/api/fit", {"fresh": True}, 202)
    running.wait_for(lambda s: bool(s["runs"]) and s["jobs"]["fit"]["state"] == "done", 200)
    assert {one["name"] for one in running.get_run("001")["references"]} == {"a", "a again"}
    undo(running, number)
    assert running.get("/api/state")["collection"]["count"] == 4


@pytest.mark.parametrize("name", ["a", "[odd] name", "x, y", " blank ", "-dash", "ü*", "?"])
def test_a_name_is_left_out_whatever_is_in_it_and_no_other_like_it(name: str) -> None:
    class Named:
        def __init__(self, name: str) -> None:
            self.name = name

    pattern = [word.strip() for word in _pattern(name).split(",")]
    assert len(pattern) == 1
    assert _is_named(Named(name), pattern)  # type: ignore[arg-type]
    assert not _is_named(Named(name + "2"), pattern)  # type: ignore[arg-type]
    # A name that is gone by the next fit is no mistake: it is a pattern.
    assert any(sign in pattern[0] for sign in "*?[/")


def test_references_are_turned_from_how_they_stand_and_back_and_the_next_fit_reads_that(
    running: Studio, folder: Path
) -> None:
    def stand(slug: str) -> Any:
        axes = running.get(f"/api/references/{slug}")["units"]["axes"]
        return [[round(x) for x in row] for row in axes]

    before = stand("a")
    for _ in range(4):
        last = running.send("POST", "/api/references/turn", {"slugs": ["a", "b"], "turn": "around"})["number"]
    assert stand("a") == before and running.get("/api/references/a")["told"]["up"] == "y"
    undo(running, last)
    assert stand("a") != before
    running.send("POST", "/api/references/turn", {"slugs": ["a"], "turn": "around"})
    running.send("POST", "/api/references/turn", {"slugs": ["a", "c"], "turn": "tip"})
    assert stand("a")[1] == [0, 0, -1] == stand("c")[1]  # the back points up: what lay on its face stands
    running.send("POST", "/api/references/turn", {"slugs": ["c"], "turn": "over"})
    assert stand("c")[1] == [0, 0, 1]
    read = {each.name: each.orientation for each in Collection.load(folder / "references")}
    assert (read["a"].up, read["c"].up) == ("-z", "z") and read["a again"].up == "y"


def test_the_same_shape_twice_is_told_and_the_most_alike_come_first(running: Studio) -> None:
    state = running.wait_for(lambda s: bool(s["duplicates"]))
    assert state["duplicates"] == [{"slug": "a-again", "of": "a", "equal": True, "quarters": 0}]
    alike = running.get("/api/references/a/alike")
    assert next(iter(alike)) == "a-again" and alike["a-again"] == 0 and set(alike) == {"a-again", "b", "c"}
    assert list(alike.values()) == sorted(alike.values())


def test_the_map_has_references_and_samples_and_is_the_same_each_time(running: Studio) -> None:
    running.wait_for(lambda s: bool(s["duplicates"]))
    found = running.get("/api/map")
    places = {one["slug"]: (one["x"], one["y"]) for one in found["references"]}
    assert set(places) == {"a", "a-again", "b", "c"} and found["left"] == 0 and len(found["samples"]) > 20
    assert places["a"] == pytest.approx(places["a-again"], abs=1e-3) and places["a"] != places["c"]
    assert all(-1 <= one["x"] <= 1 and -1 <= one["y"] <= 1 for one in (*found["references"], *found["samples"]))
    assert running.get("/api/map") == found != running.get("/api/map?seed=5")


def test_a_file_of_notes_that_cannot_be_read_is_a_problem_and_is_not_written_over(folder: Path) -> None:
    (folder / "notes.json").write_text('[{"name": "a", "tags": 7}]')
    with studio(folder, "--no-auto-fit") as running:
        state = running.wait_for(ready)
        assert any("notes.json" in problem["message"] for problem in state["problems"])
        running.send("PATCH", "/api/notes", {"slugs": ["a"], "add": ["x"]}, 409)
    assert (folder / "notes.json").read_text() == '[{"name": "a", "tags": 7}]'
