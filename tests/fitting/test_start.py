from types import SimpleNamespace
from typing import Annotated

import pytest

import shapewright as sw
from shapewright import Range
from shapewright.building import Workers
from shapewright.fitting.replicas import Replicas, resume
from shapewright.fitting.start import Start
from shapewright.judging.judge import Judge
from shapewright.modelling.solids import box


@sw.procedure
def slab(width: Annotated[float, Range(0.2, 1.0)] = 0.5, depth: Annotated[float, Range(0.5, 2.0)] = 1.0):
    return box((width, 0.3, depth))


REFERENCES = sw.Collection.of({"wide": slab(width=0.9, depth=1.2), "thin": slab(width=0.3, depth=0.8)})


class Earlier(list):
    """As much of an iteration as a start reads: the space had another Range of width, and no depth."""

    def __init__(self, refine):
        super().__init__(
            [SimpleNamespace(name="wide", parameters={"width": 0.9}), SimpleNamespace(name="x", parameters={})]
        )
        old = SimpleNamespace(parameters=(slab.space["width"],))
        self.predictor, self.settings = SimpleNamespace(space=old), sw.Settings(refine=refine)


def test_without_an_earlier_iteration_nothing_is_known():
    start = Start.of(REFERENCES, slab.space, None)
    assert (start.resumed, start.known, start.answer, start.predictor, start.new) == (
        False,
        (None, None),
        {},
        None,
        None,
    )


def test_an_earlier_iteration_gives_what_it_has_of_the_present_references():
    start = Start.of(REFERENCES, slab.space, Earlier("quick"))
    assert start.resumed and start.new == {"depth"}
    assert start.answer == {"wide": pytest.approx({"width": 0.9, "depth": 1.0})}
    assert Start.of(REFERENCES, slab.space, Earlier("off")).new is None


def test_replicas_are_kept_where_they_are_nearer():
    judge, start = Judge.of(REFERENCES, sw.Settings(workers=1)), Start.of(REFERENCES, slab.space, Earlier("quick"))
    far, near = {"width": 0.5, "depth": 0.6}, {"width": 0.3, "depth": 0.8}
    with Workers(slab, 1) as crew:
        first = resume(start, crew, judge, range(2))
        assert first.parameters == [slab.space.defaults, start.known[1]]  # in the order of the names: thin, wide
        later = first.tried([near, far], crew, judge)
    assert later.parameters == [near, start.known[1]]
    assert later.distances[0] < first.distances[0] and later.distances[1] == first.distances[1]
    assert Replicas.none(2).parameters == []


def test_parameters_known_besides_are_tried_where_they_are_better():
    known = {"thin": [{"width": 0.9, "depth": 0.6}, {"width": 0.3, "depth": 0.8}], "wide": [{"width": 0.3}]}
    start = Start.of(REFERENCES, slab.space, None, known)
    assert [len(several) for several in start.others] == [2, 1]  # in the order of the names: thin, wide
    with Workers(slab, 1) as crew:
        replicas = resume(start, crew, Judge.of(REFERENCES, sw.Settings(workers=1)), range(2))
    thin, wide = replicas.builds
    assert thin.parameters == pytest.approx({"width": 0.3, "depth": 0.8}) and replicas.fidelities[0] > 0.9
    assert wide.parameters == pytest.approx({"width": 0.3, "depth": 1.0})  # no other was known
