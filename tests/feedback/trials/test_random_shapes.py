"""Random shapes of a procedure without and with a change."""

import pytest

import shapewright as sw
from shapewright import Choice
from shapewright.building import Workers
from shapewright.feedback.trials.attempt import turned_to
from shapewright.feedback.trials.random_shapes import RandomShapes, _condition, shown, shows
from shapewright.modelling.solids import box
from shapewright.shapes.mesh import concatenate

POST = """
from typing import Annotated, Literal
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def post(height: Annotated[float, Range(0.2, 1.0)] = 0.6, wide: bool = False, kind: Literal["post", "wall"] = "post"):
    shape = box((3.0 if kind == "wall" else 0.5, height, 0.2 if wide else 0.1)).label("post")
    return shape
"""


@pytest.fixture
def crew(tmp_path):
    path = tmp_path / "post.py"
    path.write_text(POST)
    with Workers(sw.load_procedure(path), 1) as workers:
        yield workers


def changed(crew, after, more=""):
    source = POST.replace('= "post"):', '= "post", knob: bool = False):').replace("return shape", f"return {after}")
    plain = RandomShapes.of(crew, 0)
    with turned_to(source + more, crew) as turned:
        return plain, plain.changed(turned, "knob")


def test_a_change_that_makes_sound_shapes_unsound_is_told(crew):
    through = """
def add(shape):
    mesh = shape.mesh()
    return (
        [*mesh.vertices, *(mesh.vertices * 0.5 + (0.25, 0, 0))],
        [*mesh.faces, *(mesh.faces + len(mesh.vertices))],
    )
"""
    plain, broken = changed(crew, "add(shape) if knob else shape", through)
    assert plain.unsound == 0 and broken.unsound > 0
    _, sound = changed(crew, "shape | shape if knob else shape")
    assert sound.unsound == 0 and all(values["knob"] for values in sound.parameters)


def test_a_part_belongs_to_the_branches_in_which_it_stands(crew):
    aside = 'shape | box(0.2, at=(0.3, 0, 0)).label("knob") if knob else shape'
    plain, knobs = changed(crew, aside.replace("box(0.2,", 'box(0.2 if kind == "post" else 0.01,'))
    used = [values for values in knobs.parameters if values["kind"] == "post"]
    assert plain.branch(knobs, used) == 'p.kind == "post"'  # in a wall it is hidden
    assert plain.branch(knobs, list(knobs.parameters)) is None  # a wall that needs it has it


def test_a_part_that_floats_in_a_branch_does_not_belong_there(crew):
    plain, knobs = changed(crew, 'shape | box(0.2, at=(0.3, 0.0, 1 if wide else 0)).label("k") if knob else shape')
    assert plain.branch(knobs, []) == "not p.wide"


def test_options_that_are_numbers_stay_numbers():
    sizes = Choice("size", (4, 8, 16), 4)
    assert _condition(sizes, [4]) == "p.size == 4" and _condition(sizes, [4, 8]) == "p.size in (4, 8)"
    assert _condition(Choice("form", ('a "b"', "c"), "c"), ['a "b"']) == 'p.form == "a \\"b\\""'


def test_a_part_that_stands_everywhere_has_no_condition(crew):
    plain, knobs = changed(crew, 'shape | box(0.3, at=(0, height / 2, 0)).label("knob") if knob else shape')
    assert plain.branch(knobs, []) is None


def test_what_lies_inside_is_not_seen():
    outer, inner = box(1.0).label("outer").mesh(), box(0.5).label("inner").mesh()
    inside = concatenate([outer, inner])
    beside = (box(1.0).label("outer") | box(0.5, at=(0.6, 0, 0)).label("inner")).mesh()
    assert shows(outer, beside, inner) and 0.5 < shown(beside, inner) < 0.8
    assert shown(inside, inner) == 0.0 and not shows(outer, inside, inner)


def test_what_only_looks_out_of_another_part_is_not_seen():
    """Parts that are joined have no surface inside: what is left of them would all be seen."""
    walls, plinth = box((1, 1, 1)).label("walls"), box((1.2, 0.1, 1.2), at=(0, -0.45, 0)).label("plinth")
    tray = box((1.01, 0.4, 0.6)).label("tray")
    assert shown((walls | plinth).mesh(), plinth.mesh()) > 0.5
    assert shown((walls | tray).mesh(), tray.mesh()) < 0.3 and not shows(
        walls.mesh(), (walls | tray).mesh(), tray.mesh()
    )


def test_a_part_belongs_to_the_branches_in_which_enough_of_it_is_seen(crew):
    knob = 'box((3.1, 0.05, 0.05)).label("knob")'
    plain, knobs = changed(crew, f"shape | {knob} if knob else shape")
    assert plain.branch(knobs, []) is None  # without the part alone only what is hidden whole is told
    alone = POST.replace('= "post"):', '= "post", knob: bool = False):').replace("return shape", f"return {knob}")
    with turned_to(alone, crew) as turned:
        assert plain.branch(knobs.adding(turned), []) == 'p.kind == "post"'
