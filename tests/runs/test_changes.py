import json
from types import SimpleNamespace

import pytest

import shapewright as sw
from shapewright.runs.changes import Move
from shapewright.runs.folder import RunError


def record(**distances):
    return {
        "format": 1,
        "references": [
            {"name": n, "distance": d, "compatible": d is not None and d <= 0.18} for n, d in distances.items()
        ],
    }


def judged(**fidelities):
    entries = [
        {
            "name": name,
            "distance": 0.1,
            "compatible": True,
            "fidelity": value,
            "grade": "replicated" if value and value >= 0.5 else "close",
        }
        for name, value in fidelities.items()
    ]
    return {"format": 1, "judge": "fidelity", "references": entries}


def test_iterations_folders_and_records_are_compared_alike(tmp_path):
    before, after = record(oak=0.3, elm=0.1, gum=0.5), record(oak=0.1, elm=0.11, fir=None)
    (tmp_path / "001").mkdir()
    (tmp_path / "001" / "iteration.json").write_text(json.dumps(before))
    changed = sw.compare(before, after)
    assert changed.gained == (Move("oak", 0.3, 0.1),) and changed.lost == changed.closer == changed.further == ()
    assert (changed.added, changed.removed) == (("fir",), ("gum",))
    assert sw.compare(tmp_path / "001", after) == sw.compare(str(tmp_path / "001"), SimpleNamespace(record=after))
    assert sw.compare(after, before).lost == (Move("oak", 0.1, 0.3),)
    assert sw.compare(before, after, tolerance=0.001).further == (Move("elm", 0.1, 0.11),)
    with pytest.raises(RunError, match="no run here"):
        sw.compare(tmp_path / "002", after)


def test_runs_that_fidelity_judged_are_compared_by_it():
    before, after = judged(oak=0.3, elm=0.9, fir=None, yew=0.1), judged(oak=0.8, elm=0.4, fir=0.3, yew=0.15)
    changed = sw.compare(before, after)
    assert changed.judge == "fidelity"
    assert (changed.gained, changed.lost) == ((Move("oak", 0.3, 0.8),), (Move("elm", 0.9, 0.4),))
    assert changed.closer == (Move("fir", None, 0.3),) and changed.further == ()
    assert sw.compare(before, after, tolerance=0.01).closer == (Move("fir", None, 0.3), Move("yew", 0.1, 0.15))


def test_a_run_of_the_paper_is_compared_with_any_other_by_the_papers_measure():
    changed = sw.compare(record(oak=0.3), judged(oak=0.2))
    assert changed.judge == "paper" and changed.gained == (Move("oak", 0.3, 0.1),)
