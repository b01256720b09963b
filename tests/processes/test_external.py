"""Programs of others: what is kept of what they say, and that nothing of them is left running."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from shapewright.processes.external import Ended, run_program, words_of


def shell(script, folder, **limits):
    return run_program(["sh", "-c", script], folder, **limits)


def test_what_a_program_says_last_comes_first(tmp_path):
    ended = shell("echo fine; echo first >&2; echo second >&2; echo no such socket >&2; exit 3", tmp_path)
    assert ended == Ended(3, ("first", "second", "no such socket"))
    assert ended.last_words == "no such socket (before it: first | second)"


def test_a_program_that_is_silent_about_errors_is_quoted_from_its_output(tmp_path):
    assert shell("echo ERROR: no licence; exit 1", tmp_path).last_words == "ERROR: no licence"
    assert shell("exit 0", tmp_path) == Ended(0, ())


def test_it_runs_in_its_folder_with_its_variables(tmp_path):
    ended = shell('echo "$PWD $TOOL" >&2', tmp_path, environment={"TOOL": "saw"})
    assert ended.said == (f"{tmp_path.resolve()} saw",)


def test_of_very_much_that_is_said_the_end_is_kept(tmp_path):
    ended = shell("i=0; while [ $i -lt 3000 ]; do echo line $i >&2; i=$((i+1)); done", tmp_path)
    assert ended.said[-1] == "line 2999" and len(ended.said) < 3000


@pytest.mark.skipif(os.name != "posix", reason="sessions are POSIX")
def test_what_takes_too_long_ends_with_all_that_it_started(tmp_path):
    ended = shell("sleep 60 & echo $! > child; sleep 60", tmp_path, seconds=0.3)
    assert ended.status is None
    assert gone(int((tmp_path / "child").read_text()))


@pytest.mark.skipif(os.name != "posix", reason="sessions are POSIX")
def test_what_a_finished_program_left_running_is_ended(tmp_path):
    assert shell("sleep 60 & echo $! > child", tmp_path).status == 0
    assert gone(int((tmp_path / "child").read_text()))


@pytest.mark.skipif(os.name != "posix", reason="signals are POSIX")
def test_a_process_that_is_told_to_end_ends_its_program_first(tmp_path):
    program = (
        "from pathlib import Path\nfrom shapewright.processes.external import run_program\n"
        f"run_program(['sh', '-c', 'echo $$ > {tmp_path}/child; sleep 60'], Path({str(tmp_path)!r}))"
    )
    with subprocess.Popen([sys.executable, "-c", program]) as process:
        deadline = time.monotonic() + 30.0
        while not ((tmp_path / "child").exists() and (tmp_path / "child").read_text().strip()):
            assert time.monotonic() < deadline
            time.sleep(0.02)
        process.terminate()
        assert process.wait(10.0) == 128 + signal.SIGTERM
    assert gone(int((tmp_path / "child").read_text()))


@pytest.mark.skipif(sys.platform != "linux", reason="the limit of address space holds on Linux")
def test_memory_beyond_its_limit_is_refused_to_the_program(tmp_path):
    hungry = [sys.executable, "-c", "import time; time.sleep(0.1); b = bytearray(600 * 2**20)"]
    assert run_program(hungry, tmp_path).status == 0
    ended = run_program(hungry, tmp_path, memory_mb=400)
    assert ended.status == 1 and "MemoryError" in ended.last_words


@pytest.mark.skipif(sys.platform != "linux", reason="the limit of memory holds on Linux")
def test_the_limit_of_the_process_itself_is_not_its_programs_and_stays(tmp_path):
    inside = (
        "import resource, sys\nfrom pathlib import Path\nfrom shapewright.processes.external import run_program\n"
        "from shapewright.processes.limits import limit_memory\n"
        "limit_memory(300)\nbefore = resource.getrlimit(resource.RLIMIT_DATA)\n"
        "ended = run_program([sys.executable, '-c', 'b = bytearray(900 * 2**20)'], Path('.'))\n"
        "assert before == resource.getrlimit(resource.RLIMIT_DATA) and before[0] != before[1]\nsys.exit(ended.status)\n"
    )
    assert run_program([sys.executable, "-c", inside], tmp_path) == Ended(0, ())


def test_a_program_that_is_not_there_cannot_be_started(tmp_path):
    with pytest.raises(FileNotFoundError):
        run_program(["no-such-program"], tmp_path)


def test_a_status_in_words():
    assert words_of(2) == "exit status 2"
    assert words_of(-11) == "signal 11, SIGSEGV"


def gone(process):
    """Whether a process has ended; one that waits for its parent to notice has."""
    for _ in range(100):
        try:
            os.kill(process, 0)
            state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
        except (ProcessLookupError, FileNotFoundError):
            return True
        if state == "Z":
            return True
        time.sleep(0.02)
    return False
