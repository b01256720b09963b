"""Building through an executor: the same to the bit as here, whatever the chunks, the workers, and who dies."""

import os
import sys
import threading
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

import shapewright as sw
from shapewright.building import ExecutorError, Limits, Workers, executors
from shapewright.fitting.samples import write_samples
from shapewright.runs.folder import RunError

SOURCE = """
import os, time
from typing import Annotated, Literal
import numpy as np
from shapewright import Infeasible, Range, procedure
from beside import SCALE

@procedure
def part(
    size: Annotated[float, Range(0.5, 1.0)] = 0.7,
    fault: Literal["none", "infeasible", "raises", "killed", "endless"] = "none",
):
    if fault == "infeasible":
        raise Infeasible("it does not fit")
    if fault == "raises":
        return [][3]
    if fault == "killed":
        os.kill(os.getpid(), 9)
    if fault == "endless":
        time.sleep(100)
    return np.eye(3) * size * SCALE, [[0, 1, 2]]
"""
LIMITS = Limits(seconds=0.5, memory_mb=512)


@pytest.fixture
def part(tmp_path):
    (tmp_path / "model.py").write_text(SOURCE)
    (tmp_path / "beside.py").write_text("SCALE = 2.0\n")
    return sw.load_procedure(tmp_path / "model.py")


class AtOnce:
    """An executor that does the work when it is asked for it, and can lose it."""

    def __init__(self, losing=()):
        self.losing, self.asked = set(losing), 0

    def submit(self, function, *args):
        future = Future()
        self.asked += 1
        if self.asked in self.losing:
            future.set_exception(ConnectionError("the worker died"))
        else:
            future.set_result(function(*args))
        return future


def vectors(*faults):
    return [{"size": 0.5 + 0.002 * i, "fault": fault} for i, fault in enumerate(faults)]


def outcome(builds):
    return [(b.parameters, b.failure and (b.failure.kind, b.failure.place), b.shape and shape_bits(b)) for b in builds]


def shape_bits(build):
    return build.shape.vertices.tobytes(), build.shape.faces.tobytes()


ASKED = vectors(*["none"] * 20, "raises", *["none"] * 30, "killed", "infeasible", *["none"] * 90, "endless", "none")


@pytest.fixture
def here(part):
    with Workers(part, 2, LIMITS) as crew:
        return outcome(crew.build(ASKED))


@pytest.mark.parametrize("count", [1, 3])
@pytest.mark.parametrize("kind", ["threads", "forked", "spawned"])
def test_shapes_and_failures_are_those_that_are_built_here(part, here, kind, count):
    pools = {
        "threads": lambda: ThreadPoolExecutor(2),
        "forked": lambda: ProcessPoolExecutor(2, get_context("fork")),
        "spawned": lambda: ProcessPoolExecutor(2, get_context("spawn")),
    }
    told = []
    with pools[kind]() as executor, Workers(part, count, LIMITS, executor=executor) as crew:
        assert outcome(crew.build(ASKED, lambda done, total: told.append((done, total)))) == here
        again = crew.build(ASKED[:3], give_up=True)
        assert outcome(again) == here[:3] and len(crew.costs) >= len(ASKED)
        assert {Path(file.path).name for file in crew.opened} <= {"model.py", "beside.py"}
    assert told[-1] == (len(ASKED), len(ASKED)) and told == sorted(told)


def test_what_is_made_of_builds_is_made_where_they_are_built(part):
    with ProcessPoolExecutor(2, get_context("spawn")) as executor, Workers(part, 2, LIMITS, executor=executor) as crew:
        made = list(crew.make(ASKED[:60], process_and_size, give_up=True))
    with Workers(part, 2, LIMITS) as crew:
        here = list(crew.make(ASKED[:60], process_and_size, wave=7))
    assert [size for _, size in made] == [size for _, size in here]
    assert {process for process, _ in here} == {os.getpid()} != {process for process, _ in made[8:]}


def process_and_size(build):
    return os.getpid(), build.shape and float(build.shape.vertices.max())


def test_builders_are_kept_for_the_next_chunk_and_turn_to_another_procedure(part, tmp_path):
    with Workers(part, 1, LIMITS, executor=AtOnce()) as crew:
        first = crew.build(vectors(*["none"] * 10))
        assert len({build.process for build in first}) == 1
        (tmp_path / "other.py").write_text(SOURCE.replace("* SCALE", "* 3.0"))
        crew.turn_to(sw.load_procedure(tmp_path / "other.py"))
        second = crew.build(vectors("none"))
    assert second[0].process == first[0].process
    assert np.allclose(second[0].shape.vertices, 1.5 * first[0].shape.vertices)


def test_shapes_built_elsewhere_are_built_in_other_processes(part):
    with Workers(part, 1, LIMITS, executor=AtOnce()) as crew:
        first = crew.build(vectors("none", "none"))
        again = crew.elsewhere(first)
    assert outcome(again) == outcome(first) and not {b.process for b in again} & {b.process for b in first}


def test_a_chunk_that_was_lost_is_built_again_and_nothing_else_is(part, here):
    executor = AtOnce(losing=[2])
    with Workers(part, 1, LIMITS, executor=executor) as crew:
        assert outcome(crew.build(ASKED[:100])) == here[:100]
    assert executor.asked == 5  # four chunks of 25


def test_a_chunk_that_was_lost_twice_ends_it_with_both_reasons(part):
    executor = AtOnce(losing=[1, 5])
    reasons = "lost a chunk of shapes twice: ConnectionError: the worker died, then ConnectionError"
    with Workers(part, 1, LIMITS, executor=executor) as crew, pytest.raises(ExecutorError, match=reasons):
        crew.build(ASKED[:100])


def test_a_pool_that_is_broken_says_so(part):
    with ProcessPoolExecutor(1, get_context("spawn")) as executor:
        dead = executor.submit(os._exit, 1)
        assert dead.exception() is not None
        with (
            Workers(part, 1, LIMITS, executor=executor) as crew,
            pytest.raises(ExecutorError, match="BrokenProcessPool"),
        ):
            crew.build(ASKED[:4])


def test_a_procedure_that_fails_always_is_given_up_and_the_error_has_its_line(part):
    told = r"first 8 shapes failed: 8 x raised: .*model.py:16: IndexError"
    with Workers(part, 2, LIMITS, executor=AtOnce()) as crew, pytest.raises(sw.ProcedureError, match=told):
        crew.build(vectors(*["raises"] * 30), give_up=True)


def test_a_procedure_that_is_not_the_same_there_is_refused(part, tmp_path):
    with Workers(part, 1, LIMITS, executor=AtOnce()) as crew:
        crew.build(ASKED[:2])
        (tmp_path / "beside.py").write_text("SCALE = 4.0\n")
        with pytest.raises(
            sw.ProcedureError, match=r"model\.py: on .* this is another text, or it was edited meanwhile"
        ):
            crew.build(ASKED[:2])
        (tmp_path / "beside.py").unlink()
        with pytest.raises(
            sw.ProcedureError, match=r"beside\.py: no such file on .*; put the procedure's folder on a disk"
        ):
            crew.build(ASKED[:2])


def test_a_changed_copy_of_the_file_is_sent_whole(part, tmp_path):
    copy = tmp_path / "elsewhere" / "model.py"
    copy.parent.mkdir()
    copy.write_text(SOURCE.replace("* SCALE", "* 2.0 * SCALE"))
    (copy.parent / "beside.py").symlink_to(tmp_path / "beside.py")
    with Workers(part, 1, LIMITS, executor=AtOnce()) as crew:
        before = crew.build(vectors("none"))[0].shape.vertices
        crew.turn_to(sw.load_procedure(copy))
        for _ in range(2):  # the second time on a machine that does not see it
            assert np.allclose(crew.build(vectors("none"))[0].shape.vertices, 2.0 * before)
            copy.unlink(missing_ok=True)


def test_another_version_there_is_refused(part, monkeypatch):
    sent = executors.Sent.outward(part)
    monkeypatch.setattr("shapewright.building.sent.version_of", lambda _: "9.9")
    with pytest.raises(sw.ProcedureError, match=r"has shapewright 9\.9, and not .*: install the same version"):
        sent.arrived()


def test_a_procedure_of_a_script_crosses_by_value(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "from concurrent.futures import ThreadPoolExecutor\nfrom typing import Annotated\nimport numpy as np\n"
        "import shapewright as sw\n\n@sw.procedure\ndef mine(size: Annotated[float, sw.Range(0.5, 1.0)]):\n"
        "    return np.eye(3) * size, [[0, 1, 2]]\n\n"
        "with ThreadPoolExecutor(2) as executor:\n"
        "    far, near = sw.sample(mine, 9, executor=executor), sw.sample(mine, 9)\n"
        "print(all((f.shape.vertices == n.shape.vertices).all() for f, n in zip(far, near)))\n"
    )
    import subprocess

    ran = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=120)
    assert ran.stdout == "True\n" and not ran.stderr


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.parametrize("format", ["glb", "wds"])
def test_folders_of_samples_are_the_same_to_the_bit(tmp_path, format):
    (tmp_path / "plank.py").write_text(PLANK)
    plank = sw.load_procedure(tmp_path / "plank.py")
    with ThreadPoolExecutor(2) as executor:
        write_samples(plank, 40, tmp_path / "far", format, workers=3, executor=executor)
    write_samples(plank, 40, tmp_path / "near", format, workers=1)
    assert contents(tmp_path / "far") == contents(tmp_path / "near")


def test_a_folder_whose_cluster_was_lost_is_gone_on_with(tmp_path):
    (tmp_path / "plank.py").write_text(PLANK)
    plank = sw.load_procedure(tmp_path / "plank.py")
    gone = AtOnce(losing=range(12, 1000))
    with pytest.raises(
        RunError,
        match=r"far: the executor lost a chunk .*repeat the command to go on: the shapes in its manifest are whole",
    ):
        write_samples(plank, 400, tmp_path / "far", workers=10, executor=gone)
    write_samples(plank, 400, tmp_path / "far", workers=2)
    write_samples(plank, 400, tmp_path / "near", workers=2)
    assert contents(tmp_path / "far") == contents(tmp_path / "near")


def test_threads_are_not_left_behind(part):
    before = threading.active_count()
    with Workers(part, 1, LIMITS, executor=AtOnce()) as crew:
        crew.build(ASKED[:5])
    assert threading.active_count() <= before


PLANK = """
from typing import Annotated
from shapewright import Infeasible, Range, procedure
from shapewright.modelling.solids import box

@procedure
def plank(height: Annotated[float, Range(0.3, 0.8)] = 0.5, legs: Annotated[int, Range(1, 4)] = 4):
    if legs == 2:
        raise Infeasible("it falls over")
    return box((1, height, 1))
"""
