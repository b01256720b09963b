import math
from typing import Annotated

import numpy as np
import pytest
import shapely

import shapewright as sw
from shapewright.judging.judge import Judge, target_of
from shapewright.modelling.solids import box
from shapewright.search.sizes import SizedObjective, likeness, parts_with_size

SLAB = box((100.0, 50.0, 80.0)).mesh()
CARD = sw.Drawing(shapely.box(0, 0, 100, 50))


@pytest.mark.parametrize("shape", [SLAB, CARD], ids=["mesh", "drawing"])
def test_every_part_of_a_residual_has_the_size_before_it(shape):
    target = target_of(shape.normalised(), sw.Settings())
    sized = SizedObjective(target.objective(0), 200.0, target.parts)
    residual, form = sized.residual(shape), target.objective(0).residual(shape)
    parts = parts_with_size(target.parts)
    assert len(parts) == len(target.parts)
    for part, old in zip(parts, target.parts, strict=True):
        assert residual[part][0] == residual[0] < 0.0
        assert np.array_equal(residual[part][1:], form[old])
    assert sum(len(residual[part]) for part in parts) == len(residual)
    right = SizedObjective(target.objective(0), 100.0, target.parts)
    assert abs(right.residual(shape)).sum() == pytest.approx(abs(form).sum())


def test_a_size_costs_as_much_as_a_side_that_is_off_by_as_much():
    objective = target_of(SLAB.normalised(), sw.Settings()).objective(0)
    side = np.abs(objective.residual(box((100.0, 50.5, 80.0)).mesh())).sum()
    size = np.abs(SizedObjective(objective, 100.0, (slice(None),)).residual(box((101, 50.5, 80.8)).mesh())).sum()
    assert 0.5 < size / side < 3.0


def test_the_likeness_of_sizes_falls_evenly_and_alike_both_ways():
    values = [likeness(SLAB, 100.0 * factor) for factor in (1.0, 1.01, 1.05, 1.1, 1.2, 2.0)]
    assert values == sorted(values, reverse=True)
    assert values[0] == 1.0 and values[1] > 0.999 and values[2] > 0.9 and values[4] < 0.1
    assert likeness(SLAB, 110.0) == pytest.approx(likeness(SLAB, 100.0 / 1.1))
    assert likeness(None, 3.0) == 1.0


def test_a_judge_of_sized_references_wants_the_size_and_else_not():
    references = sw.Collection.of({"slab": SLAB})
    large = [sw.sample(slab, 1)[0]]
    relative = Judge.of(references, sw.Settings(workers=1))
    given = Judge.of(references.sized(), sw.Settings(workers=1))
    shape = large[0].shape
    off = abs(math.log(shape.extent.max() / 100.0))
    assert off > 0.2
    assert given.fidelities([shape])[0] < 0.1 * relative.fidelities([shape])[0]
    assert given.evidence(large)[0].value == pytest.approx(given.fidelities([shape])[0], abs=1e-6)
    measured = given.measures(large, given.distances(large))[0]
    assert measured.fidelity == pytest.approx(given.fidelities([shape])[0], abs=1e-6)


@sw.procedure
def slab(length: Annotated[float, sw.Range(140.0, 160.0)] = 150.0):
    return box((length, length / 2, 0.8 * length))
