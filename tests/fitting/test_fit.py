import json
import math
from dataclasses import replace
from typing import Annotated, Literal

import numpy as np
import pytest

import shapewright as sw
from shapewright import Infeasible, Range
from shapewright.modelling.solids import box, cylinder
from shapewright.report import write_report
from shapewright.runs.folder import RunError
from shapewright.runs.result import MEASURES

SETTINGS = sw.Settings(seed=1, samples=500, epochs=16, image_size=32, workers=2)


@sw.procedure
def stool(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    seat: Literal["square", "round"] = "square",
):
    top = (cylinder if seat == "round" else box)((1, 0.1, 1), at=(0, height, 0))
    return top | box((0.15, height, 0.15), at=(0, height / 2, 0))


def references():
    bench = box((3, 0.1, 0.4)) | box((0.1, 1, 0.4), at=(1.3, -0.5, 0)) | box((0.1, 1, 0.4), at=(-1.3, -0.5, 0))
    stools = {f"stool {i}": stool(height=h, seat=s) for i, (h, s) in enumerate([(0.4, "square"), (0.9, "round")])}
    benches = {"bench a": bench, "bench/b": bench.scale(2.0), 'bench "c"': bench.scale((1, 1, 1.1))}
    return sw.Collection.of({**stools, **benches, "ball": box((1, 1, 1))})


@pytest.fixture(scope="module")
def iteration():
    told = []
    it = sw.fit(stool, references(), SETTINGS, progress=told.append)
    stages = list(dict.fromkeys(event.stage for event in told))
    assert stages == ["sample", "render", "train", "describe", "predict", "replicate", "refine", "compare", "picture"]
    assert all(set(event.answer) == set(it.names) for event in told if event.answer)
    assert list(it.seconds) == stages and all(event.done <= event.total for event in told)
    return it


def test_an_iteration_tells_the_replicated_from_the_misfits(iteration):
    assert set(iteration.replicated) == set(iteration.compatible) == {"stool 0", "stool 1"}
    for name in iteration.replicated:
        result = iteration[name]
        assert result.grade == "replicated" and result.fidelity >= SETTINGS.replicated
        assert result.distance <= 0.18 and result.iou > 0.85 and result.chamfer < 0.05
        assert result.group is None and result.error is None
        assert result.parameters["seat"] == ("square" if name == "stool 0" else "round")
        assert result.parameters["height"] == pytest.approx(0.4 if name == "stool 0" else 0.9, abs=0.1)
        assert np.array_equal(result.replica.vertices, stool(**result.parameters).vertices)


def test_every_reference_has_one_grade_and_the_same_measures(iteration):
    grades = {name: iteration[name].grade for name in iteration.names}
    by_grade = (iteration.replicated, iteration.close, iteration.different)
    assert sorted(name for names in by_grade for name in names) == sorted(grades)
    assert iteration.misfits == tuple(name for name, grade in grades.items() if grade != "replicated")
    assert set(iteration.means) == set(iteration["ball"].measures) == set(MEASURES)
    assert iteration.means["iou"] == pytest.approx(np.mean([result.iou for result in iteration]))


def test_the_papers_judge_goes_by_the_distance():
    settings = replace(SETTINGS, samples=100, epochs=1, refine="off", judge="paper", threshold=0.3)
    it = sw.fit(stool, references(), settings)
    assert it.replicated == it.compatible and it.close == () and it.record["judge"] == "paper"
    assert not math.isnan(it["ball"].fidelity)


def test_misfits_that_look_alike_are_one_group(iteration):
    largest = iteration.groups[0]
    assert set(largest.members) == {"bench a", "bench/b", 'bench "c"'}
    assert largest.representative in largest.members
    for i, group in enumerate(iteration.groups):
        assert all(iteration[name].group == i and iteration[name].grade != "replicated" for name in group.members)
    assert sorted(n for g in iteration.groups for n in g.members) == sorted(iteration.misfits)


def test_the_same_seed_gives_the_same_iteration(iteration):
    again = sw.fit(stool, references(), SETTINGS)
    assert [(r.parameters, r.distance, r.iou, r.chamfer, r.group) for r in again] == [
        (r.parameters, r.distance, r.iou, r.chamfer, r.group) for r in iteration
    ]


def test_a_saved_run_reads_back_the_same(iteration, tmp_path):
    folder = iteration.save(tmp_path / "runs" / "001")
    loaded = sw.Iteration.load(folder)
    assert loaded.record == {**iteration.record, "references": loaded.record["references"]}
    assert loaded.replicated == iteration.replicated and loaded.means == iteration.means
    for mine, theirs in zip(loaded, iteration, strict=True):
        assert (mine.name, mine.parameters, mine.distance, mine.group) == (
            theirs.name,
            theirs.parameters,
            theirs.distance,
            theirs.group,
        )
        assert mine.replica.vertices == pytest.approx(theirs.replica.vertices, abs=1e-6)
        assert np.array_equal(mine.replica.faces, theirs.replica.faces)
        assert mine.replica.labels == theirs.replica.labels
    assert loaded.pictures == iteration.pictures
    assert (
        loaded.save(tmp_path / "copy").joinpath("parameters.csv").read_text() == (folder / "parameters.csv").read_text()
    )


def test_a_run_holds_everything(iteration, tmp_path):
    folder = iteration.save(tmp_path / "001", write_report)
    assert not list(tmp_path.glob(".*"))
    names = {path.name for path in folder.iterdir()}
    assert names == {
        "iteration.json",
        "parameters.csv",
        "parameters.json",
        "predictor.pt",
        "procedure.py",
        "replicas",
        "thumbnails",
        "report.html",
    }
    assert len(list((folder / "replicas").glob("*.glb"))) == 6
    assert len(list((folder / "thumbnails").glob("*.png"))) == 12
    rows = (folder / "parameters.csv").read_text().splitlines()
    assert rows[0] == f"reference,grade,compatible,{','.join(MEASURES)},group,height,seat" and len(rows) == 7
    record = json.loads((folder / "iteration.json").read_text())
    assert record["seed"] == 1 and record["settings"]["samples"] == 500 and "torch" in record["versions"]
    assert "def stool" in (folder / "procedure.py").read_text()
    assert "001" in (folder / "report.html").read_text()


def test_runs_are_reported_compared_and_explained_from_python(iteration, tmp_path):
    earlier, later = iteration.save(tmp_path / "001"), iteration.save(tmp_path / "002")
    page = sw.write_report(later, str(earlier))
    assert page == later / "report.html" and "since run 001" in page.read_text()
    same = sw.compare(iteration, str(later))
    assert same == sw.compare(earlier, later) and not (same.gained or same.lost or same.closer or same.further)
    with pytest.raises(RunError, match=r"made in memory; give them to shapewright.explain\(iteration, procedure, refe"):
        sw.explain(iteration, stool)
    with pytest.raises(KeyError, match="bench"):
        sw.explain(iteration, stool, sw.Collection.of({"ball": box((1, 1, 1))}))


@sw.procedure
def stool_with_foot(
    height: Annotated[float, Range(0.3, 1.2)] = 0.6,
    seat: Literal["square", "round", "none"] = "square",
    foot: bool = False,
):
    shape = stool.function(height, "square" if seat == "none" else seat)
    return shape | box((0.6, 0.06, 0.6)) if foot else shape


def test_an_iteration_goes_on_from_the_previous_one(iteration, tmp_path):
    answers = []

    def listen(event):
        if event.answer:
            answers.append((event.remark, event.answer))

    previous = sw.Iteration.load(iteration.save(tmp_path / "001"))
    warm = sw.fit(stool_with_foot, references(), replace(SETTINGS, warm_epochs=3), listen, previous=previous)
    assert len(warm.metrics["curve"]) == 3
    assert [remark for remark, _ in answers][:1] == ["carried over"]
    carried = answers[0][1]["stool 1"]
    assert carried == {**iteration["stool 1"].parameters, "foot": False}
    for name in iteration.compatible:
        assert warm[name].fidelity >= iteration[name].fidelity
    again = sw.fit(stool_with_foot, references(), replace(SETTINGS, warm_epochs=3), previous=previous)
    assert [(r.parameters, r.distance) for r in again] == [(r.parameters, r.distance) for r in warm]


def test_a_first_answer_comes_before_training(iteration):
    events = []
    settings = replace(SETTINGS, epochs=1, refine="off")
    it = sw.fit(stool, references(), settings, lambda event: events.append((event.stage, event.answer)))
    first = next(i for i, (_, answer) in enumerate(events) if answer)
    assert first < [stage for stage, _ in events].index("train")
    assert events[first][1]["stool 1"]["seat"] == "round"
    assert 0.0 < it.metrics["first_answer"] < sum(it.seconds.values())


def test_adaptive_rounds_never_lose_what_was_found(iteration):
    settings = replace(SETTINGS, rounds=1, round_samples=100, warm_epochs=2)
    adaptive = sw.fit(stool, references(), settings)
    assert adaptive.metrics["samples"] > iteration.metrics["samples"]
    for mine, theirs in zip(adaptive, iteration, strict=True):
        assert mine.fidelity >= theirs.fidelity - 1e-12


@sw.procedure
def moody(height: Annotated[float, Range(0.3, 1.0)] = 0.6, kind: Literal["good", "thin"] = "good"):
    if height > 0.9:
        raise Infeasible("too tall")
    if kind == "thin":
        return np.array([[0.0, 0, 0], [1e-9, height, 0], [0, 1, 0]]), [[0, 1, 2]]
    return box((1, height, 1))


def test_replicas_that_fail_or_cannot_be_seen_are_results_too():
    sheet = sw.Mesh(np.array([[0.0, 0, 0], [0.004, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]]))
    shapes = {"tall": box((1, 0.99, 1)), "sheet": sheet, "cube": box((1, 0.6, 1))}
    it = sw.fit(moody, sw.Collection.of(shapes), SETTINGS)
    assert len(it) == 3 and it.metrics["failed"] > 0 and "infeasible: too tall" in it.metrics["failures"]
    assert "no view shows it" in it["sheet"].error
    for result in it:
        assert bool(result.error) == math.isnan(result.distance)
        assert math.isnan(result.fidelity) == bool(result.error)
        assert not (result.error and (result.compatible or result.grade != "different"))
    assert "cube" in it.replicated


def test_settings_are_checked_and_recorded():
    assert sw.Settings.from_record({**SETTINGS.record(), "unknown": 1}) == SETTINGS
    for wrong in ({"samples": 3}, {"epochs": 0}, {"image_size": 50}, {"cut": 2.0}, {"threshold": -1.0}):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            sw.Settings(**wrong)


def test_a_copy_follows_the_first_and_has_its_results(iteration):
    first, copy = iteration["bench a"], iteration["bench/b"]
    assert copy.follows == "bench a" and first.follows is None
    assert (copy.parameters, copy.grade, copy.group) == (first.parameters, first.grade, first.group)
    assert copy.replica is first.replica and copy.measured == first.measured
    assert "bench/b" in iteration.groups[copy.group].members
    assert "bench/b: follows bench a, which it is like" in iteration.remarks
    assert "bench/b" not in iteration.fitted.names and len(iteration.fitted) == len(iteration) - 1


def test_a_run_on_disk_knows_who_follows_whom(iteration, tmp_path):
    loaded = sw.Iteration.load(iteration.save(tmp_path / "run"))
    assert {result.name: result.follows for result in loaded} == {r.name: r.follows for r in iteration}
    assert loaded.remarks == iteration.remarks
    page = write_report(tmp_path / "run").read_text()
    assert "the same as bench a, and fitted with it" in page
