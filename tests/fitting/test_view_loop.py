"""The whole loop on pictures of objects."""

import json

import pytest

import shapewright as sw
from shapewright.fitting.pictures import suited_to
from shapewright.report import write_report
from shapewright.runs.folder import RunError
from stools import cut_out, encoded, photograph, stool, views

SETTINGS = sw.Settings(seed=1, samples=200, epochs=6, image_size=32, workers=1)
VALUES = {"low": (0.5, 0.3, 0.1, False), "high": (0.8, 0.7, 0.1, True)}


def meshes():
    return {name: stool(**dict(zip(stool.space.names, values, strict=True))) for name, values in VALUES.items()}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pictures")
    low, high = meshes().values()
    (folder / "low.png").write_bytes(encoded(cut_out(low)))
    (folder / "high.jpg").write_bytes(encoded(photograph(high)[0], "JPEG"))
    return folder


@pytest.fixture(scope="module")
def iteration(folder):
    return sw.fit(stool, sw.Collection.load(folder), SETTINGS)


def test_pictures_are_views_where_the_procedure_makes_meshes(iteration):
    for name, (_, back, _, plinth) in VALUES.items():
        result = iteration[name]
        assert result.parameters["plinth"] == plinth and isinstance(result.replica, sw.Mesh)
        assert result.parameters["back"] == pytest.approx(back, abs=0.15)
        assert result.iou > 0.9 and result.distance == pytest.approx(1.0 - result.iou)
        assert result.places[0][:2] == pytest.approx((35.0, 20.0), abs=8.0)
    assert iteration.collection["pictures"] == "views"


def test_a_run_of_pictures_is_kept_and_read_back(iteration, tmp_path):
    run = iteration.save(tmp_path / "001", write_report)
    loaded = sw.Iteration.load(run)
    assert loaded["low"].places[0] == pytest.approx(iteration["low"].places[0], abs=1e-3)
    assert loaded.pictures == iteration.pictures and loaded.metric == iteration.metric
    entry = json.loads((run / "iteration.json").read_text())["references"][0]
    assert len(entry["places"]) == 1 and entry["replica"].endswith(".glb")
    page = (run / "report.html").read_text()
    assert "seen in pictures" in page
    shown = [view for reference in meshes().values() for view in [views(reference)]]
    assert loaded.predictor.predict(shown) == iteration.predictor.predict(shown)
    with pytest.raises(ValueError, match="learned from pictures of objects"):
        loaded.predictor.predict(list(meshes().values()))


def test_the_loop_goes_on_from_a_run_of_pictures(iteration, folder):
    again = sw.fit(stool, sw.Collection.load(folder), SETTINGS, previous=iteration)
    for mine, theirs in zip(again, iteration, strict=True):
        assert mine.fidelity >= theirs.fidelity - 1e-9


def test_pictures_are_not_explained_yet(iteration):
    with pytest.raises(RunError, match="cannot be explained yet"):
        sw.explain(iteration, stool)


def test_meshes_stay_as_they_are():
    references = sw.Collection.of(meshes())
    assert suited_to(stool, references, SETTINGS) is references


def test_objects_in_several_views_are_fitted_beside_those_in_one():
    low, high = meshes().values()
    references = sw.Collection.of({"low": views(low, (35.0, 20.0, 0.4), (-50.0, 10.0, 0.3)), "high": views(high)})
    iteration = sw.fit(stool, references, SETTINGS)
    assert [len(result.places) for result in iteration] == [1, 2]
    assert iteration["low"].iou > 0.85
