import json

import numpy as np
import pytest

from broken_disk import full_after, hidden, killed, shown
from shapewright.judging.calibration import calibrate
from shapewright.judging.paper import light_field_metric
from shapewright.judging.target import Measures
from shapewright.runs.folder import RunError
from shapewright.runs.iteration import Iteration
from shapewright.runs.marks import DOUBTFUL, mark, marks_path, read_marks, worth_marking
from shapewright.runs.result import Result
from shapewright.settings import Settings


def write_run(folder, distance=0.2, **others):
    folder.mkdir(parents=True)
    entry = {
        "name": "chair",
        "distance": distance,
        "iou": 0.8,
        "depth": 0.1,
        "fidelity": 0.4,
        "compatible": False,
        **others,
    }
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
    measures = {"distance": 0.2, "iou": 0.8, "depth": 0.1, "fidelity": 0.4}
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


def iteration(fidelities, kinds=None, distances=None, **settings):
    """kinds: the group of each, or the choice of its replica as a text."""
    results = [
        Result(
            name=f"{i:03d}",
            path=None,
            parameters={"legs": kind if isinstance(kind, str) else "four", "height": 0.1 * i},
            active=("legs", "height"),
            at_limit=(),
            replica=None,
            measured=Measures(distance=0.1 if distances is None else distances[i], fidelity=fidelity),
            grade="close",
            compatible=True,
            group=kind if isinstance(kind, int) else None,
            reference=None,
        )
        for i, (fidelity, kind) in enumerate(zip(fidelities, kinds or [0] * len(fidelities), strict=True))
    ]
    return Iteration(
        tuple(results),
        light_field_metric(0.18),
        (),
        Settings(**{"replicated": 0.5, "close": 0.2} | settings),
        {},
        {},
        "",
        {},
        {},
        {},
        "",
    )


def test_the_pairs_nearest_to_the_cut_are_worth_marking():
    found = worth_marking(iteration([0.05, 0.45, 0.95, 0.52, 0.7, float("nan")]), 8)
    assert found == ("003", "001", "004")  # of the others the judge is sure, or there is no replica
    assert worth_marking(iteration([0.05, 0.45, 0.95, 0.52, 0.7]), 1) == ("003",)
    assert worth_marking(iteration([0.5, 0.72], replicated=0.75, close=0.1), 1) == ("001",)
    assert worth_marking(iteration([0.5, 0.6]), 8, marked={"000"}) == ("001",)


def test_pairs_of_different_kinds_come_before_more_of_one_kind():
    fidelities = [0.5, 0.51, 0.52, 0.53, 0.6, 0.7, 0.71]
    found = worth_marking(iteration(fidelities, [0, 0, 0, 0, 1, "star", "sled"]), 5)
    assert found == ("000", "004", "005", "006", "001")


def test_where_the_paper_judges_the_pairs_nearest_to_the_threshold_are_worth_marking():
    found = worth_marking(iteration([0.5] * 4, [0, 1, 2, 3], [0.02, 0.17, 0.4, 0.25], judge="paper"), 8)
    assert found == ("001", "003")


@pytest.mark.parametrize("hidden", [0.45, 0.8, 0.9])
def test_marks_that_are_asked_for_bring_the_cut_nearer_to_the_eye_than_random_ones(hidden):
    """The eye is a hidden cut with some doubt around it; two runs of eight marks each."""
    apart = {"asked": [], "random": []}
    for seed in range(60):
        rng = np.random.default_rng(seed)
        fidelities = rng.beta(0.5, 0.5, 60).tolist()
        same = (rng.random(60) < 1.0 / (1.0 + np.exp((hidden - np.array(fidelities)) / 0.05))).tolist()
        for way, gaps in apart.items():
            cut, marked = Settings.replicated, []
            for _ in range(2):
                run = iteration(fidelities, list(range(60)), replicated=cut, close=0.01)
                free = [name for name in run.names if int(name) not in marked]
                chosen = (
                    worth_marking(run, 8, {f"{i:03d}" for i in marked}) if way == "asked" else rng.permutation(free)[:8]
                )
                marked += [int(name) for name in chosen]
                cut = calibrate(
                    [{"distance": 0.1, "fidelity": fidelities[i]} for i in marked], [same[i] for i in marked]
                ).replicated
            gaps.append(abs(cut - hidden))
    assert np.mean(apart["asked"]) < 0.85 * np.mean(apart["random"])
    assert DOUBTFUL < 0.5
