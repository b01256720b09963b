import pytest

import shapewright as sw
from shapewright.procedures.randomness import chances

FILE = """from typing import Annotated
from shapewright import Range, procedure
{imports}

@procedure
def rock(size: Annotated[float, Range(1.0, 2.0)] = 1.5):
    {line}
    return [[0, 0, 0], [size, 0, 0], [0, 1, 0]], [[0, 1, 2]]
"""
FOUND = [
    ("import numpy as np", "np.random.rand(3)", "random"),
    ("import numpy", "numpy.random.default_rng().normal()", "random"),
    ("import numpy.random as npr", "npr.shuffle([1])", "random"),
    ("from numpy import random as noise", "noise.standard_normal()", "random"),
    ("from numpy.random import default_rng as rng", "rng()", "random"),
    ("import random as dice", "dice.choice('ab')", "random"),
    ("from random import uniform", "uniform(0, 1)", "random"),
    ("import torch", "torch.randn(3)", "random"),
    ("import uuid", "uuid.uuid4()", "random"),
    ("import os", "os.urandom(4)", "random"),
    ("import secrets", "secrets.token_bytes()", "random"),
    ("from datetime import datetime", "datetime.now()", "moment"),
    ("import time", "time.perf_counter()", "moment"),
    ("", "id(size)", "moment"),
    ("", "[x for x in {'a', 'b'}]", "set"),
    ("", "[x for x in set('ab')]", "set"),
    ("NAMES = {'a', 'b'}", "[x for x in NAMES]", "set"),
]
NONE = [
    ("import numpy as np", "np.random.default_rng(3).normal()"),
    ("import numpy as np", "np.random.RandomState(seed=3)"),
    ("import random", "random.Random(7).random()"),
    ("import random", "random.seed(7)"),
    ("import time", "time.sleep(0)"),
    ("", "[x for x in sorted({'a', 'b'})]"),
    ("def uniform(a, b): return a", "uniform(0, 1)"),
]


def procedure_of(tmp_path, imports, line, name="rock.py"):
    path = tmp_path / name
    path.write_text(FILE.format(imports=imports, line=line))
    return path


def test_helpers_are_read_and_a_function_without_a_file_has_its_own_line(tmp_path):
    (tmp_path / "noise.py").write_text("import random\n\ndef noise():\n    return random.random()\n")
    path = procedure_of(tmp_path, "from noise import noise", "noise()")
    (chance,) = chances(sw.load_procedure(path))
    assert chance.place.file.endswith("noise.py") and chance.place.line == 4 and "random.random" in chance.says

    @sw.procedure
    def rock(round: bool = False):
        import random

        return random.random()

    (chance,) = chances(rock)
    assert chance.place.file == __file__ and chance.place.text == "return random.random()"


@pytest.mark.parametrize(("imports", "line", "kind"), FOUND)
def test_a_line_that_may_differ_from_call_to_call_is_found(tmp_path, imports, line, kind):
    path = procedure_of(tmp_path, imports, line)
    chance = chances(sw.load_procedure(path))[0]
    assert chance.kind == kind and chance.place.text == line
    assert chance.place.line == path.read_text().splitlines().index(f"    {line}") + 1


@pytest.mark.parametrize(("imports", "line"), NONE)
def test_what_has_a_seed_or_an_order_is_none(tmp_path, imports, line):
    assert chances(sw.load_procedure(procedure_of(tmp_path, imports, line))) == []


def test_rands_of_openscad_without_a_seed_is_found(tmp_path, monkeypatch):
    monkeypatch.setattr("shapewright.procedures.openscad.reading._check", lambda path, stamp: None)
    file = tmp_path / "rock.scad"
    file.write_text(
        "w = 4; // [1:9] rands(0, 1, 1)\na = rands(0, max(w, 1),\n 2);\nb = rands(0, w, 2, 42);\ncube(a[0]);"
    )
    (chance,) = chances(sw.load_procedure(file))
    assert (chance.kind, chance.place.line, chance.says) == ("random", 2, "rands draws without a seed")
