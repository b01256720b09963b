"""From end to end with a program of its own that knows nothing of shapewright."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from shapewright import load_procedure

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "generators" / "command"


def shapewright(*arguments, cwd):
    command = [sys.executable, "-m", "shapewright", *map(str, arguments)]
    environment = {**os.environ, "SHAPEWRIGHT_CACHE": str(cwd / "cache")}
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, env=environment, timeout=200)


def test_a_command_is_sampled_fitted_and_kept_in_its_run(tmp_path):
    project = tmp_path / "boxes"
    shutil.copytree(EXAMPLE, project)
    made = shapewright("sample", "tool_box.toml", "-n", 3, "--format", "stl", "--out", "refs", "--seed", 7, cwd=project)
    assert made.returncode == 0, made.stderr
    little = ("--samples", 40, "--epochs", 1, "--refine", "off", "--json")
    fitted = shapewright("fit", "tool_box.toml", "refs/*.stl", *little, cwd=project)
    assert fitted.returncode == 0, fitted.stderr
    record = json.loads(fitted.stdout.splitlines()[-1])
    assert record["references"] == 3 and {"compartments", "feet"} <= set(
        next(iter(record["results"].values()))["parameters"]
    )
    run = project / "runs" / "001"
    assert (run / "procedure.toml").read_text() == (project / "tool_box.toml").read_text()
    assert (run / "procedure" / "tool_box.py").read_text() == (project / "tool_box.py").read_text()
    printed = shapewright("parameters", run, "--form", "json", cwd=project)
    assert printed.returncode == 0, printed.stderr
    assert set(json.loads(printed.stdout)["parameterSets"]) == set(record["results"])
    assert "there is no reference 'x'" in shapewright("parameters", run, "x", cwd=project).stderr.replace("\n", " ")
    assert load_procedure(run / "procedure" / "tool_box.toml")(width=300.0).extent[0] == 300.0


def test_a_failure_of_all_shapes_says_what_the_program_said(tmp_path):
    (tmp_path / "spec.toml").write_text(
        "run = \"sh -c 'echo no licence >&2; exit 4' {width} {out.obj}\"\n[parameters]\nwidth = { range = [1, 2] }\n"
    )
    made = shapewright("sample", "spec.toml", "-n", 9, "--out", "out", cwd=tmp_path)
    assert made.returncode == 1
    assert "the program failed: no licence (exit status 4)" in made.stderr.replace("\n", " ")


def test_parameters_of_a_file_are_built_and_those_of_a_run_come_out(tmp_path):
    (tmp_path / "sets.json").write_text(
        json.dumps({"parameterSets": {"wide one": {"width": "480", "handle": "false"}, "b": {}}})
    )
    made = shapewright(
        "sample",
        EXAMPLE / "tool_box.toml",
        "--parameters",
        "sets.json",
        "--format",
        "obj",
        "--out",
        "made",
        cwd=tmp_path,
    )
    assert made.returncode == 0, made.stderr
    assert sorted(path.name for path in (tmp_path / "made").glob("*.obj")) == ["b.obj", "wide-one.obj"]
    rows = (tmp_path / "made" / "manifest.csv").read_text().splitlines()
    assert rows[1].startswith("wide-one.obj,480.0,180.0,110.0,8.0,2,none,20.0,False,")
    again = shapewright(
        "sample", EXAMPLE / "tool_box.toml", "--parameters", "made/manifest.csv", "--out", "again", cwd=tmp_path
    )
    assert again.returncode == 0, again.stderr
    wrong = shapewright("sample", EXAMPLE / "tool_box.toml", "--parameters", "rows.csv", "--out", "c", cwd=tmp_path)
    assert wrong.returncode == 1 and "rows.csv: it cannot be read" in wrong.stderr.replace("\n", " ")
