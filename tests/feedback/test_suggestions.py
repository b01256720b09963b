"""What is suggested for small collections: a missing part, a Range that is too short, nothing."""

import base64
import json

import numpy as np
import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.feedback.case import Case, Replica
from shapewright.feedback.explanation import Explanation
from shapewright.feedback.record import record_of
from shapewright.feedback.suggestions import no_suggestions, suggestions
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.judging.judge import Judge
from shapewright.modelling.solids import box
from shapewright.shapes import concatenate

TABLE = """from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box


@procedure
def table(
    height: Annotated[float, Range(0.4, 0.8)] = 0.6,
    depth: Annotated[float, Range(0.4, 1.0)] = 0.7,
):
    top = box((1, 0.06, depth), at=(0, height - 0.03, 0)).label("top")
    leg = box((0.06, height, 0.06), at=(0.47, height / 2, depth / 2 - 0.03)).label("legs")
    return top | leg.mirror("x", keep=True).mirror("z", keep=True)
"""
SIZES = [(0.5, 0.6), (0.6, 0.9), (0.7, 0.5)]


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "table.py"
    path.write_text(TABLE)
    return sw.load_procedure(path)


def suggested(table, shapes, vectors, monkeypatch, judge="paper"):
    monkeypatch.setattr("shapewright.feedback.suggestions.EVALUATIONS", 900)
    references = sw.Collection.of(shapes)
    judge = Judge.of(references, sw.Settings(workers=1, judge=judge))
    with Workers(table, 1) as crew:
        builds = crew.build(vectors)
        standings = judge.standings(builds)
        cases = []
        for row, (reference, build, standing) in enumerate(zip(references, builds, standings, strict=True)):
            replica = Replica.of(row, build, standing)
            where = residuals(reference.shape, build.shape)
            cases.append(Case.of(reference.name, reference.shape, False, replica, where))
        return suggestions(table, cases, crew, judge, limit=3)[0], np.array(
            [standing.distance for standing in standings]
        )


def with_block(table, height, depth):
    return concatenate(
        [table(height=height, depth=depth), box((0.7, height * 0.8, depth), at=(0, height * 0.4, 0)).mesh()]
    )


def test_a_missing_part_is_suggested_tried_and_runs_when_pasted(table, tmp_path, monkeypatch):
    shapes = {f"desk{i}": with_block(table, *size) for i, size in enumerate(SIZES)}
    vectors = [{"height": height, "depth": depth} for height, depth in SIZES]
    made, distances = suggested(table, shapes, vectors, monkeypatch)
    assert (distances > 0.18).all()
    best = made[0]
    assert best.gain == 3 and best.references == ("desk0", "desk1", "desk2")
    assert best.kind in ("new part", "part replaced") and "3 of 3" in best.text
    for number, source in enumerate((best.source, TABLE + "\n\n" + best.snippet)):
        path = tmp_path / f"changed{number}.py"
        path.write_text(source)
        changed = sw.load_procedure(path)
        for name, parameters in best.tried["parameters"].items():
            assert sw.light_field.distance(changed(**parameters), shapes[name]) <= 0.18
        assert len(changed().faces) == len(table().faces)
    (record, *_) = json.loads(json.dumps(record_of(Explanation({}, (), made))))["suggestions"]
    assert base64.b64decode(record["picture"]).startswith(b"\x89PNG") and record["gain"] == 3


def test_a_longer_range_is_suggested(table, tmp_path, monkeypatch):
    shapes = {f"bar{i}": table(height=height, depth=0.4) for i, height in enumerate((1.3, 1.5, 1.4))}
    made, distances = suggested(table, shapes, [{"height": 0.8, "depth": 0.4}] * 3, monkeypatch)
    assert (distances > 0.18).any()
    ranges = [each for each in made if each.kind == "range"]
    assert [each.title for each in ranges] == ["A wider Range of height"]  # and not of depth, which brings nothing
    assert ranges[0].gain == (distances > 0.18).sum()
    assert "height: Annotated[float, Range(0.4, 1." in ranges[0].snippet
    path = tmp_path / "changed.py"
    path.write_text(ranges[0].source)
    assert sw.load_procedure(path).space["height"].high > 1.2


def test_a_suggestion_makes_replicated_what_a_person_calls_different(table, tmp_path, monkeypatch):
    shapes = {f"bar{i}": table(height=height, depth=0.4) for i, height in enumerate((1.3, 1.5, 1.4))}
    made, _ = suggested(table, shapes, [{"height": 0.8, "depth": 0.4}] * 3, monkeypatch, judge="fidelity")
    best = made[0]
    assert best.gain > 0 and f"{best.gain} of 3 misfits would become replicated" in best.text
    path = tmp_path / "changed.py"
    path.write_text(best.source)
    changed = sw.load_procedure(path)
    for name in best.references:
        assert sw.fidelity(table(height=0.8, depth=0.4), shapes[name]).grade == "different"
        assert sw.fidelity(changed(**best.tried["parameters"][name]), shapes[name]).grade == "replicated"


def test_nothing_is_suggested_for_what_the_procedure_can_do(table, monkeypatch):
    shapes = {"plain": table(height=0.5, depth=0.6)}
    made, _ = suggested(table, shapes, [{"height": 0.5, "depth": 0.6}], monkeypatch)
    assert made == ()


def test_a_procedure_that_is_no_python_file_is_told_why_nothing_is_suggested(tmp_path):
    (tmp_path / "table.py").write_text(TABLE)
    table = sw.load_procedure(tmp_path / "table.py")
    assert no_suggestions(table) is None
    table.path = tmp_path / "table.scad"
    assert no_suggestions(table) == (
        "No changes are suggested, since they edit a function at the top level of a Python file, and table is none."
    )
    assert record_of(Explanation({}, (), unsuggested="No changes."))["unsuggested"] == "No changes."
