"""What the report shows of an explanation."""

import base64
import json
import re

import numpy as np
import pytest
from test_page import EVIL, picture, record, reference, saved, typical

from shapewright.feedback.record import write
from shapewright.report import write_report
from shapewright.report.explained import outlines, quiet, read_explanation
from shapewright.runs.difference import changed as difference_of
from shapewright.runs.folder import RunError

BOX = {"centre": [0, 0, 0], "size": [0.2, 0.2, 0.2], "axes": np.eye(3).tolist(), "share": 0.2, "distance": 0.1}


def told(**others):
    region = {**BOX, "side": "unexplained", "label": "legs", "rule": None}
    cause = {"kind": "missing part", "text": f"a part is missing {EVIL}", "evidence": {}}
    return {
        "format": 1,
        "references": {
            "ash": {
                "causes": [cause, {"kind": "out of range", "text": "height at 1.4", "evidence": {}}],
                "regions": [region, {**region, "side": "surplus"}],
                "placement": {"centre": [0.0, 0.1, 0.0], "scale": 2.0},
            },
            "oak": {"causes": [], "regions": [region], "placement": {"centre": [0, 0, 0], "scale": 1.0}},
        },
        "summary": [
            {"kind": "missing part", "text": "missing part near legs: 1 reference", "references": ["ash", "gone"]}
        ],
        "suggestions": [
            {
                "kind": "new part",
                "title": f"a shelf {EVIL}",
                "text": "2 of 4 would become compatible",
                "snippet": 'shelf: bool = False  # "<b>"',
                "source": "...",
                "picture": base64.b64encode(picture(200)).decode(),
                "references": ["ash"],
                "gain": 2,
                "tried": {},
            }
        ],
        "seconds": {"causes": 1.0},
        **others,
    }


@pytest.fixture
def run(tmp_path):
    return saved(tmp_path / "run", typical())


def page(run):
    return (run / "report.html").read_text(encoding="utf-8")


def test_badges_summary_and_suggestions_are_shown(run):
    write(run, told())
    text = page(run)
    assert "What to write next" in text and "+2 <span" in text and "shelf: bool = False  # &#34;&lt;b&gt;&#34;" in text
    assert "missing part near legs: 1 reference" in text
    assert text.count('class="badge"') == 1 and text.count('class="badge lesser"') == 1
    assert "<script>window.broken" not in text and "<img src=x" not in text
    assert text.count('<svg class="regions"') == 1 and text.count('<svg class="regions surplus"') == 1
    data = json.loads(re.search(r'id="data">(.*?)</script>', text, re.S).group(1))
    causes = {pair["name"]: pair["causes"] for pair in data["pairs"]}
    assert [cause["kind"] for cause in causes["ash"]] == ["missing part", "out of range"] and causes["elm"] == []


def test_pictures_of_suggestions_become_files_and_come_back_into_the_page(run):
    record = write(run, told())
    assert record["suggestions"][0]["picture"] == "suggestions/1.png"
    assert (run / "suggestions" / "1.png").read_bytes() == picture(200)
    assert read_explanation(run)["suggestions"][0]["picture"].startswith("data:image/png;base64,")
    write(run, told(suggestions=[]))
    assert not (run / "suggestions").exists() and "What to write next" not in page(run)
    assert sorted(path.name for path in run.iterdir() if path.name.startswith(".")) == []


def test_a_report_written_anew_keeps_the_explanation(run):
    write(run, told())
    before = page(run)
    write_report(run)
    assert page(run) == before


def test_what_cannot_be_written_leaves_all_as_it_was(run, monkeypatch):
    write(run, told(suggestions=[]))
    before = {path.name: path.read_bytes() for path in run.iterdir() if path.is_file()}

    def full(*arguments):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("shapewright.feedback.record.write_report", full)
    with pytest.raises(RunError, match="No space left"):
        write(run, told())
    assert {path.name: path.read_bytes() for path in run.iterdir() if path.is_file()} == before
    assert not (run / "suggestions").exists() and not list(run.glob(".explanation*"))


def test_without_an_explanation_the_page_has_none_of_it(tmp_path):
    run = saved(tmp_path / "run", record([reference("elm", 0.3, group=0)]))
    write_report(run)
    assert "What to write next" not in page(run) and 'class="badge"' not in page(run)


def test_outlines_lie_where_the_thumbnail_shows_the_place():
    here = {"causes": [], "regions": [{**BOX, "side": "unexplained"}, {**BOX, "side": "surplus"}]}
    (mine,), (theirs,) = outlines({**here, "placement": {"centre": [0.0, 0.3, 0.0], "scale": 2.0}})
    places = np.array([[float(x), float(y)] for x, y in re.findall(r"(-?[\d.]+) (-?[\d.]+)", mine)])
    assert len(places) == 24 and np.allclose(places.mean(axis=0), 50.0, atol=1.0)
    moved = np.array([[float(x), float(y)] for x, y in re.findall(r"(-?[\d.]+) (-?[\d.]+)", theirs)])
    assert moved[:, 1].mean() < 45.0  # up in the replica's own frame, and half as large
    assert np.ptp(moved[:, 0]) == pytest.approx(np.ptp(places[:, 0]) / 2, rel=0.1)


def test_a_suggestion_is_a_coloured_difference(run):
    source = "\n".join(f"line {i} & <b>" for i in range(20))
    changed = source.replace("line 2 ", "first ").replace("line 15", "other")
    suggestion = told()["suggestions"][0] | {"diff": [vars(line) for line in difference_of(source, changed)]}
    write(run, told(suggestions=[suggestion]))
    text = page(run)
    assert '<tr class="removed"><td class="n">16</td><td class="n"></td>' in text and '<tr class="added">' in text
    assert "other &amp; &lt;b&gt;" in text and text.count('<tr class="same">') == 11
    assert text.count('<tr class="gap">') == 1
    assert "<span>replica now</span><span>replica then</span>" in text


def test_where_nothing_is_suggested_it_says_what_was_tried_and_what_that_took(run):
    tried = {"title": "a shelf <i>", "kind": "new part", "nearer": 3, "best": 1.21, "seconds": 2.5}
    write(run, told(suggestions=[], tried=[tried], seconds={"hypotheses": 4.0, "trials": 8.0}))
    text = page(run)
    assert "Nothing is suggested" in text and "took 12.0 s" in text
    assert "<td>a shelf &lt;i&gt;</td><td>new part</td><td>3</td><td>1.21</td><td>2.5 s</td>" in text
    write(run, told(suggestions=[], tried=[tried | {"best": None}], seconds={}))
    assert "<td>3</td><td>–</td>" in page(run)


def test_what_still_differs_in_good_replicas_is_told_quietly():
    cause = {"text": "another form of body"}
    one = {"causes": [cause], "remark": {"text": "narrower at the top"}}
    assert quiet(one, "different") is None and quiet(None, "replicated") is None
    assert quiet(one, "close") == "another form of body" and quiet(one, "replicated") == "narrower at the top"
    assert quiet({"causes": []}, "replicated") is None
