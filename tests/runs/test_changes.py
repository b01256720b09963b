import json
from types import SimpleNamespace

import pytest

import shapewright as sw
from shapewright.runs.changes import Move
from shapewright.runs.folder import RunError


def record(**distances):
    entries = [{"name": n, "distance": d, "compatible": d is not None and d <= 0.18} for n, d in distances.items()]
    return {"format": 1, "references": entries}


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
