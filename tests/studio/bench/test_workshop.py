"""The studio's builder with a procedure that is a program."""

import os
import threading
import time
from pathlib import Path

import pytest

from shapewright.processes import Limits
from shapewright.studio.bench.workshop import Workshop

pytestmark = pytest.mark.skipif(os.name != "posix", reason="the script is for a POSIX shell")
SPEC = """\
run = "sh tool.sh {out.obj} {width} {here}"
seconds = 60
[parameters]
width = { range = [1, 4], default = 2, description = "how wide it is" }
"""
SCRIPT = """\
case $2 in 4*) echo $$ > $3/busy; sleep 60 & wait;; esac
sleep 1.2
printf 'v 0 0 0\\nv %s 0 0\\nv 0 1 0\\nv 0 0 1\\nf 1 3 2\\nf 1 2 4\\nf 1 4 3\\nf 2 3 4\\n' $2 > "$1"
"""


@pytest.fixture
def workshop(tmp_path):
    (tmp_path / "spec.toml").write_text(SPEC)
    (tmp_path / "tool.sh").write_text(SCRIPT)
    made = Workshop()
    yield made
    made.close()


def test_a_program_has_the_time_that_its_spec_says(workshop, tmp_path):
    version = workshop.load(tmp_path / "spec.toml", Limits(seconds=0.2))
    assert (version.name, version.seconds) == ("spec", 60)
    assert [parameter.meaning for parameter in version.parameters] == ["how wide it is"]
    built = workshop.build({"width": 3.0})
    assert built.build.failure is None and built.build.shape.extent[0] == 3.0


def test_a_build_that_is_interrupted_ends_its_program(workshop, tmp_path):
    workshop.load(tmp_path / "spec.toml", Limits())
    busy = tmp_path / "busy"

    def interrupt():
        while not (busy.exists() and busy.read_text().strip()):
            time.sleep(0.02)
        workshop.interrupt.set()

    threading.Thread(target=interrupt, daemon=True).start()
    assert workshop.build({"width": 4.0}) is None
    program = Path(f"/proc/{busy.read_text().strip()}")
    deadline = time.monotonic() + 5.0
    while program.exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not program.exists()
    workshop.interrupt.clear()
    assert workshop.build({"width": 2.0}).build.shape is not None
