import json
import os
import signal
import subprocess
import sys
import time
from functools import partial

import numpy as np
import pytest

from shapewright.modelling.solids import box
from shapewright.runs.result import MEASURES

SOURCE = """
from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def stool(height: Annotated[float, Range(0.3, 1.0)] = 0.6, foot: bool = False):
    {body}
    shape = box((1, 0.1, 1), at=(0, height, 0)) | box((0.15, height, 0.15), at=(0, height / 2, 0))
    return shape | box((0.6, 0.06, 0.6)) if foot else shape
"""
QUICK = ("--samples", "60", "--epochs", "1")


def shapewright(*arguments, cwd, env=None, timeout=120):
    command = [sys.executable, "-m", "shapewright", *map(str, arguments)]
    environment = {**os.environ, "SHAPEWRIGHT_CACHE": str(cwd / "cache"), **(env or {})}
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, env=environment, timeout=timeout)


def last_json(run):
    return json.loads(run.stdout.splitlines()[-1])


@pytest.fixture
def project(tmp_path):
    (tmp_path / "stool.py").write_text(SOURCE.format(body=""))
    references = tmp_path / "references"
    references.mkdir()
    for i, size in enumerate([(1, 0.5, 1), (1, 2, 1), (0.2, 1, 3)]):
        mesh = box(size).mesh()
        lines = [f"v {x} {y} {z}" for x, y, z in mesh.vertices]
        lines += [f"f {a} {b} {c}" for a, b, c in mesh.faces + 1]
        (references / f"block {i}.obj").write_text("\n".join(lines))
    return tmp_path


def test_fit_compare_and_report(project):
    first = shapewright("fit", "stool.py", "references", *QUICK, "--json", cwd=project)
    assert first.returncode == 0, first.stderr
    record = last_json(first)
    assert first.stdout.count("\n") == 1 and "training" in first.stderr
    assert record["run"] == str(project / "runs" / "001") and record["references"] == 3
    assert record["replicated"] + record["close"] + record["different"] == 3 and record["judge"] == "fidelity"
    assert record["compatible"] + record["incompatible"] == 3 and set(record["means"]["replicated"]) == set(MEASURES)
    assert all({"grade", "fidelity", "distance"} <= set(result) for result in record["results"].values())
    assert set(record["seconds"]) >= {"train", "compare"}
    assert set(record["results"]) == {"block 0", "block 1", "block 2"}

    second = shapewright("fit", "stool.py", "references", *QUICK, "--seed", "1", cwd=project)
    assert second.returncode == 0, second.stderr
    for words in ("of 3 references are replicated", "paper's measure: ", "runs/002/report.html"):
        assert words in second.stdout

    again = ("fit", "stool.py", "references", "--samples", "60", "--from", "runs/001")
    third = shapewright(*again, "--judge", "paper", "--json", cwd=project)
    assert third.returncode == 0, third.stderr
    record = last_json(third)
    assert record["run"] == str(project / "runs" / "003")
    assert (record["judge"], record["replicated"], record["close"]) == ("paper", record["compatible"], 0)
    assert "newly compatible" in shapewright("compare", "runs/002", "runs/003", cwd=project).stdout

    compared = shapewright("compare", "runs/001", "runs/002", "--json", cwd=project)
    assert set(last_json(compared)) == {"judge", "gained", "lost", "closer", "further", "added", "removed"}
    assert "newly replicated" in shapewright("compare", "runs/001", "runs/002", cwd=project).stdout

    page = project / "runs" / "002" / "report.html"
    before = page.read_text()
    page.unlink()
    report = shapewright("report", "runs/002", cwd=project)
    assert report.returncode == 0 and report.stdout.strip() == str(page)
    assert page.read_text() == before and "001" in before


def test_new_makes_a_project_that_fits(project):
    made = shapewright("new", "chairs", cwd=project)
    assert made.returncode == 0 and "shapewright fit procedure.py references" in made.stdout
    folder = project / "chairs"
    for reference in (project / "references").iterdir():
        reference.rename(folder / "references" / reference.name)
    assert shapewright("fit", "procedure.py", "references", *QUICK, cwd=folder).returncode == 0
    again = shapewright("new", "chairs", cwd=project)
    assert again.returncode == 1 and "exists already" in again.stderr


def test_evaluate_prints_a_row_for_each_parameter(project):
    run = shapewright("evaluate", "stool.py", *QUICK, "--seeds", "2", cwd=project)
    assert run.returncode == 0, run.stderr
    rows = [line.split()[:3] for line in run.stdout.splitlines()]
    assert ["height", "scalar", "MAE"] in rows and ["foot", "binary", "F1"] in rows
    assert any(row[:2] == ["Fidelity:", "how"] for row in rows) and "IoU of volumes" in run.stdout
    record = last_json(shapewright("evaluate", "stool.py", *QUICK, "--refine", "off", "--json", cwd=project))
    assert set(record["parameters"]["height"]) == {"network"} and len(record["seconds"]) == 1
    assert set(record["means"]) == {"all", "replicated"} and record["means"]["all"]["iou"] is None
    compared = ("evaluate", "stool.py", *QUICK, "--refine", "off", "--compare", "cameras", "--json")
    found = last_json(shapewright(*compared, cwd=project))["variants"]
    assert [variant["cameras"] for variant in found] == ["fixed", "learned"]
    assert all("height" in variant["parameters"] for variant in found)


def test_scans_that_cannot_be_explained_are_refused_before_the_fit(project):
    points = np.random.default_rng(0).random((300, 3))
    (project / "scan.xyz").write_text("\n".join(f"{x:.4f} {y:.4f} {z:.4f}" for x, y, z in points))
    run = shapewright("fit", "stool.py", "scan.xyz", *QUICK, "--explain", cwd=project)
    assert run.returncode == 1 and "the references are points" in run.stderr
    assert not list(project.glob("runs/*/iteration.json"))


def test_describe_shows_the_space(project):
    table = shapewright("describe", "stool.py", cwd=project)
    assert table.returncode == 0 and "parameter" in table.stdout
    schema = last_json(shapewright("describe", "stool.py", "--json", cwd=project))
    assert schema["title"] == "stool" and all(name in table.stdout for name in schema["properties"])


def test_sample_without_a_shape_fails(project):
    text = (project / "stool.py").read_text()
    (project / "number.py").write_text(
        text + "\n\ndef broken(*_, **__):\n    return 3.0\n\n\nstool.function = broken\n"
    )
    run = shapewright("sample", "number.py", "-n", "4", "--out", "none", cwd=project)
    assert run.returncode != 0 and "could be built" in run.stderr


def test_sample_writes_shapes_and_their_parameters(project):
    run = shapewright("sample", "stool.py", "-n", "7", "--out", "shapes", "--format", "ply", "--json", cwd=project)
    assert run.returncode == 0, run.stderr
    assert last_json(run)["shapes"] == 7
    assert len(list((project / "shapes").glob("*.ply"))) == 7
    again = shapewright("sample", "stool.py", "-n", "7", "--out", "shapes", cwd=project)
    assert again.returncode == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nowhere.py", "references"], "nowhere.py: no such file"),
        (["stool.py", "nowhere"], "nowhere"),
        (["stool.py", "empty"], "empty"),
        (["stool.py", "broken"], "none of the 2 files can be read"),
        (["syntax.py", "references"], "syntax.py:2"),
        (["plain.py", "references"], "no procedure in this file"),
        (["bare.py", "references"], "it has no parameters"),
        (["text.py", "references"], "annotation str is not supported"),
        (["raises.py", "references"], "every one of the first 8 shapes failed"),
        (["endless.py", "references", "--time-limit", "0.5"], "it took longer than 0.5 s"),
        (["stool.py", "references", "--out", "occupied"], "never overwritten"),
        (["stool.py", "references", "--out", "stool.py/001"], "cannot be written here"),
        (["stool.py", "references", "--up", "w"], "up"),
        (["stool.py", "references", "--threshold", "-1"], "threshold"),
    ],
)
def test_each_mistake_is_one_clear_message(project, arguments, message):
    (project / "empty").mkdir()
    (project / "broken").mkdir()
    (project / "broken" / "a.ply").write_text("ply\nformat ascii")
    (project / "broken" / "b.glb").write_bytes(b"glTF")
    (project / "occupied").mkdir()
    (project / "occupied" / "file").write_text("")
    (project / "syntax.py").write_text("\ndef broken(:\n")
    (project / "plain.py").write_text("x = 1\n")
    (project / "bare.py").write_text("from shapewright import procedure\n@procedure\ndef f(): ...\n")
    (project / "text.py").write_text("from shapewright import procedure\n@procedure\ndef f(x: str): ...\n")
    (project / "raises.py").write_text(SOURCE.format(body="return 1 / 0"))
    (project / "endless.py").write_text(SOURCE.format(body="while True: pass"))
    run = shapewright("fit", *arguments, *QUICK, "--json", cwd=project)
    assert run.returncode == 1
    assert message in " ".join(run.stderr.split()) and "Traceback" not in run.stderr
    assert message in last_json(run)["error"]
    assert not (project / "runs" / "001").exists()


def test_a_wrong_option_is_a_usage_error(project):
    run = shapewright("fit", "stool.py", "references", "--wrong", cwd=project)
    assert run.returncode == 2 and "No such option" in run.stderr


def test_every_command_has_help(tmp_path):
    for command in ("new", "fit", "evaluate", "sample", "report", "compare", "studio", "demo"):
        run = shapewright(command, "--help", cwd=tmp_path, env={"COLUMNS": "120"})
        assert run.returncode == 0 and "Usage" in run.stdout


def written(project):
    runs = project / "runs"
    return {path.name for path in runs.iterdir()} if runs.exists() else set()


@pytest.mark.skipif(sys.platform == "win32", reason="sends a POSIX signal")
def test_an_interrupt_stops_cleanly_and_writes_nothing(project):
    command = [sys.executable, "-m", "shapewright", "fit", "stool.py", "references", "--epochs", "2000"]
    heard = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)  # what a shell starts in the background ignores it
    with subprocess.Popen(command, cwd=project, stderr=subprocess.PIPE, text=True, preexec_fn=heard) as process:
        for line in process.stderr:
            if "training" in line:
                break
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        rest = process.stderr.read()
        # An interpreter that is interrupted while it imports ends by the signal itself; a shell reads both as 130.
        assert process.wait(timeout=30) in (130, -signal.SIGINT), rest
    assert "nothing of this run was written" in rest and "Traceback" not in rest
    assert written(project) <= {".unfinished"}


@pytest.mark.skipif(sys.platform == "win32", reason="limits file sizes the POSIX way")
def test_a_full_disk_is_a_message_and_leaves_nothing(project):
    limit = "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000)); "
    limit += "import signal; signal.signal(signal.SIGXFSZ, signal.SIG_IGN); "
    limit += f"sys.argv = ['shapewright', 'fit', 'stool.py', 'references', *{QUICK!r}]; "
    limit += "from shapewright.cli.main import main; main()"
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "0", "TMPDIR": str(project)}
    run = subprocess.run(
        [sys.executable, "-c", limit], cwd=project, capture_output=True, text=True, env=environment, timeout=120
    )
    assert run.returncode == 1 and "cannot be written: File too large" in run.stderr
    assert "Traceback" not in run.stderr
    assert written(project) <= {".unfinished"}


def test_what_was_found_of_up_and_front_is_told_before_anything_long_starts(project):
    run = shapewright("fit", "stool.py", "references", "--up", "auto", *QUICK, "--json", cwd=project)
    assert run.returncode == 0, run.stderr
    told, _, _ = run.stderr.partition("training")
    assert "finding up and front" in told and "no up is to be seen: 3 (block 0, block 1, block 2)" in told
    axes = last_json(run)["axes"]
    assert set(axes) == {"block 0", "block 1", "block 2"} and not any(each["has_up"] for each in axes.values())
    assert all((each["by"] == "found") == ((each["up"], each["front"]) != ("y", "z")) for each in axes.values())
    assert (project / "runs" / "001" / "axes.png").is_file()
