"""submitit's own executor for jobs of this machine: what goes through it is what this machine finds."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

import shapewright as sw
from shapewright.building import ExecutorError
from shapewright.building.clusters import ClusterName, opened
from shapewright.building.executors import Cluster
from shapewright.fitting.samples import write_samples
from shapewright.modelling.solids import box

submitit = pytest.importorskip("submitit", reason="needs the extra slurm; run `make test-adapters`")

PLANK = """
import os, pathlib, time
from typing import Annotated
from shapewright import Infeasible, Range, procedure
from shapewright.modelling.solids import box

@procedure
def plank(height: Annotated[float, Range(0.3, 0.8)] = 0.5, legs: Annotated[int, Range(1, 4)] = 4):
    time.sleep(SECONDS)
    if legs == 2:
        raise Infeasible("it falls over")
    return box((1, height, 1))
"""


@pytest.fixture
def plank(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "plank.py").write_text(PLANK.replace("SECONDS", "0.0"))
    return sw.load_procedure(tmp_path / "plank.py")


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def executor_in(folder):
    executor = submitit.AutoExecutor(folder, cluster="local")
    executor.update_parameters(timeout_min=5)
    return executor


def test_samples_are_those_of_this_machine(plank, tmp_path):
    with opened(ClusterName.parse("slurm:local:2")) as cluster:
        write_samples(plank, 60, tmp_path / "far", seed=4, executor=cluster)
    write_samples(plank, 60, tmp_path / "near", seed=4)
    assert contents(tmp_path / "far") == contents(tmp_path / "near")
    assert not list(tmp_path.glob(".shapewright-jobs-*"))


def test_a_job_that_is_killed_costs_its_chunk_alone(plank, tmp_path):
    (tmp_path / "plank.py").write_text(PLANK.replace("SECONDS", "0.2"))
    slow, killed = sw.load_procedure(tmp_path / "plank.py"), []
    executor = executor_in(tmp_path / "jobs")

    class Killing:
        """submitit's executor; the first of its jobs is killed while it builds."""

        batch = executor.batch

        def submit(self, function, *args):
            job = executor.submit(function, *args)
            if not killed:
                killed.append(job)
                threading.Thread(target=kill, args=[job]).start()
            return job

    def kill(job):
        time.sleep(3.0)  # a delayed job of a batch gets its process when the batch is closed
        process = job._process
        os.kill(process.pid, signal.SIGKILL)

    far = sw.sample(slow, 60, seed=4, executor=Cluster(Killing(), 2))
    near = sw.sample(plank, 60, seed=4)
    assert killed[0]._process.wait() == -signal.SIGKILL
    assert [(b.parameters, b.failure, b.shape and b.shape.vertices.tobytes()) for b in far] == [
        (b.parameters, b.failure, b.shape and b.shape.vertices.tobytes()) for b in near
    ]


@pytest.mark.timeout(900)
def test_a_fit_is_that_of_this_machine(plank, tmp_path):
    settings = sw.Settings(seed=1, samples=40, epochs=1, image_size=32, workers=2, refine_shapes=20)
    shapes = {f"{i}": plank(height=0.3 + 0.05 * i) for i in range(9)}
    references = sw.Collection.of({**shapes, "bar": box((1, 0.1, 0.1))})
    with opened(ClusterName.parse("slurm:local:2")) as cluster:
        far = sw.fit(plank, references, settings, executor=cluster)
    near = sw.fit(plank, references, settings)
    assert [(r.parameters, r.measured, r.replica.vertices.tobytes()) for r in far] == [
        (r.parameters, r.measured, r.replica.vertices.tobytes()) for r in near
    ]


def test_a_machine_without_slurm_is_told(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ExecutorError, match="run the command where sbatch is"), opened(ClusterName.parse("slurm:")):
        pass


def test_the_command_line_builds_in_jobs(plank, tmp_path):
    command = [sys.executable, "-m", "shapewright", "sample", "plank.py", "-n", "30", "--out", "far"]
    run = subprocess.run([*command, "--cluster", "slurm:local:2"], capture_output=True, text=True, timeout=200)
    assert run.returncode == 0, run.stderr
    write_samples(plank, 30, tmp_path / "near")
    assert contents(tmp_path / "far") == contents(tmp_path / "near")
