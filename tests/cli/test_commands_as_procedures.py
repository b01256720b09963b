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
    assert (run / "tool_box.py").read_text() == (project / "tool_box.py").read_text()
    assert load_procedure(run / "procedure.toml")(width=300.0).extent[0] == 300.0


def test_a_failure_of_all_shapes_says_what_the_program_said(tmp_path):
    (tmp_path / "spec.toml").write_text(
        "run = \"sh -c 'echo no licence >&2; exit 4' {width} {out.obj}\"\n[parameters]\nwidth = { range = [1, 2] }\n"
    )
    made = shapewright("sample", "spec.toml", "-n", 9, "--out", "out", cwd=tmp_path)
    assert made.returncode == 1
    assert "the program failed: no licence (exit status 4)" in made.stderr.replace("\n", " ")
