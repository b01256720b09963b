import os
import time

import numpy as np
import pytest

from shapewright.processes import Limits, Loss
from shapewright.processes.calls import Calls

LIMITS = Limits(seconds=0.5, memory_mb=256)
FAULTS = {"ends": "crash", "killed": "crash", "raises": "crash", "sleeps": "time", "eats": "memory"}


def answer(question):
    """Called in the worker, which finds it because the tests' folder is on its path."""
    match question if isinstance(question, str) else "":
        case "ends":
            os._exit(3)
        case "killed":
            os.kill(os.getpid(), 9)
        case "raises":
            raise ValueError("never handed on")
        case "sleeps":
            time.sleep(60)
        case "eats":
            return np.ones(2**30)
        case "which":
            return os.getpid()
    return question * 2


@pytest.fixture(autouse=True)
def found(monkeypatch):
    here = os.path.dirname(__file__)  # noqa: PTH120
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([here, os.environ.get("PYTHONPATH", "")]))


def test_a_call_that_goes_wrong_costs_its_own_result_only():
    asked = [1, "ends", 2, "sleeps", 3, "killed", "eats", 4, "raises", 5]
    with Calls(answer, 2) as calls:
        results = calls.results([(question, LIMITS) for question in asked])
    for question, result in zip(asked, results, strict=True):
        if question in FAULTS:
            assert isinstance(result, Loss) and result.kind == FAULTS[question]
        else:
            assert result == 2 * question
    told = [result.message for result in results if isinstance(result, Loss)]
    assert told == [
        "it ended its process (exit status 3)",
        "it took longer than 0.5 s",
        "it killed its process (signal 9)",
        "it needed more than 256 MB of memory",
        "it ended its process (exit status 1)",
    ]


def test_the_processes_stay_between_calls_and_end_with_the_block():
    with Calls(answer, 1) as calls:
        (first,) = calls.results([("which", LIMITS)])
        (second,) = calls.results([("which", LIMITS)])
        (process,) = [caller._worker.process for caller in calls._pool.idle]
    assert first == second == process.pid
    assert process.poll() is not None


def test_large_arrays_come_back_as_they_are():
    array = np.arange(10**6, dtype=np.float64)
    with Calls(answer, 1) as calls:
        (result,) = calls.results([(array, LIMITS)])
    assert (result == 2 * array).all() and result.flags.writeable


def test_what_ends_a_process_is_called_once_more_in_a_new_one(tmp_path):
    """A file that is there says that the first call went before."""
    mark = tmp_path / "mark"
    with Calls(ends_first_time, 1) as calls:
        results = calls.results([(None, LIMITS), (str(mark), LIMITS)])
    assert results == ["ready", "second time"]


def ends_first_time(mark):
    if mark is None:
        return "ready"
    if not os.path.exists(mark):  # noqa: PTH110
        open(mark, "w").close()  # noqa: PTH123
        os._exit(1)
    return "second time"


def test_an_interrupt_ends_what_is_under_way():
    with Calls(answer, 1) as calls:
        calls.results([(1, LIMITS)])
        (process,) = [caller._worker.process for caller in calls._pool.idle]

        def interrupt():
            raise KeyboardInterrupt

        calls._pool.run, run = lambda tasks, serve, most: run(tasks, serve, interrupt, most), calls._pool.run
        with pytest.raises(KeyboardInterrupt):
            calls.results([("sleeps", Limits(seconds=60.0))])
    assert process.poll() is not None
