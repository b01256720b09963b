"""What people who have a generator meet first: samples of one that prints, that builds nothing, that is slow."""

import os
import subprocess
import sys

import pytest

HEAD = """
import logging, time
from typing import Annotated
import trimesh
from shapewright import Range, procedure
logging.basicConfig(level=logging.INFO)

@procedure
def block(w: Annotated[float, Range(1, 2)] = 1.5, h: Annotated[float, Range(1, 2)] = 1.5):
"""
PRINTS = '    print(f"building {w=}")\n    logging.info("union done")\n'
BOX = "    return trimesh.creation.box((w, h, 1))\n"


def run(folder, body, *arguments, command="sample"):
    (folder / "p.py").write_text(HEAD + body)
    environment = {**os.environ, "SHAPEWRIGHT_CACHE": str(folder / "cache")}
    call = [sys.executable, "-m", "shapewright", command, "p.py", *arguments]
    return subprocess.run(call, cwd=folder, capture_output=True, text=True, timeout=200, env=environment)


@pytest.mark.parametrize("verbose", [False, True])
def test_what_is_printed_is_shown_where_it_is_wanted_alone(tmp_path, verbose):
    ran = run(tmp_path, PRINTS + BOX, "-n", "5", "--out", "o", *(["--verbose"] if verbose else []))
    assert ran.returncode == 0 and "5 shapes" in ran.stdout
    assert ran.stderr.count("building w=") == ran.stderr.count("union done") == (5 if verbose else 0)


def test_samples_of_which_none_can_be_built_end_early_with_the_line_and_what_was_printed(tmp_path):
    ran = run(tmp_path, PRINTS + "    raise ValueError('no solid')\n", "-n", "500", "--out", "o")
    assert ran.returncode == 1 and "every one of the first 8 shapes failed" in ran.stderr
    words = " ".join(ran.stderr.split())
    assert "p.py:12: ValueError: no solid" in words and "it had printed: building w=" in words and "union done" in words


def test_a_data_file_beside_the_procedure_is_found_by_its_place_and_by_the_working_folder(tmp_path):
    (tmp_path / "depth.txt").write_text("0.5")
    body = "    from pathlib import Path\n    own = float(Path(__file__).with_name('depth.txt').read_text())\n"
    body += "    here = float(open('depth.txt').read())\n    return trimesh.creation.box((w, own, here))\n"
    assert run(tmp_path, body, "-n", "2", "--out", "o").returncode == 0


REFERENCE = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 3 4\n"
LISTENING = """
import os, sys
from shapewright.cli import bars, main

def tell(notice):
    print(notice.kind, "torch" in sys.modules, "numba" in sys.modules, flush=True)
    os._exit(0)

bars._print_notice = tell
main.main()
"""


def test_the_first_word_of_a_fit_comes_before_torch_is_loaded(tmp_path):
    (tmp_path / "refs").mkdir()
    (tmp_path / "refs" / "a.obj").write_text(REFERENCE)
    (tmp_path / "p.py").write_text(HEAD + "    time.sleep(0.1)\n" + BOX)
    call = [sys.executable, "-c", LISTENING, "fit", "p.py", "refs", "--workers", "2", "--out", "r"]
    ran = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, timeout=200)
    kind, *loaded = ran.stdout.split()
    assert kind in ("pace", "waiting") and loaded == ["False", "False"], ran.stderr  # a busy machine says that it waits


def test_a_fit_of_a_slow_procedure_says_what_it_costs_and_lasts_as_long_as_it_may(tmp_path):
    (tmp_path / "refs").mkdir()
    (tmp_path / "refs" / "a.obj").write_text(REFERENCE)
    slow = "    time.sleep(0.1)\n" + BOX
    ran = run(tmp_path, slow, "refs", "--within", "6s", "--epochs", "1", "--workers", "2", "--out", "r", command="fit")
    assert ran.returncode == 0, ran.stderr
    assert "one shape takes 0.1 s: " in ran.stderr and " fit in 6 s" in ran.stderr
