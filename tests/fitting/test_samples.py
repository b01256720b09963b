"""Folders of samples: what is in them, and that they can be stopped and gone on with at any moment."""

import csv
import json
from dataclasses import replace

import pytest
import trimesh

import shapewright as sw
from shapewright import load_procedure
from shapewright.fitting.samples import Samples, write_samples
from shapewright.fitting.sampling import making, packing
from shapewright.runs.folder import RunError

SOURCE = """
from typing import Annotated
from shapewright import Infeasible, Range, procedure
from shapewright.modelling.solids import box

@procedure
def stool(height: Annotated[float, Range(0.3, 0.8)] = 0.5, legs: Annotated[int, Range(1, 4)] = 4):
    if legs == 2:
        raise Infeasible("it falls over")
    seat = box((0.5, 0.1, 0.5), at=(0, height, 0)).label("seat")
    leg = box((0.1, height, 0.1), at=(-0.1, height / 2, 0)).label("legs")
    if legs == 3:
        return [seat, leg]
    return seat | leg.array(legs, (0.05, 0, 0))
"""


@pytest.fixture
def stool(tmp_path):
    (tmp_path / "stool.py").write_text(SOURCE)
    return load_procedure(tmp_path / "stool.py")


def manifest(folder):
    with (folder / "manifest.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_samples_in_memory_are_shapes_with_their_parameters(stool):
    told = []
    builds = sw.sample(stool, 12, workers=1, progress=told.append)
    assert [build.parameters for build in builds] == stool.space.sample(12, seed=0)
    for build in builds:
        assert (build.shape is None) == (build.parameters["legs"] == 2) == bool(build.failure)
    made = [build for build in builds if build.parameters["legs"] == 4]
    assert made and all((build.shape.vertices == stool(**build.parameters).vertices).all() for build in made)
    assert (told[-1].stage, told[-1].done, told[-1].total) == ("sample", 12, 12)
    assert [build.parameters for build in sw.sample(stool, 3, seed=1, workers=1)] == stool.space.sample(3, seed=1)


def test_the_manifest_says_what_each_file_is(stool, tmp_path):
    samples = write_samples(stool, 12, tmp_path / "out", workers=1)
    rows = manifest(tmp_path / "out")
    vectors = stool.space.sample(12, seed=0)
    assert [(float(row["height"]), int(row["legs"])) for row in rows] == [(v["height"], v["legs"]) for v in vectors]
    for row in rows:
        assert bool(row["path"]) == (row["legs"] != "2") and bool(row["failure"]) == (row["legs"] == "2")
        assert row["sound"] == {"1": "True", "2": "", "3": "False", "4": "True"}[row["legs"]]
    assert {row["failure"] for row in rows} == {"", "infeasible: it falls over"}
    overlapping = next(row for row in rows if row["legs"] == "3")
    assert int(overlapping["self_intersections"]) > 0 and overlapping["components"] == "2"
    made = [row for row in rows if row["path"]]
    unsound = sum(row["sound"] == "False" for row in made)
    assert samples == Samples(len(made), unsound, 12 - len(made), samples.failures)
    assert "it falls over" in samples.failures
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "manifest.csv", "manifest.samples.json", *(row["path"] for row in made)
    }  # fmt: skip
    scene = trimesh.load(tmp_path / "out" / made[0]["path"])
    assert set(scene.geometry) == {"seat", "legs"} and scene.metadata["seed"] == 0
    assert scene.metadata["parameters"]["height"] == float(made[0]["height"])
    assert sum(len(part.faces) for part in scene.geometry.values()) == int(made[0]["triangles"])


def test_a_folder_begun_by_an_earlier_version_is_still_known(stool, tmp_path):
    write_samples(stool, 1, tmp_path / "out", workers=1)
    assert json.loads((tmp_path / "out" / "manifest.samples.json").read_text())["source"] == "8ccf404ea0f3195f"


def test_the_files_do_not_depend_on_the_number_of_workers(stool, tmp_path):
    for workers in (1, 2):
        write_samples(stool, 10, tmp_path / str(workers), "ply", workers=workers)
    assert contents(tmp_path / "1") == contents(tmp_path / "2")


def test_a_stopped_run_is_gone_on_with(stool, tmp_path, monkeypatch):
    monkeypatch.setattr(packing, "FILES", replace(packing.FILES, size=4))
    whole, stopped = tmp_path / "whole", tmp_path / "stopped"
    write_samples(stool, 12, whole, workers=1)

    def stop(done, total):
        if done > 8:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_samples(stool, 12, stopped, workers=1, progress=stop)
    assert len(manifest(stopped)) == 8
    (stopped / ".stool-00009.glb.partial").write_text("half")  # as a kill leaves it
    before = {row["path"]: (stopped / row["path"]).stat().st_mtime_ns for row in manifest(stopped) if row["path"]}
    told = []
    again = write_samples(stool, 12, stopped, workers=1, progress=lambda done, total: told.append((done, total)))
    assert told[0][0] >= 8 and told[-1] == (12, 12)
    assert contents(stopped) == contents(whole)
    assert before == {path: (stopped / path).stat().st_mtime_ns for path in before}
    assert again.shapes == sum(bool(row["path"]) for row in manifest(whole))


def test_more_of_the_same_may_be_asked_for(stool, tmp_path):
    write_samples(stool, 4, tmp_path / "out", workers=1)
    write_samples(stool, 8, tmp_path / "out", workers=1)
    write_samples(stool, 8, tmp_path / "all", workers=1)
    assert contents(tmp_path / "out") == contents(tmp_path / "all")


def test_other_samples_are_never_mixed_in(stool, tmp_path):
    write_samples(stool, 3, tmp_path / "out", workers=1)
    before = contents(tmp_path / "out")
    for change in ({"seed": 1}, {"format": "ply"}):
        with pytest.raises(RunError, match=r"samples of another kind here .other (seed|files).; name another folder"):
            write_samples(stool, 3, tmp_path / "out", workers=1, **change)
    (tmp_path / "stool.py").write_text(SOURCE.replace("0.1", "0.2"))
    with pytest.raises(RunError, match="other source"):
        write_samples(load_procedure(tmp_path / "stool.py"), 3, tmp_path / "out", workers=1)
    assert contents(tmp_path / "out") == before


def test_a_folder_of_other_things_is_left_alone(stool, tmp_path):
    with pytest.raises(RunError, match="there is something here already"):
        write_samples(stool, 3, tmp_path, workers=1)
    assert {path.name for path in tmp_path.iterdir()} == {"stool.py"}
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "manifest.samples.json").write_text("{")
    with pytest.raises(RunError, match=r"samples\.json: cannot be read"):
        write_samples(stool, 3, tmp_path / "out", workers=1)


def test_a_full_disk_leaves_what_is_listed_whole(stool, tmp_path, monkeypatch):
    monkeypatch.setattr(packing, "FILES", replace(packing.FILES, size=4))
    encode, count = making.encode, []

    def full(*arguments):
        count.append(1)
        if len(count) > 6:
            raise OSError(28, "No space left on device")
        return encode(*arguments)

    monkeypatch.setattr(making, "encode", full)
    with pytest.raises(RunError, match=r"No space left on device; .*repeat the command to go on"):
        write_samples(stool, 12, tmp_path / "out", workers=1)
    monkeypatch.undo()
    listed = [row["path"] for row in manifest(tmp_path / "out") if row["path"]]
    assert listed and all((tmp_path / "out" / path).stat().st_size > 500 for path in listed)
    write_samples(stool, 12, tmp_path / "out", workers=1)
    write_samples(stool, 12, tmp_path / "all", workers=1)
    assert contents(tmp_path / "out") == contents(tmp_path / "all")


def test_drawings_have_no_soundness(tmp_path):
    (tmp_path / "disc.py").write_text(
        "from typing import Annotated\nimport shapely\nfrom shapewright import Range, procedure\n"
        "@procedure\ndef disc(r: Annotated[float, Range(1, 2)]):\n    return shapely.Point(0, 0).buffer(r)\n"
    )
    samples = write_samples(load_procedure(tmp_path / "disc.py"), 2, tmp_path / "out", workers=1)
    assert samples == Samples(2, 0, 0, "")
    assert [row["path"][-4:] + row["sound"] for row in manifest(tmp_path / "out")] == [".svg", ".svg"]
    assert json.loads((tmp_path / "out" / "manifest.samples.json").read_text())["procedure"] == "disc"
