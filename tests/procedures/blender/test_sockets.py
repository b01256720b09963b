"""Sockets of a node group become arguments of a function: their limits are the space, anything else is held."""

import inspect

import pytest

from shapewright.parameters import Binary, Choice, Integer, Scalar
from shapewright.procedures.blender.sockets import sockets_of
from shapewright.procedures.signature import signature_of

FREE = 3.402823e38


def described(name, kind="float", default=0.5, low=0.0, high=1.0, **others):
    """What the program in Blender says of a socket."""
    usual = {"identifier": f"Socket_{name}", "panel": "", "description": "", "options": [], "hidden": False}
    return usual | {"name": name, "kind": kind, "default": default, "low": low, "high": high} | others


def signature(*records):
    class Group:
        __name__ = "Group"
        __signature__ = inspect.Signature([socket.parameter for socket in sockets_of(records)])

        def __call__(self, **values): ...

    return signature_of(Group())


def test_limits_and_defaults_are_the_space():
    space = signature(
        described("Height", default=0.7, low=0.5, high=1.0),
        described("Boards", "int", 4, 2, 7),
        described("Back", "bool", True, None, None),
        described("Feet", "menu", "Pegs", None, None, options=["Posts", "Pegs"]),
    ).space
    assert list(space) == [
        Scalar("height", 0.5, 1.0, 0.7),
        Integer("boards", 2, 7, 4),
        Binary("back", True),
        Choice("feet", ("Posts", "Pegs"), "Pegs"),
    ]


def test_an_integer_with_many_values_is_a_whole_number():
    (teeth,) = signature(described("Teeth", "int", 20, 8, 60)).space
    assert isinstance(teeth, Scalar) and teeth.whole and teeth.default == 20


def test_a_vector_with_limits_is_its_components():
    space = signature(described("Size", "vector", [1.0, 0.5, 0.25], 0.1, 2.0)).space
    assert list(space) == [Scalar(f"size.{axis}", 0.1, 2.0, d) for axis, d in zip("xyz", (1.0, 0.5, 0.25), strict=True)]


@pytest.mark.parametrize(
    ("record", "why"),
    [
        (described("A", low=-FREE, high=FREE), "it needs a minimum and a maximum"),
        (described("A", high=FREE), "it needs a minimum and a maximum"),
        (described("A", "int", 1, -(2**31), 2**31 - 1), "it needs a minimum and a maximum"),
        (described("A", "vector", [0.0] * 3, -FREE, FREE), "it needs a minimum and a maximum"),
        (described("A", low=1.0, high=1.0), "its minimum is its maximum"),
        (described("A", hidden=True), "it is hidden in the modifier"),
        (described("Seed", "int", 3, 0, 100), "it is a seed"),
        (described("A", "menu", "", None, None), "its menu has less than two items"),
        (described("A", "object", "Cube", None, None), "its kind is object"),
        (described("A", "color", [1.0] * 4, None, None), "its kind is color"),
        (described("A", "string", "text", None, None), "its kind is string"),
    ],
)
def test_what_is_no_space_is_held_with_a_reason(record, why):
    (socket,) = sockets_of([record])
    assert socket.held == why
    held = signature(record, described("Height"))
    assert held.fixed == (socket.argument,) and held.space.names == ("height",)


def test_a_default_outside_its_limits_is_moved_to_the_nearer_one():
    low, high, menu = signature(
        described("Low", default=0.0, low=0.5, high=1.0),
        described("High", "int", 9, 2, 7),
        described("Menu", "menu", "", None, None, options=["a", "b"]),
    ).space
    assert (low.default, high.default, menu.default) == (0.5, 7, "a")


def test_names_become_those_of_python_and_stay_apart():
    records = [
        described("Leg Height"),
        described("Top / Foot"),
        described("class"),
        described("2nd Radius"),
        described("Höhe"),
        described("!"),
        described("Radius", panel="Legs"),
        described("Radius", panel="Top"),
        described("Width"),
        described("width"),
    ]
    names = [socket.argument for socket in sockets_of(records)]
    assert names == [
        "leg_height",
        "top_foot",
        "class_",
        "socket_2nd_radius",
        "höhe",
        "socket",
        "legs_radius",
        "top_radius",
        "width",
        "width_2",
    ]


def test_the_name_that_people_see_and_the_tooltip_are_the_description():
    plain, told = sockets_of([described("Leg Height"), described("Radius", description="Of each leg")])
    assert plain.parameter.annotation.__metadata__[-1] == "Leg Height"
    assert told.parameter.annotation.__metadata__[-1] == "Radius: Of each leg"
