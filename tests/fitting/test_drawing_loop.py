"""The whole loop on drawings."""

import json
from dataclasses import replace
from typing import Annotated

import pytest

import shapewright as sw
from shapewright import Range
from shapewright.fitting.evaluation import evaluate
from shapewright.fitting.pictures import suited_to
from shapewright.modelling.drawing import box, circle, polyline
from shapewright.modelling.solids import box as block
from shapewright.report import write_report

SETTINGS = sw.Settings(seed=1, samples=400, epochs=8, image_size=32, workers=1)


@sw.procedure
def table(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    leg: Annotated[float, Range(0.04, 0.2)] = 0.1,
    bar: bool = False,
):
    side = box((leg, height), at=((1 - leg) / 2, height / 2)).mirror("x", keep=True)
    shape = box((1, 0.1), at=(0, height - 0.05)) | side
    return shape | box((1, 0.05), at=(0, height / 3)) if bar else shape


VALUES = {"low": (0.4, 0.06, False), "high": (0.9, 0.15, True)}
ZIGZAG = [(0, 0), (0.3, 1), (0.6, 0), (0.9, 1)]


def references():
    tables = {name: table(**dict(zip(table.space.names, values, strict=True))) for name, values in VALUES.items()}
    zigzags = {f"zigzag {i}": polyline(ZIGZAG, 0.04 + 0.01 * i) for i in range(2)}
    return sw.Collection.of({**tables, **zigzags, "ring": circle(1, width=0.05)})


@pytest.fixture(scope="module")
def iteration():
    told = []
    it = sw.fit(table, references(), SETTINGS, progress=told.append)
    assert any(event.answer for event in told if event.stage == "sample")
    return it


def test_tables_are_replicated_and_others_grouped(iteration):
    assert set(iteration.replicated) == set(iteration.compatible) == {"low", "high"}
    assert {frozenset(group.members) for group in iteration.groups} == {
        frozenset({"zigzag 0", "zigzag 1"}),
        frozenset({"ring"}),
    }
    for name, (height, leg, bar) in VALUES.items():
        result = iteration[name]
        assert isinstance(result.replica, sw.Drawing) and result.chamfer < 0.02
        assert result.parameters["height"] == pytest.approx(height, abs=0.05)
        assert result.parameters["leg"] == pytest.approx(leg, abs=0.03) and result.parameters["bar"] == bar


def test_a_run_of_drawings_is_kept_and_read_back(iteration, tmp_path):
    folder = iteration.save(tmp_path / "001")
    assert sorted(path.name for path in (folder / "replicas").iterdir())[0] == "high.svg"
    record = json.loads((folder / "iteration.json").read_text())
    assert record["metric"]["name"] == "1 - VIF" and record["threshold"] == 0.95
    loaded = sw.Iteration.load(folder)
    assert loaded.metric == iteration.metric and loaded.pictures == iteration.pictures
    assert loaded["low"].replica.bounds == pytest.approx(iteration["low"].replica.bounds)
    assert loaded["low"].replica.geometry.area == pytest.approx(iteration["low"].replica.geometry.area)
    page = write_report(folder).read_text()
    assert "visual information fidelity at least 0.05" in page and "Open GLB" not in page
    assert loaded.predictor.predict([references()["low"].shape]) == iteration.predictor.predict(
        [references()["low"].shape]
    )


def test_the_loop_goes_on_from_a_run_and_samples_around_what_it_found(iteration):
    settings = replace(SETTINGS, rounds=1, round_samples=60, warm_epochs=1)
    again = sw.fit(table, references(), settings, previous=iteration)
    for mine, theirs in zip(again, iteration, strict=True):
        assert mine.fidelity >= theirs.fidelity - 1e-12


def test_learned_cameras_have_nothing_to_learn(iteration):
    trained = sw.train(table, replace(SETTINGS, cameras="learned", samples=60, epochs=1))
    assert trained.cameras == iteration.predictor.cameras and len(trained.cameras) == 1


def test_trials_on_held_out_drawings():
    (trial,) = evaluate(table, replace(SETTINGS, samples=100, epochs=2), seeds=[0])
    assert trial.refined["height"]["mae"] < trial.metrics["height"]["mae"]


def test_kinds_do_not_mix(iteration):
    solids = sw.Collection.of({"a": block(1)})
    with pytest.raises(sw.ProcedureError, match="it builds drawings, and these references need meshes"):
        sw.fit(table, solids, SETTINGS)
    with pytest.raises(ValueError, match="learned from drawings"):
        iteration.predictor.predict([solids["a"].shape])

    @sw.procedure
    def cube(size: Annotated[float, Range(0.5, 1.0)] = 0.7):
        return block((1, size, 1))

    assert suited_to(cube, references(), SETTINGS).in_views
    assert not suited_to(table, references(), SETTINGS).in_views
