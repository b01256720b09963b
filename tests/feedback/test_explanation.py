"""Explaining an iteration of a small procedure, of which the references need more than it can make."""

import json
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.feedback.case import Case
from shapewright.feedback.causes.better_replicas import measured, with_choices_kept
from shapewright.feedback.explanation import explain
from shapewright.feedback.record import record_of
from shapewright.feedback.suggestions import Suggestion
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.feedback.trials.tried import Tried
from shapewright.judging.judge import Judge
from shapewright.judging.target import Measures
from shapewright.modelling.solids import box
from shapewright.runs.result import Result
from shapewright.shapes import concatenate

SOURCE = """
from typing import Annotated, Literal
from shapewright import Range, procedure
from shapewright.modelling.solids import box, cylinder

@procedure
def table(
    height: Annotated[float, Range(0.4, 0.8)] = 0.6,
    breadth: Annotated[float, Range(0.3, 1.0)] = 0.6,
    legs: Literal["four", "post"] = "four",
):
    top = box((1, 0.06, breadth), at=(0, height - 0.03, 0)).label("top")
    if legs == "post":
        return top | cylinder((0.12, height, 0.12), at=(0, height / 2, 0)).label("post")
    leg = box((0.06, height, 0.06), at=(0.47, height / 2, breadth / 2 - 0.03)).label("legs")
    return top | leg.mirror("x", keep=True).mirror("z", keep=True)
"""


@pytest.fixture(scope="module", autouse=True)
def _brief_searches():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("shapewright.feedback.causes.better_replicas.EVALUATIONS", 1500)
        yield


@pytest.fixture(scope="module")
def procedure(tmp_path_factory):
    path = tmp_path_factory.mktemp("procedure") / "table.py"
    path.write_text(SOURCE)
    return sw.load_procedure(path)


def iteration_of(procedure, references, vectors, settings):
    """As if these vectors had been found."""
    judge = Judge.of(references, settings)
    with Workers(procedure, 1) as crew:
        found = measured([(row, vectors[name]) for row, name in enumerate(references.names)], crew, judge)
    results = tuple(
        Result(
            name=reference.name,
            path=None,
            parameters=best.parameters,
            active=procedure.space.active(best.parameters),
            at_limit=procedure.space.at_limit(best.parameters),
            replica=best.mesh,
            measured=Measures(best.distance, 0.5, 0.1),
            grade="replicated" if best.distance <= settings.threshold else "different",
            compatible=best.distance <= settings.threshold,
            group=None,
            reference=reference.shape,
        )
        for reference, best in zip(references, found, strict=True)
    )
    return sw.Iteration(results, judge.metric, (), settings, {}, {}, procedure.source, {}, {}, {}, "")


@pytest.fixture(scope="module")
def fitted(procedure):
    four, post = {"height": 0.6, "breadth": 0.6, "legs": "four"}, {"height": 0.6, "breadth": 0.6, "legs": "post"}
    shelf = box((0.94, 0.05, 0.54), at=(0, 0.2, 0)).mesh()
    whole = procedure(**four)
    shapes = {
        "fine": whole,
        "misjudged": procedure(**post),
        "badly": procedure(height=0.75, breadth=0.35, legs="four"),
        "tall": procedure(height=1.15, breadth=0.6, legs="post"),
        "shelved": concatenate([whole, shelf]),
        "lame": (
            box((1, 0.06, 0.6), at=(0, 0.57, 0)) | box((0.06, 0.6, 0.06), at=(0.47, 0.3, 0.27)).mirror("z", keep=True)
        ).mesh(),
    }
    legs = box((0.06, 0.6, 0.06), at=(0.47, 0.3, 0.27)).mirror("x", keep=True).mirror("z", keep=True)
    shapes["leaning"] = (box((1, 0.06, 0.6), at=(0, 0.57, 0)) | legs.taper(0.2, "-y")).mesh()
    found = {
        "leaning": four,
        "fine": four,
        "misjudged": four,
        "badly": {**four, "height": 0.45, "breadth": 0.95},
        "tall": {**post, "height": 0.8},
        "shelved": four,
        "lame": four,
    }
    references = sw.Collection.of(shapes)
    settings = sw.Settings(workers=1, threshold=0.12, judge="paper")
    return iteration_of(procedure, references, found, settings), references


@pytest.fixture(scope="module")
def explanation(procedure, fitted):
    iteration, references = fitted
    return explain(iteration, procedure, references, suggest=False)


def chief(explanation, name):
    return explanation.references[name].causes[0]


def test_a_replicated_reference_has_no_causes(explanation):
    fine = explanation.references["fine"]
    assert fine.replicated and fine.causes == () and fine.residuals.regions == ()


def test_another_choice(explanation):
    cause = chief(explanation, "misjudged")
    assert cause.kind == "wrong choice" and "legs is post, not four" in cause.text
    assert cause.evidence["changed"] == [{"parameter": "legs", "was": "four", "is": "post"}]
    assert explanation.references["misjudged"].nearest.distance <= 0.12 < cause.evidence["before"]


def test_other_scalars(explanation):
    cause = chief(explanation, "badly")
    assert cause.kind == "badly predicted" and cause.evidence["changed"] == []
    assert cause.evidence["parameters"]["breadth"] < 0.6


def test_a_range_that_ends_too_soon(explanation):
    cause = chief(explanation, "tall")
    assert cause.kind == "out of range"
    (wish,) = cause.evidence["wishes"]
    assert wish["parameter"] == "height" and wish["side"] == "high" and wish["end"] == 0.8
    assert wish["value"] > 0.95 and cause.evidence["enough"]
    shared = next(entry for entry in explanation.summary if entry.kind == "out of range")
    assert shared.text.startswith("height: 1 reference wants up to ") and shared.references == ("tall",)
    assert "Range ends at 0.8" in shared.text


def test_a_missing_part_and_a_surplus_one(explanation):
    missing, surplus = chief(explanation, "shelved"), chief(explanation, "lame")
    assert missing.kind == "missing part" and missing.evidence["unexplained"] > 0.2
    assert surplus.kind == "surplus part" and surplus.evidence["label"] == "legs"


def test_legs_that_lean_are_another_form_of_them(explanation):
    cause = chief(explanation, "leaning")
    assert cause.kind == "wrong form" and cause.evidence["label"] == "legs"
    assert "leaning inwards, 0.2" in cause.text and "times as far apart at the floor" in cause.text
    assert 0.1 < cause.evidence["factor"] < 0.3 and 0.1 < cause.evidence["deeper"] < 0.3
    assert cause.evidence["apart"] < 0.7 * cause.evidence["before"]
    assert not any(other.kind == "missing part" for other in explanation.references["leaning"].causes)


def test_the_record_is_plain_and_whole(explanation):
    record = json.loads(json.dumps(record_of(explanation), allow_nan=False))
    assert set(record["references"]) == set(explanation.references)
    shelved = record["references"]["shelved"]
    assert {"kind", "text", "evidence"} <= set(shelved["causes"][0])
    region = shelved["regions"][0]
    assert set(region) == {"side", "centre", "size", "axes", "share", "distance", "label", "rule"}
    assert region["side"] == "unexplained" and len(region["axes"]) == 3
    assert record["suggestions"] == [] and shelved["placement"]["scale"] > 0


def test_only_what_no_parameters_solve_is_asked_suggestions_for(procedure, monkeypatch):
    references = sw.Collection.of({"tall": procedure(1.15, 0.6, "post"), "post": procedure(0.6, 0.6, "post")})
    vectors = {name: {"height": 0.6, "breadth": 0.6, "legs": "four"} for name in references.names}
    settings = sw.Settings(workers=1, threshold=0.12, judge="paper")
    asked = []

    def suggestions(procedure, cases, crew, judge, stages, rules):
        asked.extend(case.name for case in cases)
        return (Suggestion("range", "longer", "", "", "", b"", ("tall",)),), (Tried("longer", "range", 1, 0.9, 1.0),)

    monkeypatch.setattr("shapewright.feedback.explanation.suggestions", suggestions)
    found = explain(iteration_of(procedure, references, vectors, settings), procedure, references)
    assert asked == ["tall"] and found.suggestions[0].title == found.tried[0].title == "longer"


def test_what_a_person_calls_different_is_told_by_its_fidelity(procedure):
    references = sw.Collection.of({"misjudged": procedure(height=0.6, breadth=0.6, legs="post")})
    found = {"misjudged": {"height": 0.6, "breadth": 0.6, "legs": "four"}}
    settings = sw.Settings(workers=1, threshold=10.0)
    iteration = iteration_of(procedure, references, found, settings)
    iteration = replace(iteration, results=tuple(replace(result, grade="different") for result in iteration))
    told = explain(iteration, procedure, references, suggest=False).references["misjudged"]
    assert told.replica.apart > 1.0 >= told.nearest.apart
    assert "legs is post, not four: the fidelity rises from 0." in told.causes[0].text


def test_choices_stay_where_other_numbers_do_as_well(procedure):
    """The post that was found alike does no better than legs of the right breadth."""
    references = sw.Collection.of({"four": procedure(0.6, 0.5, "four"), "post": procedure(0.6, 0.5, "post")})
    judge = Judge.of(references, sw.Settings(workers=1, threshold=0.05, judge="paper"))
    with Workers(procedure, 1) as crew:
        before = measured([(row, {"height": 0.6, "breadth": 0.9, "legs": "four"}) for row in (0, 1)], crew, judge)
        best = measured(
            [(row, {"height": 0.6, "breadth": 0.5, "legs": legs}) for row, legs in enumerate(("four", "post"))],
            crew,
            judge,
        )
        as_good = [replace(best[0], parameters={**best[0].parameters, "legs": "post"}), best[1]]
        cases = [
            Case.of(reference.name, reference.shape, False, old, residuals(reference.shape, old.mesh))
            for reference, old in zip(references, before, strict=True)
        ]
        cases = [replace(case, nearest=new) for case, new in zip(cases, as_good, strict=True)]
        found = with_choices_kept(cases, crew, judge)
    assert [each.parameters["legs"] for each in found] == ["four", "post"]
    assert all(each.distance <= 0.05 for each in found)


def test_a_collection_that_lacks_a_reference_is_refused(procedure):
    references = sw.Collection.of({"a": procedure(), "b": procedure(height=0.5)})
    vectors = dict.fromkeys("ab", procedure.space.defaults)
    iteration = iteration_of(procedure, references, vectors, sw.Settings(workers=1))
    with pytest.raises(KeyError, match="no reference 'b'"):
        explain(iteration, procedure, sw.Collection.of({"a": procedure()}))


def test_an_explanation_through_an_executor_is_that_of_this_machine(procedure, fitted, explanation):
    iteration, references = fitted
    with ThreadPoolExecutor(2) as pool:
        far = explain(iteration, procedure, references, suggest=False, executor=pool)
    assert said(far) == said(explanation)


def said(explanation):
    return {key: value for key, value in record_of(explanation).items() if key != "seconds"}
