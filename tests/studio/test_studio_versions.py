"""What is shown says which text of the procedure made it, whoever wrote that text or that run."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from typing import Any

import pytest
import trimesh

from shapewright.procedures import load_procedure
from studio_client import PROCEDURE, Studio, ready, studio

FIT = ("--samples", "40", "--epochs", "1", "--refine", "off", "--workers", "1", "--time-limit", "1", "--no-auto-fit")


@pytest.fixture(scope="module")
def fitted(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """Five tables, and a run of the procedure on disk."""
    folder = tmp_path_factory.mktemp("versions")
    (folder / "references").mkdir()
    (folder / "procedure.py").write_text(PROCEDURE)
    procedure = load_procedure(folder / "procedure.py")
    for i in range(5):
        mesh = procedure(height=0.4 + 0.15 * i, leg=0.1, shelf=bool(i % 2))
        trimesh.Trimesh(mesh.vertices, mesh.faces, process=False).export(folder / "references" / f"t{i}.ply")
    with studio(folder, *FIT) as started:
        started.wait_for(ready)
        started.send("POST", "/api/fit", {}, 202)
        started.wait_for(lambda s: s["runs"] and s["jobs"]["fit"]["state"] == "done", 240)
        yield started


def tiles(state: dict[str, Any]) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = state["collection"]["tiles"]
    return found


def stale(state: dict[str, Any]) -> list[str]:
    return [tile["slug"] for tile in tiles(state) if tile["stale"]]


def measured(state: dict[str, Any]) -> bool:
    return all(tile["distance"] is not None for tile in tiles(state))


def test_back_at_a_fitted_text_its_own_replicas_and_counts_are_shown(fitted: Studio) -> None:
    before = fitted.get("/api/state")["collection"]
    fitted.edit(PROCEDURE.replace("(1.0, 0.08, 0.7)", "(1.0, 0.5, 0.3)"))
    edited = fitted.wait_for(lambda s: measured(s) and {t["stage"] for t in tiles(s)} == {"carried"})
    assert stale(edited) == [] and edited["collection"]["tiles"] != before["tiles"]
    assert edited["procedure"]["stale"]  # its replicas are of this text, its run is not
    fitted.edit(PROCEDURE)
    state = fitted.wait_for(lambda s: {t["stage"] for t in tiles(s)} == {"trained"})
    again = state["collection"]
    assert not state["procedure"]["stale"]
    assert again["counts"] == before["counts"] and again["tiles"] == before["tiles"]


def test_what_a_hanging_text_did_not_make_is_marked(fitted: Studio) -> None:
    hanging = PROCEDURE.replace("    top = box", "    while height:\n        pass\n    top = box")
    fitted.edit(hanging)
    state = fitted.wait_for(lambda s: sum(t["problem"] is not None for t in tiles(s)) >= 3)
    assert len(stale(state)) == 5 and state["procedure"]["stale"]
    assert any(problem["kind"] == "time" for problem in state["problems"])
    fitted.edit(PROCEDURE)
    assert stale(fitted.wait_for(lambda s: not any(t["problem"] for t in tiles(s)))) == []


def test_a_text_that_is_being_read_has_made_nothing_yet(fitted: Studio) -> None:
    fitted.listen()
    fitted.save(PROCEDURE.replace("0.08", "0.09"))
    fitted.next(lambda m: m["type"] == "procedure" and m["procedure"]["state"] == "loading")
    shown = [m["collection"] for m in fitted.messages if m["type"] == "collection"]
    assert all(tile["stale"] for tile in shown[-1]["tiles"])
    fitted.edit(PROCEDURE)
    assert stale(fitted.wait_for(ready)) == []


def beside(fitted: Studio, name: str, **procedure: str) -> None:
    """Another program writes a run: whole or not at all, and of this procedure but for some entries."""
    first = fitted.folder / "runs" / "001"
    partial = fitted.folder / "runs" / f".{name}.partial"
    shutil.copytree(first, partial)
    record = json.loads((partial / "iteration.json").read_text())
    record["procedure"] |= procedure
    record["created"] = f"2999-01-01T00:00:{int(name):02d}+00:00"
    (partial / "iteration.json").write_text(json.dumps(record))
    partial.rename(fitted.folder / "runs" / name)


def test_a_run_that_is_made_beside_the_page_is_followed(fitted: Studio) -> None:
    beside(fitted, "041")
    state = fitted.wait_for(lambda s: s["collection"]["run"] == "041", 10)
    assert [run["run"] for run in state["runs"] if run["current"]] == ["041"] and stale(state) == []
    beside(fitted, "042", digest="0" * 16)
    state = fitted.wait_for(lambda s: s["runs"][-1]["run"] == "042", 10)
    assert state["collection"]["run"] == "041" and stale(state) == []
    (fitted.folder / "runs" / "041" / "explanation.json").write_text('{"references": {}, "suggestions": []}')
    fitted.wait_for(lambda s: s["explanation"], 10)
    for name in ("041", "042"):
        shutil.rmtree(fitted.folder / "runs" / name)
    state = fitted.wait_for(lambda s: s["collection"]["run"] == "001", 10)
    assert [run["run"] for run in state["runs"]] == ["001"]


def test_helpers_that_changed_make_another_version(fitted: Studio) -> None:
    text = "import sizes\n" + PROCEDURE.replace("0.08", "sizes.THICK")
    (fitted.folder / "sizes.py").write_text("THICK = 0.08\n")
    fitted.edit(text)
    fitted.wait_for(lambda s: {t["stage"] for t in tiles(s)} == {"carried"} and measured(s))
    fitted.send("POST", "/api/fit", {}, 202)
    run = fitted.wait_for(lambda s: s["jobs"]["fit"]["state"] == "done" and s["collection"]["run"] != "001", 240)
    assert stale(run) == []
    fitted.save("THICK = 0.4\n", "sizes.py")
    fitted.wait_for(lambda s: {t["stage"] for t in tiles(s)} == {"carried"} and measured(s))
    fitted.save("THICK = 0.08\n", "sizes.py")
    again = fitted.wait_for(lambda s: {t["stage"] for t in tiles(s)} == {"trained"})
    assert tiles(again) == tiles(run)
