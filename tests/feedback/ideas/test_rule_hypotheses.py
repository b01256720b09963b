"""Which rules of the library are worth fitting to misfits."""

import numpy as np
import pytest

from shapewright.feedback.ideas.rule_hypotheses import _shared
from shapewright.rules.library import bundled_rules, kinds

RULES = {rule.name: rule for kind in kinds() for rule in bundled_rules(kind)}


def shared(*worths):
    return _shared(worths, RULES)


BACK = ("back",)


def test_a_rule_that_is_called_what_the_part_is_called_comes_first():
    both = {(BACK, "raised_lid"): 0.21, (BACK, "leaning_panel"): 0.2}
    assert shared(both, both) == [(BACK, "leaning_panel")]
    far = {(BACK, "raised_lid"): 0.4, (BACK, "leaning_panel"): 0.2}
    assert shared(far, far) == [(BACK, "raised_lid"), (BACK, "leaning_panel")]
    elsewhere = {(("seat",), "raised_lid"): 0.21, (("seat",), "leaning_panel"): 0.2}
    assert shared(elsewhere)[0] == (("seat",), "raised_lid")


def test_of_rules_that_bring_the_same_the_plainest_comes_first():
    foot = {(("foot",), name): 0.3 for name in ("compartments", "plinth", "block")}
    assert [name for _, name in shared(foot)] == ["block", "plinth", "compartments"]


def test_what_several_lack_is_worth_more_and_no_part_takes_all_places():
    several = [{((), "gable"): 0.1, (("roof",), "hip"): 0.25}, {((), "gable"): 0.1}]
    assert shared(*several) == [((), "gable"), (("roof",), "hip")]
    many = {(("body",), name): 0.5 for name in ("block", "round_block", "dome", "gable", "hip")}
    chosen = shared({**many, ((), "spire"): 0.1})
    assert len([key for key in chosen if key[0]]) == 3 and ((), "spire") in chosen


@pytest.mark.parametrize("name", ["block", "round_block", "tube", "bowed_panel"])
def test_forms_fill_their_box_and_are_sound(name):
    rule, size = RULES[name], np.array((0.7, 0.9, 0.2))
    ends = [{p.name: getattr(p, end) for p in rule.space} for end in ("low", "high")]
    for values in (rule.space.defaults, *ends):
        mesh = rule(tuple(size), **values).mesh()
        assert mesh.soundness().sound and mesh.bounds == pytest.approx(np.stack([-size, size]) / 2)
