import os
import subprocess
import sys

import pytest

import shapewright as sw
from shapewright.building import Limits, Workers

SOURCE = """
import ctypes, logging, os, sys, time
from typing import Annotated, Literal
import numpy as np
from shapewright import Infeasible, Range, procedure

logging.basicConfig(level=logging.INFO)
print("the file is read")

@procedure
def part(
    size: Annotated[float, Range(0.5, 1.0)] = 0.7,
    then: Literal["built", "raises", "exits", "endless", "library", "infeasible", "much"] = "built",
):
    print(f"building {size=}")
    logging.info("union done")
    if then == "raises":
        raise ValueError("no solid")
    if then == "exits":
        os._exit(5)
    if then == "infeasible":
        raise Infeasible("too small")
    if then == "library":
        os.write(2, b"Fatal kernel error 77\\n")
        os.kill(os.getpid(), 11)
    if then == "much":
        print("x" * 3_000_000)
        raise ValueError("no solid")
    while then == "endless":
        time.sleep(0.01)
    return np.eye(3) * size, [[0, 1, 2]]
"""


@pytest.fixture
def part(tmp_path):
    path = tmp_path / "model.py"
    path.write_text(SOURCE)
    return sw.load_procedure(path)


def failures(procedure, *cases, workers=1):
    asked = [{"size": 0.5 + 0.01 * i, "then": then} for i, then in enumerate(cases)]
    with Workers(procedure, workers, Limits(seconds=0.5)) as crew:
        return [build.failure for build in crew.build(asked)]


@pytest.mark.parametrize("case", ["raises", "exits", "endless"])
def test_a_failure_tells_what_was_printed_for_its_own_shape_only(part, case):
    _, failed, _ = failures(part, "built", case, "built")
    assert "; it had printed: building size=0.51 | INFO:root:union done" in str(failed)
    assert "size=0.5 " not in str(failed) and "the file is read" not in str(failed)


def test_what_a_library_says_before_it_takes_the_process_down_is_kept(part):
    (failed,) = failures(part, "library")
    assert failed.kind == "crash" and failed.printed.endswith("Fatal kernel error 77")


def test_infeasible_shapes_and_long_prints_stay_short(part):
    infeasible, much = failures(part, "infeasible", "much")
    assert "printed" not in str(infeasible)
    assert len(str(much)) < 1000 and "; it had printed: xxx" in str(much)


def test_equal_failures_with_other_prints_are_one(part):
    one, other = failures(part, "exits", "exits")
    assert one == other and one.printed != other.printed


PROGRAM = """
import sys
import shapewright as sw
from shapewright.building import Workers
part = sw.load_procedure("model.py")
print("--", flush=True)
with Workers(part, 2, shown=bool(sys.argv[1:])) as crew:
    crew.build([{"size": 0.5 + i / 60, "then": "built"} for i in range(30)])
"""


def built_by_a_program(tmp_path, *arguments):
    (tmp_path / "model.py").write_text(SOURCE)
    (tmp_path / "program.py").write_text(PROGRAM)
    ran = subprocess.run(
        [sys.executable, "program.py", *arguments],
        cwd=tmp_path,
        env=os.environ,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert ran.returncode == 0, ran.stderr
    return ran.stdout.partition("--\n")[2] + ran.stderr


def test_nothing_that_a_procedure_prints_reaches_the_terminal_unless_it_is_wanted(tmp_path):
    assert built_by_a_program(tmp_path) == ""
    shown = built_by_a_program(tmp_path, "shown")
    assert shown.count("building size=") == 30 and shown.count("union done") >= 1
