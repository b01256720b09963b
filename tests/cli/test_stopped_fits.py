"""A fit that was killed, or whose disk was full, goes on with the same command and ends with the same run."""

import json
import os
import random
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import shapewright as sw
from shapewright.fitting.keeping.unfinished import UNFINISHED, Unfinished
from shapewright.runs.folder import RunError
from shapewright.runs.iteration import Iteration
from shapewright.shapes.files import encode

STOOL = """
from typing import Annotated, Literal
from shapewright import Range, procedure
from shapewright.modelling.solids import box, cylinder

@procedure
def stool(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    width: Annotated[float, Range(0.5, 1.0)] = 0.6,
    seat: Literal["square", "round"] = "square",
):
    top = (cylinder if seat == "round" else box)((width, 0.1, width), at=(0, height, 0))
    return top | box((0.15, height, 0.15), at=(0, height / 2, 0))
"""
COMMAND = ("fit", "stool.py", "refs", "--seed", "1", "--samples", "60", "--epochs", "1", "--chunk", "2")
_TIMES = ("seconds", "build_seconds", "created", "first_answer", "source", "origins", "path", "notices")


@pytest.fixture
def project(tmp_path):
    return _project(tmp_path)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The run of a command that nobody stops."""
    folder = _project(tmp_path_factory.mktemp("whole"))
    assert _started(folder).wait() == 0
    assert not (folder / "runs" / UNFINISHED).exists()
    return _written(folder)


def _project(folder):
    (folder / "stool.py").write_text(STOOL)
    (folder / "refs").mkdir()
    stool = sw.load_procedure(folder / "stool.py")
    for i, height in enumerate(np.linspace(0.35, 0.95, 8)):
        shape = stool(height=float(height), width=0.9 - 0.04 * i, seat="round" if i % 3 else "square")
        (folder / "refs" / f"stool{i}.glb").write_bytes(encode(shape))
    return folder


def _started(folder, *more):
    paths = {"PYTHONPATH": str(Path(sw.__file__).parents[1]), "SHAPEWRIGHT_CACHE": str(folder / "cache")}
    command = [sys.executable, "-m", "shapewright", *COMMAND, *more]
    return subprocess.Popen(command, cwd=folder, env=os.environ | paths, stderr=subprocess.PIPE, text=True)


def _written(folder):
    """All that the first run of a folder says, but for times and places."""
    run = folder / "runs" / "001"
    replicas = {path.name: path.read_bytes() for path in sorted((run / "replicas").iterdir())}
    record = json.loads((run / "iteration.json").read_text())
    return _plain(record), replicas, (run / "parameters.json").read_text()


def _same(one, other):
    """Told where they differ: whole records are too long to be read."""
    for name, value in one[0].items():
        assert value == other[0][name], name
    assert one == other


def _plain(value):
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items() if key not in _TIMES}
    return [_plain(each) for each in value] if isinstance(value, list) else value


def _pieces(folder):
    return [path for path in (folder / "runs").glob(f"{UNFINISHED}/*/*") if not path.name.startswith(".")]


@pytest.mark.skipif(os.name != "posix", reason="kills as POSIX does")
def test_a_fit_that_is_killed_again_and_again_ends_with_the_same_run(project, whole):
    moments = random.Random(21)
    went_on, deaths = 0, 0
    for pieces in (0, *sorted(moments.sample(range(1, 9), 3))):
        process = _started(project)
        while process.poll() is None and len(_pieces(project)) < pieces:
            time.sleep(0.01)
        time.sleep(moments.uniform(0.0, 0.4 if pieces else 3.0))
        process.kill()
        went_on += "goes on with a fit" in process.communicate()[1]
        deaths += process.returncode == -signal.SIGKILL
        assert process.returncode == 0 or not (project / "runs" / "001").exists()
    assert deaths >= 3
    last = _started(project)
    went_on += "goes on with a fit" in last.communicate()[1]
    assert last.returncode == 0 and went_on >= 2
    _same(_written(project), whole)
    assert not (project / "runs" / UNFINISHED).exists()


@pytest.mark.skipif(os.name != "posix", reason="kills as POSIX does")
def test_fresh_begins_anew(project, whole):
    process = _started(project)
    while process.poll() is None and not any("search" in path.name for path in _pieces(project)):
        time.sleep(0.01)
    process.kill()
    process.communicate()
    for piece in _pieces(project):
        piece.write_bytes(b"what must not be read")
    last = _started(project, "--fresh")
    assert "goes on with a fit" not in last.communicate()[1] and last.returncode == 0
    _same(_written(project), whole)


def test_a_full_disk_loses_nothing(project, whole):
    procedure, references = sw.load_procedure(project / "stool.py"), sw.Collection.load(project / "refs")
    settings = sw.Settings(seed=1, samples=60, epochs=1)
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

    def fill(event):
        if sum("search" in path.name for path in _pieces(project)) >= 2:
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, limit[1]))

    root = project / "runs" / UNFINISHED
    try:
        with pytest.raises(RunError, match="what was done before is kept: free some space"):
            sw.fit(procedure, references, settings, progress=fill, unfinished=Unfinished(root), chunk=2)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        signal.signal(signal.SIGXFSZ, before)
    kept = {path.name: path.stat().st_mtime_ns for path in _pieces(project)}
    assert sum("search" in name for name in kept) >= 2
    unfinished = Unfinished(root)
    iteration = sw.fit(procedure, references, settings, unfinished=unfinished, chunk=2)
    assert {path.name: path.stat().st_mtime_ns for path in _pieces(project)}.items() >= kept.items()
    iteration.save(project / "runs" / "001")
    unfinished.remove()
    _same(_written(project), whole)
    assert Iteration.load(project / "runs" / "001").names == iteration.names
