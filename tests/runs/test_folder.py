import json
import os
import subprocess
import sys
import time

import pytest

from shapewright.runs.folder import (
    RunError,
    check_writable,
    new_folder,
    next_run,
    previous_run,
    read_record,
    runs,
    suggested_parameters,
)


def write_run(folder, created="2026-01-01T00:00:00+00:00"):
    record = {"format": 1, "name": folder.name, "created": created, "references": [{"name": "chair"}]}
    with new_folder(folder) as partial:
        (partial / "iteration.json").write_text(json.dumps(record))
    return folder


def test_runs_are_numbered_after_the_greatest(tmp_path):
    assert next_run(tmp_path).name == "001"
    write_run(tmp_path / "007")
    write_run(tmp_path / "by-name")
    assert next_run(tmp_path).name == "008"
    assert [run.name for run in runs(tmp_path)] == ["007", "by-name"]


def test_numbers_and_the_records_time_order_runs_not_the_times_of_files(tmp_path):
    days = {"002": 2, "010": 4, "wide": 3, "001": 1, "early": 1, "later": 5}
    for age, (name, day) in enumerate(days.items()):
        write_run(tmp_path / name, f"2026-01-{day:02d}T00:00:00+00:00")
        os.utime(tmp_path / name / "iteration.json", (10**9 - age, 10**9 - age))
    assert [run.name for run in runs(tmp_path)] == ["001", "early", "002", "wide", "010", "later"]
    assert previous_run(tmp_path / "010").name == "wide" and previous_run(tmp_path / "001") is None
    assert previous_run(tmp_path / "011", {"chair"}).name == "later"
    # The clock of the machine that made the next one is years behind.
    write_run(tmp_path / "011", "2001-01-01T00:00:00+00:00")
    assert [run.name for run in runs(tmp_path)][-2:] == ["011", "later"]


def test_a_run_is_never_overwritten(tmp_path):
    folder = write_run(tmp_path / "001")
    with pytest.raises(RunError, match="never overwritten"):
        write_run(folder)
    with pytest.raises(RunError, match="never overwritten"):
        check_writable(folder)
    assert read_record(folder)["name"] == "001"


def test_a_failure_leaves_nothing(tmp_path):
    with pytest.raises(RunError, match="No space left on device"), new_folder(tmp_path / "001") as partial:
        (partial / "half").write_text("x")
        raise OSError(28, "No space left on device")
    assert list(tmp_path.iterdir()) == []


def test_a_kill_leaves_no_run(tmp_path):
    script = (
        "import os, signal, sys; from pathlib import Path; from shapewright.runs.folder import new_folder\n"
        "with new_folder(Path(sys.argv[1])) as partial:\n"
        "    (partial / 'iteration.json').write_text('{}')\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    killed = subprocess.run([sys.executable, "-c", script, tmp_path / "001"])
    assert killed.returncode == -9
    assert not (tmp_path / "001").exists() and runs(tmp_path) == []
    leftover = next(tmp_path.glob(".001.*.partial"))
    old = time.time() - 7200
    os.utime(leftover, (old, old))
    write_run(tmp_path / "001")
    assert [path.name for path in tmp_path.iterdir()] == ["001"]


def test_records_that_cannot_be_read_say_why(tmp_path):
    with pytest.raises(RunError, match="no run here"):
        read_record(tmp_path)
    (tmp_path / "iteration.json").write_text("{")
    with pytest.raises(RunError, match="cannot be read"):
        read_record(tmp_path)
    (tmp_path / "iteration.json").write_text('{"format": 99}')
    with pytest.raises(RunError, match="format 99"):
        read_record(tmp_path)


def test_a_place_that_cannot_be_written_is_said_before_the_work(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(RunError, match="cannot be written here"):
        check_writable(tmp_path / "file" / "001")
    with pytest.raises(RunError, match="something here already"):
        check_writable(tmp_path / "file")


def test_what_suggestions_found_is_read_where_the_procedure_has_their_parameters(tmp_path):
    tried = [{"a": {"width": 1.0, "handle": True}}, {"a": {"width": 2.0}, "b": {"width": 3.0}}]
    record = {"suggestions": [{"tried": {"parameters": found}} for found in tried] + [{"tried": None}]}
    (tmp_path / "explanation.json").write_text(json.dumps(record))
    assert suggested_parameters(tmp_path, ["width"]) == {"a": [{"width": 2.0}], "b": [{"width": 3.0}]}
    assert len(suggested_parameters(tmp_path, ["width", "handle"])["a"]) == 2
    assert suggested_parameters(tmp_path / "none", ["width"]) == {}
