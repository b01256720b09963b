"""The time limit of a shape, and what does not count."""

from __future__ import annotations

import contextlib
import importlib.util
import signal
import sys
import time
from pathlib import Path
from types import ModuleType

import pytest

from shapewright.building import Limits, Workers
from shapewright.building.clock import TimeLimit, time_limit
from shapewright.procedures import load_procedure
from shapewright.processes.resident import HELLO, Resident

pytestmark = pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs POSIX timers")

SLOW = (
    "import time\n\ndef compile():\n    end = time.monotonic() + 1.2\n    while time.monotonic() < end:\n        pass\n"
)
PROCEDURE = """
import sys
from pathlib import Path
from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box

sys.path.append(str(Path(__file__).parent / "numba"))
import slow_to_compile


@procedure
def part(size: Annotated[float, Range(0.5, 2.0)], endless: bool = False):
    slow_to_compile.compile()
    while endless:
        pass
    return box((size, 1, 1))
"""


@pytest.fixture
def compiler(tmp_path: Path) -> ModuleType:
    """A module of numba's, as far as its place tells."""
    path = tmp_path / "numba" / "slow_to_compile.py"
    path.parent.mkdir()
    path.write_text(SLOW)
    spec = importlib.util.spec_from_file_location("slow_to_compile", path)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_it_ends_what_takes_too_long() -> None:
    with pytest.raises(TimeLimit, match=r"longer than 0\.2 s"), time_limit(0.2):
        while True:
            time.sleep(0.01)


def test_an_except_of_the_author_lets_it_pass() -> None:
    def swallow() -> None:
        while True:
            with contextlib.suppress(Exception):
                time.sleep(0.01)

    with pytest.raises(TimeLimit), time_limit(0.2):
        swallow()


def test_nothing_happens_after_the_block() -> None:
    with time_limit(0.1):
        pass
    time.sleep(0.2)


def test_compiling_does_not_count(compiler: ModuleType) -> None:
    told: list[None] = []
    with time_limit(0.25, lambda: told.append(None)):
        compiler.compile()
    assert 20 <= len(told) <= 60
    with pytest.raises(TimeLimit), time_limit(0.25):
        compiler.compile()
        while True:
            time.sleep(0.01)


def test_shapes_that_compile_are_built_and_endless_ones_are_not(compiler: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    part = load_procedure(tmp_path / "procedure.py")
    with Workers(part, 1, Limits(seconds=0.4)) as crew:
        good, bad = crew.build([{"size": 1.0, "endless": False}, {"size": 1.0, "endless": True}])
    assert good.shape is not None
    assert bad.failure and bad.failure.kind == "time" and "procedure.py:16" in str(bad.failure)


def test_the_start_of_another_program_does_not_count_and_its_work_does():
    program = (
        "import struct, sys, time\ntime.sleep(0.8)\nsys.stdout.buffer.write("
        f"{HELLO!r} + struct.pack('>I', 14) + b'{{\"arrays\": []}}')\nsys.stdout.flush()\ntime.sleep(60)"
    )
    ticks = []
    with pytest.raises(TimeLimit), time_limit(0.3, lambda: ticks.append(1)):
        resident = Resident([sys.executable, "-c", program], {})
        assert ticks
        resident.ask({})
    assert not resident.alive
