import json

import pytest

from broken_disk import full_after, hidden, killed, shown
from shapewright.runs.folder import RunError
from shapewright.runs.marks import mark, marks_path, read_marks


def write_run(folder, distance=0.2, **others):
    folder.mkdir(parents=True)
    entry = {"name": "chair", "distance": distance, "iou": 0.8, "depth": 0.1, "compatible": False, **others}
    record = {"format": 1, "references": [entry, {"name": "lost", "distance": None, "iou": None, "compatible": False}]}
    (folder / "iteration.json").write_text(json.dumps(record))
    return folder


def test_marks_lie_beside_the_runs(tmp_path):
    assert marks_path(tmp_path / "runs" / "001") == tmp_path / "marks.json"
    assert marks_path(tmp_path / "elsewhere") == tmp_path / "marks.json"


def test_a_mark_keeps_what_the_run_measured_and_replaces_an_earlier_one(tmp_path):
    run = write_run(tmp_path / "runs" / "001")
    mark(run, "chair", same=True)
    path = mark(run, "chair", same=False)
    (entry,) = json.loads(path.read_text())
    measures = {"distance": 0.2, "iou": 0.8, "depth": 0.1}
    assert entry == {"a": "chair", "b": "chair", "same": False, "run": "001", "measures": measures}
    later = write_run(tmp_path / "runs" / "002", distance=0.1)
    mark(later, "chair", same=True)
    found = read_marks(later)
    assert [(m.same, m.measures["distance"]) for m in found] == [(False, 0.2), (True, 0.1)]


def test_marks_of_the_studio_take_their_measures_from_the_run_at_hand(tmp_path):
    write_run(tmp_path / "runs" / "001")
    (tmp_path / "marks.json").write_text(
        json.dumps([{"a": "chair", "b": "chair", "same": True}, {"a": "chair", "b": "lost", "same": False}])
    )
    (found,) = read_marks(tmp_path / "runs" / "002")
    assert found.same and found.measures["iou"] == 0.8
    assert len(read_marks(tmp_path / "runs" / "001", measured=False)) == 2


def test_other_entries_of_a_mark_survive(tmp_path):
    run = write_run(tmp_path / "runs" / "001")
    (tmp_path / "marks.json").write_text(json.dumps([{"a": "x", "b": "y", "same": True, "note": "legs"}]))
    mark(run, "chair", same=True)
    assert json.loads((tmp_path / "marks.json").read_text())[0]["note"] == "legs"


def test_what_cannot_be_marked_says_why(tmp_path):
    run = write_run(tmp_path / "runs" / "001")
    with pytest.raises(RunError, match="no reference 'stool'"):
        mark(run, "stool", same=True)
    with pytest.raises(RunError, match="no replica"):
        mark(run, "lost", same=True)
    with pytest.raises(RunError, match="no run here"):
        mark(tmp_path / "runs" / "009", "chair", same=True)
    (tmp_path / "marks.json").write_text("{not json")
    with pytest.raises(RunError, match="mend the file"):
        mark(run, "chair", same=True)
    assert (tmp_path / "marks.json").read_text() == "{not json"


def test_marks_are_written_whole_or_not_at_all(tmp_path):
    run = write_run(tmp_path / "runs" / "001")
    path = mark(run, "chair", same=True)
    before = path.read_bytes()
    with pytest.raises(RunError, match="cannot be written: File too large"), full_after(20):
        mark(run, "chair", same=False)
    assert path.read_bytes() == before and not hidden(tmp_path)
    killed(lambda: mark(run, "chair", same=False))
    assert shown(tmp_path)["marks.json"] == before
