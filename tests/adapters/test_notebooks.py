"""Procedures in the cells of a notebook, with the real IPython: built in worker processes, edited and run again."""

import json
import subprocess
import sys

import pytest

pytest.importorskip("IPython", reason="needs IPython; run `make test-adapters`")

KERNEL = """
import json, sys
from IPython.core.interactiveshell import InteractiveShell
shell = InteractiveShell.instance()
for cell in json.load(open("cells.json")):
    result = shell.run_cell(cell, store_history=True)
    if not result.success:
        sys.exit(str(result.error_before_exec or result.error_in_exec))
"""
FIRST = """
from pathlib import Path
from typing import Annotated
import shapewright as sw
from shapewright import Range
from shapewright.building import Workers
from shapewright.modelling.solids import box

def sizes():
    return [float(word) for word in Path("sizes.csv").read_text().split(",")]
"""
HELPER = "FACTOR = {factor}\ndef depth(width):\n    return FACTOR * width\n"
PROCEDURE = """
@sw.procedure
def part(width: Annotated[float, Range(1.0, 2.0)] = 1.5):
    if width < 0:
        raise ValueError("negative")
    return box((width, sizes()[0], depth(width)))
"""
BUILD = """
with Workers(part, 2) as crew:
    shapes = [build.shape for build in crew.build(part.space.sample(6, seed=0), give_up=True)]
    failed = crew.build([{"width": -1.0}])[0].failure
print("DEPTH", sorted({round(float(s.extent[2] / s.extent[0]), 6) for s in shapes}), shapes[0].extent[1])
print("FAILED", failed.place.line, failed.place.text, part.digest)
"""


def test_cells_are_sent_to_the_workers_and_an_edit_counts(tmp_path):
    (tmp_path / "sizes.csv").write_text("0.25,3")
    edited = PROCEDURE.replace("box((", "box((2 * ").replace("    if width", "    # edited\n    if width")
    cells = [FIRST, HELPER.format(factor=0.5), PROCEDURE, BUILD, HELPER.format(factor=0.75), BUILD, edited, BUILD]
    (tmp_path / "cells.json").write_text(json.dumps(cells))
    (tmp_path / "kernel.py").write_text(KERNEL)
    ran = subprocess.run([sys.executable, "kernel.py"], cwd=tmp_path, capture_output=True, text=True, timeout=200)
    assert ran.returncode == 0, ran.stderr + ran.stdout
    lines = [line.split(" ", 1)[1] for line in ran.stdout.splitlines() if line.startswith(("DEPTH", "FAILED"))]
    assert lines[0::2] == ["[0.5] 0.25", "[0.75] 0.25", "[0.375] 0.25"]
    places = [line.rsplit(" ", 1) for line in lines[1::2]]
    assert [place for place, _ in places] == [f'{line} raise ValueError("negative")' for line in (4, 4, 5)]
    assert places[0][1] == places[1][1] != places[2][1], "the digest is that of the cell"
