import itertools

import numpy as np
import pytest

from shapewright.rules.library import bundled_rules, kinds

SIZES = [(1.0, 1.0, 1.0), (0.6, 1.4, 0.5), (1.5, 0.2, 0.8)]


@pytest.mark.parametrize("rule", [rule for kind in kinds() for rule in bundled_rules(kind)], ids=lambda rule: rule.name)
def test_a_rule_fills_its_box_with_a_sound_solid(rule):
    drawn = [rule.space.defaults, *(rule.space.sample(4, seed=0) if len(rule.space) else ())]
    for size, arguments in itertools.product(SIZES, drawn):
        mesh = rule(size, **arguments).mesh()
        assert mesh.soundness().sound, (size, arguments)
        assert np.abs(mesh.bounds - np.array([[-0.5], [0.5]]) * size).max() < 3e-3 * max(size), (size, arguments)
