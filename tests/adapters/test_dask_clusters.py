"""A real dask cluster, a scheduler and two workers as processes: what goes through it is what this machine finds."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest

import shapewright as sw
from shapewright.building import ExecutorError, Workers
from shapewright.building.clusters import ClusterName, opened
from shapewright.feedback.explanation import explain
from shapewright.feedback.record import record_of
from shapewright.fitting.samples import write_samples
from shapewright.modelling.solids import box
from shapewright.runs.folder import RunError
from shapewright.shapes.files import obj

distributed = pytest.importorskip("distributed", reason="needs the extra dask; run `make test-adapters`")

PLANK = """
import os, time
DEADLY = 0.0
from typing import Annotated
from shapewright import Infeasible, Range, procedure
from shapewright.modelling.solids import box

@procedure
def plank(height: Annotated[float, Range(0.3, 0.8)] = 0.5, legs: Annotated[int, Range(1, 5)] = 4):
    time.sleep(0.01)
    if legs == 2:
        raise Infeasible("it falls over")
    if legs == 5 and 0.5 < height < DEADLY:
        os._exit(3)
    return box((1, height, 1)) if legs == 1 else box((1, 0.1, 1), at=(0, height, 0)) | box((0.2, height, 0.2))
"""
SETTINGS = sw.Settings(seed=1, samples=60, epochs=1, image_size=32, workers=2, refine_shapes=40)


class Processes:
    """A scheduler and two workers."""

    def __init__(self, folder):
        self.folder, self.started = folder, []
        self.scheduler = self.start("dask_scheduler", "--port", "0", "--host", "127.0.0.1", "--no-dashboard")
        self.address = f"tcp://{self.said('Scheduler at:').rpartition('tcp://')[2]}"
        self.workers = [self.worker(), self.worker()]

    def start(self, program, *arguments):
        log = (self.folder / f"{len(self.started)}.log").open("w")
        command = [sys.executable, "-m", f"distributed.cli.{program}", *arguments]
        self.started.append(subprocess.Popen(command, cwd=self.folder, stdout=log, stderr=log))
        return self.started[-1]

    def worker(self):
        return self.start("dask_worker", self.address, "--nthreads", "1", "--no-nanny", "--no-dashboard")

    def said(self, words):
        for _ in range(600):
            for line in (self.folder / "0.log").read_text().splitlines():
                if words in line:
                    return line.split()[-1]
            time.sleep(0.1)
        raise TimeoutError((self.folder / "0.log").read_text())

    def client(self):
        client = distributed.Client(self.address)
        client.wait_for_workers(len(self.workers), timeout=60)
        return client

    def end(self):
        for process in self.started:
            process.kill()
            process.wait()


@pytest.fixture
def cluster(tmp_path):
    (tmp_path / "cluster").mkdir()
    processes = Processes(tmp_path / "cluster")
    yield processes
    processes.end()


@pytest.fixture
def plank(tmp_path):
    (tmp_path / "plank.py").write_text(PLANK)
    return sw.load_procedure(tmp_path / "plank.py")


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def outcome(builds):
    return [(b.parameters, b.failure, b.shape and b.shape.vertices.tobytes()) for b in builds]


def test_samples_are_those_of_this_machine(cluster, tmp_path):
    (tmp_path / "plank.py").write_text(PLANK.replace("DEADLY = 0.0", "DEADLY = 0.55"))
    plank = sw.load_procedure(tmp_path / "plank.py")
    with cluster.client() as client:
        executor = client.get_executor()
        far = sw.sample(plank, 80, seed=4, workers=2, executor=executor)
        write_samples(plank, 80, tmp_path / "far", seed=4, executor=executor)
    assert outcome(far) == outcome(sw.sample(plank, 80, seed=4))
    write_samples(plank, 80, tmp_path / "near", seed=4)
    assert contents(tmp_path / "far") == contents(tmp_path / "near")
    assert {b.failure.kind for b in far if b.failure} == {"infeasible", "crash"}


def test_a_worker_that_is_killed_in_the_middle_costs_its_chunk_alone(cluster, plank, tmp_path):
    killed = threading.Event()

    def kill(done, total):
        if done >= 40 and not killed.is_set():
            killed.set()
            os.kill(cluster.workers[0].pid, signal.SIGKILL)

    with cluster.client() as client:
        write_samples(plank, 160, tmp_path / "far", workers=2, progress=kill, executor=client.get_executor())
    assert killed.is_set() and cluster.workers[0].wait() == -signal.SIGKILL
    write_samples(plank, 160, tmp_path / "near")
    assert contents(tmp_path / "far") == contents(tmp_path / "near")


def test_a_scheduler_that_is_killed_ends_with_a_clear_error_and_the_command_goes_on(cluster, plank, tmp_path):
    def kill(done, total):
        if done >= 300 and cluster.scheduler.poll() is None:
            os.kill(cluster.scheduler.pid, signal.SIGKILL)
            cluster.scheduler.wait()

    with distributed.Client(cluster.address, timeout=3) as client:
        client.wait_for_workers(2, timeout=60)
        with pytest.raises(
            RunError, match=r"far: the executor .*repeat the command to go on: the shapes in its manifest are whole"
        ):
            write_samples(plank, 600, tmp_path / "far", workers=2, progress=kill, executor=client.get_executor())
    assert (tmp_path / "far" / "manifest.csv").read_text().count("\n") > 200
    told = []
    write_samples(plank, 600, tmp_path / "far", progress=lambda done, _: told.append(done))
    assert told[0] >= 200
    write_samples(plank, 600, tmp_path / "near")
    assert contents(tmp_path / "far") == contents(tmp_path / "near")


def test_the_first_shapes_are_built_again_although_the_call_is_the_same(cluster, plank):
    with cluster.client() as client, Workers(plank, 2, executor=client.get_executor(pure=True)) as crew:
        first = crew.build([plank.space.defaults])
        assert crew.elsewhere(first)[0].process != first[0].process != crew.elsewhere(first)[0].process


def test_an_address_without_a_scheduler_is_told(monkeypatch):
    monkeypatch.setattr("shapewright.building.clusters._PATIENCE", 1.0)
    with (
        pytest.raises(ExecutorError, match=r"dask:tcp://127\.0\.0\.1:1: no scheduler with workers answers there"),
        opened(ClusterName.parse("dask:tcp://127.0.0.1:1")),
    ):
        pass


def shapewright(*arguments, cwd):
    command = [sys.executable, "-m", "shapewright", *map(str, arguments)]
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=200)


def test_the_command_line_builds_on_a_cluster_and_on_one_of_this_machine(cluster, plank, tmp_path):
    for out, name in (("far", f"dask:{cluster.address}"), ("local", "dask:local:2")):
        run = shapewright("sample", "plank.py", "-n", 60, "--out", out, "--cluster", name, cwd=tmp_path)
        assert run.returncode == 0, run.stderr
        assert not [line for line in run.stderr.splitlines() if "distributed" in line]
    assert shapewright("sample", "plank.py", "-n", 60, "--out", "near", cwd=tmp_path).returncode == 0
    assert contents(tmp_path / "far") == contents(tmp_path / "near") == contents(tmp_path / "local")


@pytest.fixture
def references(plank):
    made = {f"{legs} of {height}": plank(height=height, legs=legs) for legs in (1, 3) for height in (0.35, 0.75)}
    return sw.Collection.of({**made, "bar": box((1, 0.1, 0.1)), "post": box((0.1, 1, 0.1))})


def found(iteration):
    return [
        (r.parameters, r.grade, r.group, repr(r.measured), r.replica and r.replica.vertices.tobytes())
        for r in iteration
    ]


def said(explanation):
    return {key: value for key, value in record_of(explanation).items() if key != "seconds"}


def test_a_fit_and_its_explanation_are_those_of_this_machine_although_a_worker_is_killed(
    cluster, plank, references, monkeypatch
):
    monkeypatch.setattr("shapewright.feedback.causes.better_replicas.EVALUATIONS", 200)

    def kill(event):
        if event.stage == "refine" and event.done and cluster.workers[0].poll() is None:
            os.kill(cluster.workers[0].pid, signal.SIGKILL)
            cluster.workers[0].wait()

    near = sw.fit(plank, references, SETTINGS)
    with cluster.client() as client:
        executor = client.get_executor(pure=False)
        far = sw.fit(plank, references, SETTINGS, progress=kill, executor=executor)
        why = explain(near, plank, references, suggest=False, executor=executor)
    assert cluster.workers[0].poll() == -signal.SIGKILL
    assert found(far) == found(near) and far.groups == near.groups
    assert said(why) == said(explain(near, plank, references, suggest=False))


def test_a_fit_whose_scheduler_is_killed_says_what_to_do(cluster, plank, references):
    def kill(event):
        if event.stage == "describe" and cluster.scheduler.poll() is None:
            os.kill(cluster.scheduler.pid, signal.SIGKILL)
            cluster.scheduler.wait()

    with distributed.Client(cluster.address, timeout=3) as client:
        client.wait_for_workers(2, timeout=60)
        with pytest.raises(ExecutorError, match=r"see that the cluster runs, .* then repeat the command"):
            sw.fit(plank, references, SETTINGS, progress=kill, executor=client.get_executor(pure=False))


def test_the_command_line_fits_evaluates_and_explains_on_a_cluster(cluster, plank, references, tmp_path):
    (tmp_path / "refs").mkdir()
    for reference in references:
        (tmp_path / "refs" / f"{reference.name}.obj").write_bytes(obj(reference.shape))
    name = f"dask:{cluster.address}"
    few = ("--samples", 60, "--epochs", 1, "--refine", "off", "--workers", 2)
    for out, more in (("far", ["--cluster", name]), ("near", [])):
        run = shapewright("fit", "plank.py", "refs", "--out", out, *few, *more, cwd=tmp_path)
        assert run.returncode == 0, run.stderr
    runs = [sw.Iteration.load(tmp_path / out) for out in ("far", "near")]
    assert found(runs[0]) == found(runs[1])
    measured = shapewright("evaluate", "plank.py", *few, "--refined", 2, "--cluster", name, cwd=tmp_path)
    assert measured.returncode == 0, measured.stderr
    told = shapewright("explain", "far", "--no-suggestions", "--cluster", name, cwd=tmp_path)
    assert told.returncode == 0, told.stderr
