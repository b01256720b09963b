"""Samples from the command line: shards by a shell loop, joined by another command."""

import json
import subprocess
import sys
import tarfile

import pytest

SOURCE = """
from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def plank(height: Annotated[float, Range(0.3, 0.8)] = 0.5):
    return box((1, height, 1))
"""


def shapewright(*arguments, cwd):
    program = "from shapewright.cli.main import main; main()"
    command = [sys.executable, "-c", program, *map(str, arguments)]
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=120)


@pytest.fixture
def project(tmp_path):
    (tmp_path / "plank.py").write_text(SOURCE)
    return tmp_path


def test_shards_of_a_shell_loop_are_joined(project):
    for k in (1, 2):
        shard = ("--shard", f"{k}/2", "--out", f"shards/{k}", "--format", "wds")
        run = shapewright("sample", "plank.py", "-n", "1_0", *shard, "--workers", 1, cwd=project)
        assert run.returncode == 0, run.stderr
    early = shapewright("samples", "merge", "shards/2", "--out", "early", "--json", cwd=project)
    assert early.returncode == 1 and "1 of 2 shards are missing: 1/2" in json.loads(early.stdout)["error"]
    run = shapewright("samples", "merge", "shards/1", "shards/2", "--out", "all", "--json", cwd=project)
    assert run.returncode == 0, run.stderr
    told = json.loads(run.stdout)
    assert (told["samples"], told["shards"], told["manifest"]) == (10, 2, str(project / "all" / "manifest.csv"))
    with tarfile.open(project / "all" / "plank-00000.tar") as archive:
        assert [name for name in archive.getnames() if name.endswith(".glb")] == [
            f"plank-{i:05d}.glb" for i in range(10)
        ]


def test_a_shard_that_is_none_is_refused_before_any_work(project):
    for shard, message in (("3/2", "there is no shard 3/2"), ("half", "is no shard: write K/M")):
        run = shapewright("sample", "plank.py", "--shard", shard, "--out", "out", cwd=project)
        assert run.returncode == 2 and message in " ".join(run.stderr.replace("│", " ").split())
    assert not (project / "out").exists()
