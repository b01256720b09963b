import json

import numpy as np
import pytest
from typer.testing import CliRunner

import scenes
import shapewright as sw
from shapewright.cli.main import app


@pytest.fixture
def folder(tmp_path):
    scenes.write(tmp_path / "in" / "a.glb", {**scenes.chair(), "Plane": scenes.sheet(5, 5)})
    scenes.write(tmp_path / "in" / "b.ply", scenes.chair())
    large = scenes.chair()
    for part in large.values():
        part.apply_scale(1000)
    scenes.write(tmp_path / "in" / "c.ply", large)
    scenes.write(tmp_path / "in" / "d.ply", {"x": scenes.box((1, 1, 1))})
    (tmp_path / "in" / "e.stl").write_bytes(b"solid x")
    return tmp_path / "in"


def test_a_survey_says_what_was_read_and_what_is_odd(folder):
    survey = sw.check(folder)
    facts = {each.name: each for each in survey.facts}
    assert list(facts) == ["a", "b", "c", "d"] and [*survey.skipped] == [str(folder / "e.stl")]
    assert (facts["a"].format, facts["a"].count, facts["a"].pieces, facts["a"].closed) == ("GLB", 72, 6, True)
    assert facts["a"].notes == ("left out: a ground 'Plane'",) and set(facts["a"].names) == set(scenes.chair())
    assert facts["b"].odd == ("the same as a",)
    assert any("1e+03 times as large as most" in words for words in facts["c"].odd)
    assert np.allclose(facts["b"].size, (0.5, 1.0, 0.5), atol=0.02) and facts["b"].unit == "file's"


def test_what_stays_is_told_as_doubtful(folder):
    facts = {each.name: each for each in sw.check(folder, sw.Settings(drop="nothing")).facts}
    assert facts["a"].odd[0] == "perhaps a ground 'Plane'"


def test_axes_are_found_as_advice_where_the_author_does_not_tell_them(tmp_path):
    for number in range(3):
        chair = scenes.chair()
        for part in chair.values():
            part.apply_scale((1.0, 1.0 + 0.1 * number, 1.0))
            part.apply_transform(np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]]))
        scenes.write(tmp_path / "in" / f"{number}.ply", chair)
    survey = sw.check(tmp_path / "in")
    assert all(facts.seems.startswith("z up, ") and facts.up == "y" for facts in survey.facts)
    assert all(reference.orientation.up == "y" for reference in survey.references)
    assert not any(facts.seems for facts in sw.check(tmp_path / "in", up="z", front="-y").facts)
    result = CliRunner().invoke(app, ["check", str(tmp_path / "in"), "--out", str(tmp_path / "page")])
    assert "z up" in result.stdout and "--up auto turns" in result.stdout
    assert "seems to have z up" in (tmp_path / "page" / "check.html").read_text()


def test_points_and_drawings_have_facts_too():
    points = sw.Points(np.random.default_rng(0).random((100, 3)))
    (facts,) = sw.check(sw.Collection.of({"scan": points})).facts
    assert (facts.kind, facts.count, facts.pieces, facts.closed) == ("points", 100, None, None)


def test_the_command_writes_a_page_and_one_object(folder, tmp_path):
    result = CliRunner().invoke(app, ["check", str(folder), "--json", "--out", str(tmp_path / "page")])
    assert result.exit_code == 0, result.output
    record = json.loads(result.stdout.splitlines()[-1])
    assert [each["name"] for each in record["references"]] == ["a", "b", "c", "d"]
    assert {each["name"]: each["of"] for each in record["duplicates"]} == {"b": "a", "c": "a"}
    page = (tmp_path / "page" / "check.html").read_text()
    assert page.count("data:image/png;base64,") == 4 and "left out: a ground" in page and "e.stl" in page


def test_the_command_prints_a_table(folder, tmp_path):
    result = CliRunner().invoke(app, ["check", str(folder), "--out", str(tmp_path / "page"), "--leave-out", "d"])
    assert result.exit_code == 0 and "left out on request" in result.stdout and "1 could not be read" in result.stdout
