"""Programs that stay and answer: what they answer, how they end, and that none of them is left running."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from shapewright.processes.resident import HELLO, Gone, Resident

PROGRAM = f"""
import json, os, struct, sys, time
sys.stdout.write("Blender 4.5.0\\n"); sys.stdout.flush()
out, requests = sys.stdout.buffer, sys.stdin.buffer
out.write({HELLO!r})
while head := requests.read(4):
    request = json.loads(requests.read(struct.unpack(">I", head)[0]))
    if "end" in request:
        sys.stderr.write("first\\nno memory\\n")
        sys.stderr.flush()
        os.kill(os.getpid(), 11) if request["end"] == "crash" else sys.exit(request["end"])
    time.sleep(request.get("wait", 0))
    numbers = struct.pack("<6d", *range(6)) if "table" in request else b""
    arrays = [["table", "<f8", [3, 2]]] if numbers else []
    text = json.dumps({{"pid": os.getpid(), "arrays": arrays, **request}}).encode()
    out.write(struct.pack(">I", len(text)) + text + numbers)
    out.flush()
"""


@pytest.fixture
def resident():
    program = Resident([sys.executable, "-c", PROGRAM], {"open": "file"})
    yield program
    program.stop()


def test_it_answers_one_request_after_another_and_its_noise_before_is_no_answer(resident):
    assert resident.first.header["open"] == "file" and not resident.first.arrays
    pid = resident.ask({"a": "ü"}).header["pid"]
    assert resident.ask({"a": "ü"}).header == {"pid": pid, "a": "ü"}


def test_tables_come_as_they_are(resident):
    table = resident.ask({"table": True}).arrays["table"]
    assert np.array_equal(table, np.arange(6.0).reshape(3, 2))


def test_one_that_ends_tells_how_and_what_it_said_last(resident):
    with pytest.raises(Gone) as caught:
        resident.ask({"end": 3})
    assert (caught.value.ended.status, caught.value.ended.said) == (3, ("first", "no memory"))
    assert not resident.alive


@pytest.mark.skipif(os.name != "posix", reason="signals are POSIX")
def test_a_crash_has_the_signal(resident):
    with pytest.raises(Gone) as caught:
        resident.ask({"end": "crash"})
    assert caught.value.ended.status == -signal.SIGSEGV


def test_what_was_said_before_an_answer_is_forgotten(resident):
    assert resident.ask({"a": 1}).header["a"] == 1
    with pytest.raises(Gone) as caught:
        resident.ask({"end": 0})
    assert caught.value.ended.said == ("first", "no memory")


@pytest.mark.skipif(os.name != "posix", reason="signals are POSIX")
def test_whoever_breaks_off_the_wait_ends_it(resident):
    def late(*_):
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    with pytest.raises((TimeoutError, Gone)):
        resident.ask({"wait": 60})
    signal.signal(signal.SIGALRM, before)
    assert not resident.alive


def test_one_that_cannot_be_started_says_so():
    with pytest.raises(FileNotFoundError):
        Resident(["no-such-program"], {})
    with pytest.raises(Gone) as caught:
        Resident([sys.executable, "-c", "import no_such_module"], {})
    assert caught.value.ended.said[-1] == "ModuleNotFoundError: No module named 'no_such_module'"


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_it_ends_with_the_process_that_started_it():
    start = (
        "import sys, time\nfrom shapewright.processes.resident import Resident\n"
        f"print(Resident([sys.executable, '-c', {PROGRAM!r}], {{}}).first.header['pid'], flush=True)\ntime.sleep(60)"
    )
    with subprocess.Popen([sys.executable, "-c", start], stdout=subprocess.PIPE, text=True) as process:
        pid = int(process.stdout.readline())
        process.kill()
    deadline = time.monotonic() + 10.0
    while Path(f"/proc/{pid}").exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not Path(f"/proc/{pid}").exists()
