import json
from pathlib import Path

from shapewright.runs.folder import FORMAT, RECORD
from shapewright.settings import Settings
from shapewright.studio.session.marking import cuts, learned, marking


def marked(project: Path, *pairs: tuple[float, float, bool]) -> Path:
    entries = [
        {"a": f"{i}", "b": f"{i}", "same": same, "measures": {"fidelity": fidelity, "distance": distance}}
        for i, (fidelity, distance, same) in enumerate(pairs)
    ]
    (project / "marks.json").write_text(json.dumps(entries))
    return project


def test_the_cut_is_where_most_marks_are_right(tmp_path):
    project = marked(tmp_path, (0.9, 0.1, True), (0.7, 0.1, False), (0.6, 0.2, False))
    found = learned(project, None, "fidelity")
    assert found is not None and 0.7 < found.cut < 0.9
    assert (found.count, found.agrees, found.usual, found.usual_agrees) == (3, 3, Settings.replicated, 2)
    assert cuts(found, "fidelity") == {"replicated": found.cut, "close": Settings.close}


def test_a_cut_below_close_takes_close_along(tmp_path):
    found = learned(marked(tmp_path, (0.1, 0.1, True), (0.05, 0.1, False)), None, "fidelity")
    assert found is not None and found.cut < Settings.close
    assert cuts(found, "fidelity")["close"] == found.cut


def test_by_the_papers_judge_marks_move_the_threshold(tmp_path):
    found = learned(marked(tmp_path, (0.9, 0.05, True), (0.9, 0.1, False)), None, "paper")
    assert found is not None and cuts(found, "paper") == {"threshold": found.cut} and 0.05 < found.cut < 0.1


def test_no_marks_are_asked_for_that_would_not_move_the_cut(tmp_path):
    entry = {
        **dict.fromkeys(("path", "parameters", "replica", "error", "group")), "active": [], "at_limit": [],
        "name": "a", "distance": 0.18, "fidelity": 0.5, "compatible": True,
    }  # fmt: skip
    run = tmp_path / "runs" / "001"
    run.mkdir(parents=True)
    record = {"format": FORMAT, "settings": Settings().record(), "threshold": 0.18, "references": [entry]}
    (run / RECORD).write_text(json.dumps(record))
    now, paper = Settings(), Settings(judge="paper")
    assert marking(tmp_path, run, {"a": "slug-a"}, now, now).asked == ["slug-a"]
    assert marking(tmp_path, run, {"a": "slug-a"}, paper, paper).asked == ["slug-a"]
    assert marking(tmp_path, run, {"a": "slug-a"}, now, paper).asked == []
    marked(tmp_path, (0.5, 0.18, True))
    (tmp_path / "marks.json").write_text((tmp_path / "marks.json").read_text().replace('"0"', '"a"'))
    assert marking(tmp_path, run, {"a": "slug-a"}, now, now).asked == []


def test_without_marks_the_cuts_are_the_usual_ones(tmp_path):
    assert learned(tmp_path, None, "fidelity") is None
    assert cuts(None, "fidelity") == {"replicated": Settings.replicated, "close": Settings.close}
