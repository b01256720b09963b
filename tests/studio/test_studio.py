"""The studio's loop, from outside: a real server, its WebSocket and its routes."""

from __future__ import annotations

import io
import json
import os
import shutil
import signal
import subprocess
import time
import zipfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from shapewright.cli.runs import judged_by_marks
from shapewright.comparison.gaps import Surface
from shapewright.procedures import load_procedure
from shapewright.references import Collection
from shapewright.settings import Settings
from shapewright.studio.project.watch import fingerprint
from shapewright.studio.project.workspace import Project
from shapewright.studio.wire.answers import parse
from studio_client import PROCEDURE, Studio, ready, studio

FIT = ("--samples", "40", "--epochs", "1", "--refine", "off", "--workers", "1", "--time-limit", "1")


def make_project(folder: Path) -> Path:
    """Four tables that the procedure can make, a bowl that it cannot, and a file that cannot be read."""
    (folder / "references").mkdir(parents=True)
    (folder / "procedure.py").write_text(PROCEDURE)
    procedure = load_procedure(folder / "procedure.py")
    for i, height in enumerate((0.4, 0.6, 0.8, 1.0)):
        mesh = procedure(height=height, leg=0.1, shelf=bool(i % 2))
        trimesh.Trimesh(mesh.vertices * 50.0, mesh.faces, process=False).export(
            folder / "references" / f"table {i}.ply"
        )
    trimesh.creation.icosphere(2).export(folder / "references" / "ball.obj")
    (folder / "references" / "broken.stl").write_text("no mesh")
    return folder


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    with studio(make_project(tmp_path_factory.mktemp("project")), *FIT) as started:
        started.wait_for(ready)
        started.listen()
        yield started


@pytest.fixture
def mended(running: Studio) -> Iterator[Studio]:
    """The running studio; the procedure is as it was again afterwards, and nothing fits."""
    running.send("PATCH", "/api/settings", {"auto_fit": False})
    yield running
    running.edit(PROCEDURE)
    running.wait_for(lambda s: s["jobs"]["fit"]["state"] not in ("running", "cancelling"))


def fit(running: Studio) -> dict[str, Any]:
    running.send("POST", "/api/fit", {}, 202)
    running.next(lambda m: m["type"] == "job" and m["job"]["state"] == "running")
    ended = running.next(lambda m: m["type"] == "job" and m["job"]["state"] in ("done", "failed", "cancelled"), 120)
    assert ended["job"]["state"] == "done", ended
    return running.get("/api/state")


@pytest.fixture(scope="module")
def fitted(running: Studio) -> Studio:
    running.send("PATCH", "/api/settings", {"auto_fit": False})
    fit(running)
    return running


def test_references_are_shown_before_any_fit(running: Studio) -> None:
    state = running.wait_for(lambda s: len(s["collection"]["tiles"]) == 5)
    assert [tile["name"] for tile in state["collection"]["tiles"]] == ["ball"] + [f"table {i}" for i in range(4)]
    assert "broken.stl" in str(state["collection"]["skipped"])
    state = running.wait_for(lambda s: all(tile["reference"] for tile in s["collection"]["tiles"]))
    address = state["collection"]["tiles"][0]["reference"]
    status, body, headers = running.request("GET", address)
    assert status == 200 and body.startswith(b"\x89PNG") and "immutable" in headers["cache-control"]


def test_parameter_space_is_described(running: Studio) -> None:
    by_name = {p["name"]: p for p in running.get("/api/state")["procedure"]["parameters"]}
    assert by_name["height"] == {
        "name": "height", "kind": "scalar", "low": 0.3, "high": 1.2, "steps": None, "options": None, "default": 0.6,
        "meaning": "", "conditional": False,
    }  # fmt: skip
    assert by_name["leg"]["steps"] == 4 and by_name["shelf_height"]["conditional"]


def test_live_evaluation(running: Studio) -> None:
    values = {"height": 0.8, "leg": 0.1, "shelf": True}
    running.say(type="evaluate", id=1, slug="table-1", parameters=values, residuals=True)
    mesh = running.next(lambda m: m["type"] == "mesh" and m["id"] == 1)
    assert mesh["vertices"] * 3 == mesh["arrays"]["positions"].size
    assert np.abs(mesh["arrays"]["positions"]).max() == pytest.approx(0.5)
    assert set(mesh["label_names"]) == {"top", "legs", "shelf"}
    assert mesh["active"] == ["height", "leg", "shelf", "shelf_height"] and mesh["at_limit"] == []
    assert mesh["units"]["size"] == pytest.approx([1.0, 0.84, 0.7])
    told = running.next(lambda m: m["type"] == "verdict" and m["id"] == 1)
    assert told["distance"] is not None and told["colour"].startswith("#")
    sides = [running.next(lambda m: m["type"] == "residuals" and m["id"] == 1) for _ in range(2)]
    assert [side["shape"] for side in sides] == ["replica", "reference"]
    for side in sides:
        assert side["arrays"]["colours"].size == 3 * side["vertices"]
        assert side["arrays"]["distances"].size == side["vertices"]


def test_residuals_of_the_same_shape_are_nought(running: Studio) -> None:
    running.say(type="evaluate", id=2, slug="table-1", parameters={"height": 0.6, "shelf": True}, residuals=True)
    told = running.next(lambda m: m["type"] == "verdict" and m["id"] == 2)
    assert told["distance"] == 0.0 and told["compatible"]
    side = running.next(lambda m: m["type"] == "residuals" and m["id"] == 2)
    assert np.abs(side["arrays"]["distances"]).max() < 1e-5


def test_chamfer_is_sampled_with_the_seed_of_the_settings(running: Studio) -> None:
    reference = Collection.load(running.folder / "references")["table 1"].shape
    replica = load_procedure(running.folder / "procedure.py")(height=0.8)
    for number, seed in ((3, 5), (4, 0)):
        running.send("PATCH", "/api/settings", {"seed": seed})
        running.say(type="evaluate", id=number, slug="table-1", parameters={"height": 0.8}, residuals=False)
        told = running.next(lambda m, number=number: m["type"] == "verdict" and m["id"] == number)
        gaps = Surface(reference, seed).gaps(Surface(replica, seed))
        assert told["measures"]["chamfer"] == pytest.approx(gaps.chamfer, abs=1e-9)


def test_of_evaluations_that_wait_only_the_newest_counts(running: Studio) -> None:
    for number in range(10, 60):
        running.say(type="evaluate", id=number, slug="ball", parameters={"height": 0.3 + number / 100}, residuals=True)
    last = running.next(lambda m: m["type"] == "residuals" and m["id"] == 59 and m["shape"] == "reference")
    answered = {m["id"] for m in running.messages if m["type"] == "mesh" and m["id"] >= 10}
    assert last["slug"] == "ball" and 59 in answered and len(answered) < 50


def test_a_wrong_message_is_answered_not_obeyed(running: Studio) -> None:
    for wrong in ({"type": "evaluate", "id": "x"}, {"type": "evaluate", "id": 1, "slug": "no"}, {"type": "rm"}, [1]):
        assert running.socket
        running.socket.send(json.dumps(wrong))
        assert running.next(lambda m: m["type"] == "wrong")["error"]


def test_reference_in_its_own_units(running: Studio) -> None:
    about = running.get("/api/references/table-1")
    assert about["path"] == "references/table 1.ply" and about["triangles"] > 0
    assert about["units"]["size"] == pytest.approx([50.0, 32.0, 35.0], rel=1e-5)
    status, body, _ = running.request("GET", "/api/references/table-1/shape")
    header, arrays = parse(body)
    assert status == 200 and header["shape"] == "reference"
    own = (arrays["positions"].reshape(-1, 3) / about["units"]["scale"] + about["units"]["centre"]) @ np.array(
        about["units"]["axes"]
    )
    original = trimesh.load_mesh(running.folder / "references" / "table 1.ply", process=False)
    assert np.allclose(own, original.vertices, atol=1e-4)


def test_a_fit_shows_early_answers_and_ends_in_a_run(fitted: Studio) -> None:
    state = fitted.get("/api/state")
    assert state["runs"][-1]["references"] == 5 and state["runs"][-1]["current"]
    assert {tile["stage"] for tile in state["collection"]["tiles"]} == {"trained"}
    assert all(tile["replica"] and tile["distance"] is not None for tile in state["collection"]["tiles"])
    told = [m["job"] for m in fitted.messages if m["type"] == "job" and m["job"]["kind"] == "fit"]
    assert {"most similar samples", "predicted"} <= {job["answer"] for job in told}
    assert [stage["name"] for stage in told[-1]["stages"]][:4] == ["open", "sample", "render", "train"]
    assert told[-1]["curve"][0]["epoch"] == 1 and told[-1]["result"] == {"run": state["runs"][-1]["run"]}
    stages = {tile["stage"] for m in fitted.messages if m["type"] == "tiles" for tile in m["tiles"]}
    assert "early" in stages  # predictions of one epoch are worse than those, and are not shown
    for group in state["collection"]["groups"]:
        assert group["representative"] in group["members"]


def test_predicted_values_and_their_spread(fitted: Studio) -> None:
    about = fitted.get("/api/references/table-0")
    assert 0.3 <= about["predicted"]["height"] <= 1.2 and about["spread"]["height"] > 0.0
    assert sum(about["likelihood"]["shelf"].values()) == pytest.approx(1.0, abs=1e-3)
    assert set(about["parameters"]) == {"height", "leg", "shelf", "shelf_height"}


def test_what_is_counted_is_what_the_run_says(fitted: Studio) -> None:
    collection = fitted.get("/api/state")["collection"]
    entries = fitted.get_run(collection["run"])["references"]
    grades = [entry["grade"] for entry in entries]
    counts = {grade: grades.count(grade) for grade in ("replicated", "close", "different")}
    counts["compatible"] = sum(entry["compatible"] for entry in entries)
    assert collection["judge"] == "fidelity" and collection["counts"] == counts
    assert fitted.get("/api/state")["runs"][-1]["counts"] == counts
    grouped = {slug for group in collection["groups"] for slug in group["members"]}
    assert not grouped & {tile["slug"] for tile in collection["tiles"] if tile["grade"] == "replicated"}


def test_live_grades_are_those_of_the_fit(fitted: Studio) -> None:
    collection = fitted.get("/api/state")["collection"]
    entries = {entry["name"]: entry for entry in fitted.get_run(collection["run"])["references"]}
    for number, tile in enumerate(collection["tiles"], start=300):
        entry = entries[tile["name"]]
        fitted.say(type="evaluate", id=number, slug=tile["slug"], parameters=entry["parameters"])
        told = fitted.next(lambda m, number=number: m["type"] == "verdict" and m["id"] == number)
        assert told["grade"] == entry["grade"] and told["compatible"] == entry["compatible"]
        assert told["colour"] == tile["colour"]
        for name, value in told["measures"].items():
            assert value == (None if entry[name] is None else pytest.approx(entry[name], abs=1e-6)), name
        for side in ("missing", "surplus"):
            assert [piece["size"] for piece in told[side]] == pytest.approx(
                [region["size"] for region in entry[side]], abs=1e-4
            )


def test_carried_replicas_are_graded_as_those_of_the_fit(fitted: Studio, mended: Studio) -> None:
    before = {tile["slug"]: tile for tile in fitted.get("/api/state")["collection"]["tiles"]}
    mended.edit(PROCEDURE + "\n# the same again\n")

    def measured(state: dict[str, Any]) -> bool:
        return all(t["stage"] == "carried" and t["fidelity"] is not None for t in state["collection"]["tiles"])

    for tile in mended.wait_for(measured)["collection"]["tiles"]:
        was = before[tile["slug"]]
        assert tile["grade"] == was["grade"] and tile["compatible"] == was["compatible"]
        assert tile["fidelity"] == pytest.approx(was["fidelity"], abs=1e-6) and tile["colour"] == was["colour"]


def test_another_cut_gives_other_grades_at_once_live_ones_too(fitted: Studio) -> None:
    tiles = fitted.get("/api/state")["collection"]["tiles"]
    best = max(tiles, key=lambda tile: tile["fidelity"])
    cut = min(0.99, best["fidelity"] + (1.0 - best["fidelity"]) / 2.0)
    fitted.send("PATCH", "/api/settings", {"replicated": cut})
    changed = fitted.get("/api/state")["collection"]
    assert changed["replicated"] == cut and changed["counts"]["replicated"] == sum(t["fidelity"] >= cut for t in tiles)
    values = fitted.get(f"/api/references/{best['slug']}")["parameters"]
    fitted.say(type="evaluate", id=400, slug=best["slug"], parameters=values)
    told = fitted.next(lambda m: m["type"] == "verdict" and m["id"] == 400)
    assert told["grade"] == next(t for t in changed["tiles"] if t["slug"] == best["slug"])["grade"]
    fitted.send("PATCH", "/api/settings", {"replicated": Settings.replicated})
    assert fitted.get("/api/state")["collection"]["tiles"] == tiles


def mark(running: Studio, a: str, b: str, same: bool | None, status: int = 200) -> Any:
    return running.send("PATCH", "/api/marks", {"a": a, "b": b, "same": same}, status)


def test_marks_move_the_cut_as_on_the_command_line(fitted: Studio) -> None:
    tiles = fitted.get("/api/state")["collection"]["tiles"]
    for tile in tiles:
        mark(fitted, tile["slug"], tile["slug"], False)
    state = fitted.get("/api/state")
    found = judged_by_marks(fitted.folder / "runs" / state["collection"]["run"], "fidelity")
    now = {name: state["settings"][name] for name in found}
    assert now == found == {name: state["collection"][name] for name in found}
    assert state["marking"]["learned"]["count"] == len(tiles) and state["marking"]["asked"] == []
    for tile in tiles:
        mark(fitted, tile["slug"], tile["slug"], None)
    state = fitted.get("/api/state")
    assert state["marking"]["learned"] is None and state["collection"]["replicated"] == Settings.replicated


def test_a_run_of_before_the_judge_opens_by_the_papers(fitted: Studio, tmp_path: Path) -> None:
    shutil.copytree(fitted.folder / "references", tmp_path / "references")
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    run = tmp_path / "runs" / "001"
    shutil.copytree(fitted.folder / "runs" / fitted.get("/api/state")["collection"]["run"], run)
    record = json.loads((run / "iteration.json").read_text())
    for name in ("judge", "worth_marking"):
        del record[name]
    for name in ("judge", "replicated", "close", "vif"):
        del record["settings"][name]
    for entry in record["references"]:
        for name in ("grade", "fidelity", "missing", "surplus", "volume_iou", "f1", "f2"):
            del entry[name]
    (run / "iteration.json").write_text(json.dumps(record))
    with studio(tmp_path, *FIT, "--no-auto-fit") as opened:
        collection = opened.get("/api/state")["collection"]
        compatible = sum(entry["compatible"] for entry in record["references"])
        assert collection["judge"] == "paper" and collection["counts"]["compatible"] == compatible
        assert collection["counts"]["replicated"] == compatible and collection["counts"]["close"] == 0
        assert {tile["fidelity"] for tile in collection["tiles"]} == {None}
        opened.send("PATCH", "/api/settings", {"replicated": 0.6})
        assert opened.get("/api/state")["collection"]["judge"] == "paper"


def test_a_save_shows_carried_replicas_and_then_fits(fitted: Studio) -> None:
    fitted.send("PATCH", "/api/settings", {"auto_fit": True})
    before = fitted.get("/api/state")
    seen = len(fitted.messages)
    fitted.save(
        PROCEDURE.replace("0.08", "0.12")
        .replace("leg: ", "post: ")
        .replace("(leg, height, leg)", "(post, height, post)")
    )
    carried = fitted.next(lambda m: m["type"] == "tiles" and m["tiles"][0]["stage"] == "carried")
    assert carried["tiles"][0]["replica"]
    fitted.next(lambda m: m["type"] == "runs", 120)
    kinds = [m["type"] for m in fitted.messages[seen:]]
    assert kinds.index("procedure") < kinds.index("tiles") and "job" in kinds
    state = fitted.get("/api/state")
    assert len(state["runs"]) == len(before["runs"]) + 1 and state["jobs"]["fit"]["state"] == "done"
    assert [p["name"] for p in state["procedure"]["parameters"]] == ["height", "post", "shelf", "shelf_height"]
    fitted.send("PATCH", "/api/settings", {"auto_fit": False})


def test_going_back_shows_the_run_without_another_fit(fitted: Studio) -> None:
    first, *_, last = [run["run"] for run in fitted.get("/api/state")["runs"]]
    assert first != last
    current = fitted.get("/api/source")
    fitted.send("POST", f"/api/runs/{first}/restore", {"digest": "0" * 16}, 409)
    answer = fitted.send("POST", f"/api/runs/{first}/restore", {"digest": current["digest"]})
    state = fitted.wait_for(lambda s: s["collection"]["run"] == first)
    assert (fitted.folder / "procedure.py").read_text() == PROCEDURE
    assert {tile["stage"] for tile in state["collection"]["tiles"]} == {"trained"}
    newest = fitted.get("/api/revisions")[0]
    assert (newest["number"], newest["writer"], newest["of"]) == (answer["revision"], "run", first)
    undone = fitted.send("POST", f"/api/revisions/{newest['number']}/undo", {"digest": answer["digest"]})
    assert fitted.get("/api/source") == current
    fitted.send("POST", f"/api/revisions/{undone['revision']}/undo", {"digest": "0" * 16}, 409)
    fitted.send("POST", f"/api/revisions/{undone['revision']}/undo", {"digest": undone["digest"]})
    assert (fitted.folder / "procedure.py").read_text() == PROCEDURE


def test_two_runs_side_by_side(fitted: Studio) -> None:
    first, *_, last = [run["run"] for run in fitted.get("/api/state")["runs"]]
    found = fitted.get(f"/api/compare?before={first}&after={last}")
    assert found["before"]["run"] == first and found["after"]["run"] == last
    counted = sum(len(found[kind]) for kind in ("gained", "lost", "closer", "further")) + found["same"]
    assert counted == 5 and found["added"] == [] and found["removed"] == []
    changed = [line for line in found["diff"] if line["kind"] != "same"]
    assert any(line["kind"] == "added" and "post: " in line["text"] for line in changed)
    assert any(line["kind"] == "removed" and "leg: " in line["text"] for line in changed)
    detail = fitted.get(f"/api/runs/{last}")
    assert "post: " in detail["source"] and detail["collection"]["count"] == 5 and detail["validation"]


def test_syntax_error_keeps_the_last_good_state(mended: Studio) -> None:
    state = mended.edit(PROCEDURE.replace("return top", "return return top"), "broken")
    (problem,) = [p for p in state["problems"] if p["kind"] == "syntax"]
    line = PROCEDURE.splitlines().index(next(text for text in PROCEDURE.splitlines() if "return top" in text)) + 1
    assert (problem["file"], problem["line"]) == ("procedure.py", line) and "return return" in problem["text"]
    assert [p["name"] for p in state["procedure"]["parameters"]] == ["height", "leg", "shelf", "shelf_height"]
    assert state["procedure"]["stale"] and all(tile["stale"] for tile in state["collection"]["tiles"])
    assert all(tile["replica"] for tile in state["collection"]["tiles"])
    mended.send("POST", "/api/fit", {}, 409)


def test_error_when_the_file_runs(mended: Studio) -> None:
    state = mended.edit("import nothing_of_this_name\n" + PROCEDURE, "broken")
    (problem,) = [p for p in state["problems"] if p["kind"] == "load"]
    assert problem["line"] == 1 and "nothing_of_this_name" in problem["message"]


def test_error_of_a_shape_has_its_line(mended: Studio) -> None:
    broken = PROCEDURE.replace(
        "    top = box", '    if shelf:\n        raise KeyError("no shelf today")\n    top = box'
    )
    mended.edit(broken)
    mended.say(type="evaluate", id=100, slug=None, parameters={"shelf": True})
    failed = mended.next(lambda m: m["type"] == "failed" and m["id"] == 100)
    assert failed["problem"]["kind"] == "raised" and "no shelf today" in failed["problem"]["message"]
    assert failed["problem"]["text"].startswith("raise KeyError")
    assert broken.splitlines()[failed["problem"]["line"] - 1].strip().startswith("raise KeyError")
    mended.say(type="evaluate", id=101, slug=None, parameters={"shelf": False})
    mended.next(lambda m: m["type"] == "mesh" and m["id"] == 101)


def test_version_that_fails_for_every_shape_keeps_what_was_there(mended: Studio) -> None:
    pictures = [tile["replica"] for tile in mended.get("/api/state")["collection"]["tiles"]]
    mended.edit(
        PROCEDURE.replace("    top = box", '    raise Infeasible("too wide")\n    top = box').replace(
            "Range,", "Infeasible, Range,"
        )
    )
    state = mended.wait_for(lambda s: any(p["count"] == 5 for p in s["problems"]))
    (problem,) = state["problems"]
    assert problem["kind"] == "infeasible" and len(problem["slugs"]) == 5 and "too wide" in problem["message"]
    tiles = state["collection"]["tiles"]
    assert [tile["replica"] for tile in tiles] == pictures and all(tile["stale"] for tile in tiles)


def test_only_files_that_the_procedure_names_are_its_sources(mended: Studio) -> None:
    project = Project.of(mended.folder)
    before = fingerprint(project)
    (mended.folder / "unrelated.py").write_text("x = 1")
    assert fingerprint(project) == before
    mended.edit("import helper_of_helper as h\n" + PROCEDURE, "broken")
    named = fingerprint(project)
    (mended.folder / "helper_of_helper.py").write_text("import third")
    (mended.folder / "third.py").write_text("")
    mended.wait_for(lambda s: s["procedure"]["state"] == "good")
    whole = fingerprint(project)
    (mended.folder / "third.py").write_text("y = 2")
    assert len({before, named, whole, fingerprint(project)}) == 4


def test_endless_loop_costs_a_message_with_its_line(mended: Studio) -> None:
    mended.edit(PROCEDURE.replace("    top = box", "    while shelf:\n        height += 1.0\n    top = box"))
    mended.say(type="evaluate", id=110, slug=None, parameters={"shelf": True})
    failed = mended.next(lambda m: m["type"] == "failed" and m["id"] == 110, 20)
    assert failed["problem"]["kind"] == "time" and failed["problem"]["line"]
    mended.say(type="evaluate", id=111, slug=None, parameters={"shelf": False})
    mended.next(lambda m: m["type"] == "mesh" and m["id"] == 111)


def test_endless_loop_that_no_signal_ends(mended: Studio) -> None:
    """Of code that catches everything the process is killed, and another takes its place."""
    loop = "    while shelf:\n        try:\n            while True: pass\n        except BaseException: pass\n"
    mended.edit(PROCEDURE.replace("    top = box", f"{loop}    top = box"))
    mended.say(type="evaluate", id=115, slug=None, parameters={"shelf": True})
    failed = mended.next(lambda m: m["type"] == "failed" and m["id"] == 115, 20)
    assert failed["problem"]["kind"] == "time"
    mended.say(type="evaluate", id=116, slug=None, parameters={"shelf": False})
    mended.next(lambda m: m["type"] == "mesh" and m["id"] == 116)


def test_endless_loop_when_the_file_is_read_gives_way_to_a_save(mended: Studio) -> None:
    mended.save("while True:\n    pass\n" + PROCEDURE)
    mended.wait_for(lambda s: s["procedure"]["state"] == "loading")
    assert mended.edit(PROCEDURE)["problems"] == []


@pytest.mark.parametrize(
    ("line", "kind"),
    [("import os; os._exit(3)", "crash"), ("import os; os.kill(os.getpid(), 9)", "crash"), ("bytes(2**40)", "memory")],
)
def test_crash_costs_a_message(mended: Studio, line: str, kind: str) -> None:
    mended.edit(PROCEDURE.replace("    top = box", f"    if shelf: {line}\n    top = box"))
    mended.say(type="evaluate", id=120, slug=None, parameters={"shelf": True})
    failed = mended.next(lambda m: m["type"] == "failed" and m["id"] == 120)
    assert failed["problem"]["kind"] == kind
    mended.say(type="evaluate", id=121, slug=None, parameters={"shelf": False})
    mended.next(lambda m: m["type"] == "mesh" and m["id"] == 121)


def test_bench_that_dies_starts_again(mended: Studio) -> None:
    (bench,) = [pid for pid in descendants(mended.process.pid) if "shapewright.studio.bench.program" in command(pid)]
    os.kill(bench, signal.SIGKILL)
    mended.next(lambda m: m["type"] == "state" and m["bench"] == "restarting")
    mended.say(type="evaluate", id=130, slug="ball", parameters=None)
    mended.next(lambda m: m["type"] == "verdict" and m["id"] == 130)


def test_cancelled_fit_leaves_nothing(mended: Studio) -> None:
    before = [run["run"] for run in mended.get("/api/state")["runs"]]
    mended.send("POST", "/api/fit", {}, 202)
    mended.next(lambda m: m["type"] == "job" and m["job"]["stages"])
    mended.send("POST", "/api/cancel", {"kind": "fit"}, 202)
    ended = mended.next(lambda m: m["type"] == "job" and m["job"]["state"] not in ("running", "cancelling"), 20)
    assert ended["job"]["state"] == "cancelled" and ended["job"]["problem"] is None
    assert [run["run"] for run in mended.get("/api/state")["runs"]] == before
    assert not [pid for pid in descendants(mended.process.pid) if "fitting" in command(pid)]


def test_save_during_a_fit_ends_it(mended: Studio) -> None:
    mended.send("POST", "/api/fit", {}, 202)
    mended.next(lambda m: m["type"] == "job" and m["job"]["stages"])
    mended.save(PROCEDURE + "\n# another\n")
    mended.next(lambda m: m["type"] == "job" and m["job"]["state"] == "cancelled", 20)


def test_source_is_written_as_the_author_left_it(mended: Studio) -> None:
    before = mended.get("/api/source")
    assert before["path"] == "procedure.py" and before["text"] == (mended.folder / "procedure.py").read_text()
    answer = mended.send("PUT", "/api/source", {"text": PROCEDURE + "# é\n", "digest": before["digest"]})
    assert (mended.folder / "procedure.py").read_text() == PROCEDURE + "# é\n"
    conflict = mended.send("PUT", "/api/source", {"text": "x", "digest": before["digest"]}, 409)
    assert conflict["digest"] == answer["digest"] and conflict["text"].endswith("# é\n")
    mended.wait_for(lambda s: s["procedure"]["digest"] == answer["digest"] and s["procedure"]["state"] == "good")


def test_references_that_come_and_go(mended: Studio) -> None:
    path = mended.folder / "references" / "late.off"
    trimesh.creation.box().export(path)
    mended.wait_for(lambda s: any(t["slug"] == "late" and t["reference"] for t in s["collection"]["tiles"]))
    path.unlink()
    mended.wait_for(lambda s: not any(t["slug"] == "late" for t in s["collection"]["tiles"]))


def test_marks_are_kept_one_by_one(mended: Studio) -> None:
    pair = {"a": "ball", "b": "table-0", "same": False}
    mended.send("PATCH", "/api/marks", pair)
    assert mended.get("/api/state")["marking"]["marks"] == [pair]
    path = mended.folder / "marks.json"
    assert json.loads(path.read_text()) == [{"a": "ball", "b": "table 0", "same": False}]
    noted = {"a": "gone", "b": "gone", "same": True, "run": "000", "measures": {"distance": 0.1}}
    path.write_text(json.dumps([noted, {"a": "ball", "b": "table 0", "same": False, "why": "legs"}]))
    # Another page does not know of the marks of this one, nor of what the command line wrote.
    mark(mended, "ball", "ball", True)
    first, second, third = json.loads(path.read_text())
    assert first == noted and second["why"] == "legs" and third["same"]
    run = mended.get("/api/state")["collection"]["run"]
    if run:
        recorded = {e["name"]: e for e in mended.get_run(run)["references"]}
        assert third["run"] == run and third["measures"]["distance"] == recorded["ball"]["distance"]
    mark(mended, "table-0", "ball", True)
    assert [(e["a"], e["b"], e["same"]) for e in json.loads(path.read_text())][1:] == [
        ("ball", "ball", True), ("table 0", "ball", True),
    ]  # fmt: skip
    mark(mended, "ball", "table-0", None)
    mark(mended, "ball", "ball", None)
    assert json.loads(path.read_text()) == [noted]
    mark(mended, "ball", "nobody", True, 422)


def test_marks_of_many_pages_at_once_are_all_kept(mended: Studio) -> None:
    slugs = [tile["slug"] for tile in mended.get("/api/state")["collection"]["tiles"]]
    pairs = [(a, b) for a in slugs for b in slugs if a <= b]
    with ThreadPoolExecutor(8) as pages:
        list(pages.map(lambda pair: mark(mended, *pair, True), pairs))
    marks = mended.get("/api/state")["marking"]["marks"]
    assert {(one["a"], one["b"]) for one in marks} == set(pairs)
    for pair in pairs:
        mark(mended, *pair, None)


def test_settings_last_over_a_restart_and_the_command_line_goes_before_them(tmp_path: Path) -> None:
    project = make_project(tmp_path / "p")
    with studio(project, "--refine", "off") as first:
        first.send("PATCH", "/api/settings", {"epochs": 7, "samples": 90, "auto_fit": False, "replicated": 0.7})
        chosen = first.get("/api/state")["settings"]
    with studio(project, "--samples", "77") as second:
        assert second.get("/api/state")["settings"] == {**chosen, "samples": 77, "refine": Settings.refine}


def test_settings_out_of_range_are_refused(mended: Studio) -> None:
    for wrong in ({"samples": 3}, {"samples": "many"}, {"refine": "much"}, {"colour": 1}, {"auto_fit": 1}):
        assert "error" in mended.send("PATCH", "/api/settings", wrong, 422)
    assert mended.send("PATCH", "/api/settings", {"threshold": 0.2})["threshold"] == 0.2
    mended.send("PATCH", "/api/settings", {"threshold": 0.18})


def test_export(fitted: Studio) -> None:
    what = {"what": ["replicas", "samples", "report", "parameters"], "format": "obj", "count": 3}
    fitted.send("POST", "/api/export", what, 202)
    job = fitted.next(lambda m: m["type"] == "job" and m["job"]["state"] in ("done", "failed"))["job"]
    assert job["state"] == "done", job
    status, body, headers = fitted.request("GET", job["result"]["url"])
    assert status == 200 and "attachment" in headers["content-disposition"] and len(body) == job["result"]["bytes"]
    names = zipfile.ZipFile(io.BytesIO(body)).namelist()
    assert {"report.html", "parameters.csv", "replicas/table-0.obj", "samples/manifest.csv"} <= set(names)
    assert sum(name.startswith("samples/table-") for name in names) == 3


def test_pictures_for_browsers_without_webgl(fitted: Studio) -> None:
    pictures = [
        fitted.request("GET", f"/api/references/table-0/render?shape={shape}&azimuth={azimuth}&size=128")[1]
        for shape, azimuth in (("reference", 0), ("reference", 80), ("replica", 0))
    ]
    assert all(picture.startswith(b"\x89PNG") for picture in pictures) and pictures[0] != pictures[1]
    assert fitted.request("GET", "/api/references/table-0/render?size=100000")[0] == 422


def test_a_run_is_explained(fitted: Studio) -> None:
    assert fitted.request("GET", "/api/explanation")[0] == 404
    fitted.send("POST", "/api/explain", {}, 202)
    job = fitted.next(lambda m: m["type"] == "job" and m["job"]["state"] in ("done", "failed"), 200)["job"]
    assert job["kind"] == "explain" and job["state"] == "done", job
    assert len(job["stages"]) > 1 and job["result"] == {"run": fitted.get("/api/state")["collection"]["run"]}
    assert fitted.next(lambda m: m["type"] == "explanation")["explanation"]
    found = fitted.get("/api/explanation")
    assert set(found["references"]) == {"ball", *(f"table-{i}" for i in range(4))}
    assert found["references"]["ball"]["regions"] and "suggestions" in found


def test_explanation_passes_through(fitted: Studio) -> None:
    run = fitted.folder / "runs" / fitted.get("/api/state")["collection"]["run"]
    (run / "pictures").mkdir(exist_ok=True)
    (run / "pictures" / "s.png").write_bytes(b"\x89PNG")
    cause = {"kind": "range", "text": "t", "evidence": 1}
    told = {
        "references": {"table 0": {"causes": [cause], "regions": []}, "gone": {}},
        "suggestions": [
            {"kind": "range", "title": "Widen", "source": PROCEDURE + "# wide\n", "picture": "pictures/s.png",
             "references": ["table 0"], "more": 1}
        ],
    }  # fmt: skip
    (run / "explanation.json").write_text(json.dumps(told))
    found = fitted.get("/api/explanation")
    assert list(found["references"]) == ["table-0"] and found["suggestions"][0]["more"] == 1
    assert fitted.request("GET", found["suggestions"][0]["picture"])[1] == b"\x89PNG"
    assert fitted.get("/api/references/table-0")["explanation"]["causes"][0]["kind"] == "range"
    evidence = {"turned": 180, "on_its_head": False, "mirrored": False, "words": "faces the other way"}
    told["references"]["ball"] = {
        "causes": [{"kind": "another pose", "text": "t", "evidence": evidence}],
        "regions": [],
    }
    (run / "explanation.json").write_text(json.dumps(told))
    with studio(fitted.folder, *FIT, "--no-auto-fit") as opened:
        shown = opened.wait_for(lambda s: s["collection"]["run"] == run.name)["collection"]
        poses = {tile["slug"]: tile["pose"] for tile in shown["tiles"]}
    pose = {"turned": 180, "on_its_head": False, "mirrored": False, "text": "faces the other way"}
    assert poses == {slug: pose if slug == "ball" else None for slug in poses}
    copied = fitted.send("POST", "/api/suggestions/0/apply", {"to": "copy"})
    assert (
        copied["path"] == "procedure-1.py" and (fitted.folder / "procedure-1.py").read_text() == PROCEDURE + "# wide\n"
    )
    fitted.send("POST", "/api/suggestions/7/apply", {"to": "copy"}, 404)


def test_a_suggestion_joins_what_was_written_since(fitted: Studio) -> None:
    run = fitted.folder / "runs" / fitted.get("/api/state")["collection"]["run"]
    parameter = next(p for p in fitted.get("/api/state")["procedure"]["parameters"] if p["kind"] == "scalar")
    change = {
        "procedure": "table",
        "limits": [{"parameter": parameter["name"], "low": None, "high": "9", "steps": None}],
    }
    suggestion = {"kind": "range", "title": "Widen", "source": PROCEDURE, "references": [], "change": change}
    (run / "explanation.json").write_text(json.dumps({"references": {}, "suggestions": [suggestion]}))
    (fitted.folder / "procedure.py").write_text("# my own line\n" + PROCEDURE)
    written = fitted.send("POST", "/api/suggestions/0/apply", {"to": "procedure"})
    text = (fitted.folder / "procedure.py").read_text()
    assert text.startswith("# my own line") and f"{9}" in text
    (newest, *_) = fitted.get("/api/revisions")
    assert (newest["number"], newest["writer"], newest["of"]) == (written["revision"], "suggestion", "Widen")
    removed = [
        line["text"] for line in fitted.get(f"/api/revisions/{newest['number']}")["diff"] if line["kind"] == "removed"
    ]
    assert len(removed) == newest["removed"] == 1 and parameter["name"] in removed[0]
    refused = fitted.send("POST", "/api/suggestions/0/apply", {"to": "procedure"}, 409)
    assert "you have edited" in refused["error"] and (fitted.folder / "procedure.py").read_text() == text


def test_memory_beside_the_fit_and_nothing_heavy_in_the_server(running: Studio) -> None:
    """Server, bench and builder together, counted so that shared pages count once."""
    loaded = Path(f"/proc/{running.process.pid}/maps")
    if not loaded.exists():
        pytest.skip("needs /proc")
    assert "libtorch" not in loaded.read_text() and "llvmlite" not in loaded.read_text()
    running.wait_for(lambda s: s["jobs"]["fit"]["state"] != "running")
    total = sum(memory(pid) for pid in [running.process.pid, *descendants(running.process.pid)])
    assert total < 300 * 2**20, f"{total / 2**20:.0f} MB"


def test_nothing_is_left_when_the_studio_is_killed(tmp_path: Path) -> None:
    with studio(make_project(tmp_path / "p"), *FIT) as started:
        started.wait_for(ready)
        started.send("POST", "/api/fit", {}, 202)
        started.wait_for(lambda s: s["jobs"]["fit"]["stages"])
        others = descendants(started.process.pid)
        assert len(others) >= 3
        started.process.kill()
        end = time.monotonic() + 20
        while (left := [pid for pid in others if "shapewright" in command(pid)]) and time.monotonic() < end:
            time.sleep(0.1)
        assert not left, [command(pid) for pid in left]


def descendants(pid: int) -> list[int]:
    table = subprocess.run(["ps", "-eo", "pid=,ppid="], capture_output=True, text=True, check=True).stdout
    parents = {int(child): int(parent) for child, parent in (line.split() for line in table.splitlines())}
    found, added = {pid}, True
    while added:
        added = {child for child, parent in parents.items() if parent in found} - found
        found |= added or set()
    return sorted(found - {pid})


def command(pid: int) -> str:
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode()
    except (FileNotFoundError, ProcessLookupError):
        return ""


def memory(pid: int) -> int:
    """Proportional set size in bytes."""
    try:
        lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    except (FileNotFoundError, ProcessLookupError):
        return 0
    return sum(int(line.split()[1]) * 1024 for line in lines if line.startswith("Pss:"))
