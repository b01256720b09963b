from functools import partial

import numpy as np
import pytest

import shapewright as sw
from shapewright.feedback.parts.pieces import Piece
from shapewright.feedback.writing.edit import with_rule
from shapewright.feedback.writing.rule_code import addition
from shapewright.feedback.writing.rule_text import rule_text
from shapewright.feedback.writing.source import free_name
from shapewright.rules.library import bundled_rules, kinds, rules_in

RULES = [rule for kind in kinds() for rule in bundled_rules(kind)]
VASE = """from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box


@procedure
def vase(height: Annotated[float, Range(0.4, 2.0)] = 1.0):
    return box((1, height, 1)).label("body")
"""
OWN = """from math import pi
from typing import Annotated

from shapewright import Range, rule
from shapewright.modelling.solids import box, cylinder

THIN = 0.5 / pi


def stick(size, share):
    return cylinder((THIN * size[0], size[1], share * size[2]))


def unused():
    return box(1)


@rule("under", turns=2)
def bar(size, share: Annotated[float, Range(0.1, 0.9)] = 0.5):
    \"\"\"A bar.\"\"\"
    return stick(size, share).fit(size)
"""


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.name)
def test_the_text_of_a_rule_is_plain_code_that_makes_the_same(rule):
    text = rule_text(rule)
    imports = "\n".join(f"from {module} import {', '.join(names)}" for module, names in text.imports.items())
    made: dict = {}
    exec(f"{imports}\n{text.functions}", made)
    assert "@rule" not in text.functions and "Annotated" not in text.functions
    assert made[rule.name]((1, 2, 0.5)).volume == rule((1, 2, 0.5)).volume


def test_it_brings_what_it_needs_of_its_file_and_no_more(tmp_path):
    (tmp_path / "own.py").write_text(OWN)
    (bar,) = rules_in(tmp_path / "own.py")
    text = rule_text(bar)
    assert "THIN = 0.5 / pi" in text.functions and "def stick(size, share):" in text.functions
    assert "def bar(size, share=0.5):" in text.functions and "unused" not in text.functions
    assert text.imports == {"math": ("pi",), "shapewright.modelling.solids": ("cylinder",)}


def test_a_suggested_rule_loads_and_is_written_once(tmp_path):
    (ring,) = [rule for rule in RULES if rule.name == "half_ring"]
    low, high = (0.5, -0.3, -0.1), (0.8, 0.3, 0.1)
    piece = Piece("rule", np.array(low), np.array(high), rule=ring, arguments=ring.space.defaults)
    frames = {"": np.array([(-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)])}
    source = VASE
    for turn in range(2):
        draft = addition([[piece]], [frames], (), None, [""], partial(free_name, source, "vase"), "A ring.")
        ranges = {
            q.name: (*(q.limits or (q.values[0] - 0.1, q.values[0] + 0.1)), q.values[0]) for q in draft.quantities
        }
        source = with_rule(source, "vase", draft.spelled(ranges))
        assert source.count("def half_ring(") == 1
        path = tmp_path / f"vase_{turn}.py"
        path.write_text(source)
        changed = sw.load_procedure(path)
        assert changed(height=1.0).bounds.tolist() == [[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]]
        on = {draft.flag: True} | {q.name: q.values[0] for q in draft.quantities}
        assert abs(changed(height=1.0, **on).bounds[1, 0] - 0.8) < 0.01
