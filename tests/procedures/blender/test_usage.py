"""When sockets matter: rules that are found by asking Blender at each combination of menus, booleans and integers."""

import itertools
from types import SimpleNamespace

import pytest

from shapewright.procedures.blender.sockets import Socket
from shapewright.procedures.blender.usage import conditions


def socket(name, kind="float", low=None, high=None, options=()):
    return Socket(name, name, name, "", "", kind, None, low, high, tuple(options), False)


SWITCHES = (
    socket("back", "bool"),
    socket("door", "bool"),
    socket("feet", "menu", options=("none", "posts", "pegs")),
    socket("boards", "int", 0, 4),
)
SIZE = socket("size", low=0.0, high=1.0)
VALUES = {"back": (False, True), "door": (False, True), "feet": ("none", "posts", "pegs"), "boards": range(5)}


def rules(matters, trials=()):
    return conditions(
        [*SWITCHES, SIZE], lambda values: set() if matters(SimpleNamespace(**values)) else {"size"}, trials
    )


@pytest.mark.parametrize(
    ("matters", "text"),
    [
        (lambda p: p.back, "back"),
        (lambda p: not p.back, "not back"),
        (lambda p: p.feet == "pegs", "feet == 'pegs'"),
        (lambda p: p.feet != "none", "feet != 'none'"),
        (lambda p: p.boards > 0, "boards >= 1"),
        (lambda p: p.boards in (1, 3), "boards in (1, 3)"),
        (lambda p: p.back and p.feet == "pegs", "back and feet == 'pegs'"),
        (lambda p: p.back or p.door, "back or door"),
        (lambda p: p.back or p.boards > 2, "back or boards >= 3"),
        (lambda p: p.back != p.door, "back and not door or not back and door"),
    ],
)
def test_a_rule_is_as_short_as_people_write_it_and_holds_where_the_socket_matters(matters, text):
    (rule,) = rules(matters).values()
    assert rule.text == text
    for values in itertools.product(*VALUES.values()):
        named = dict(zip(VALUES, values, strict=True))
        assert rule(named) == bool(matters(SimpleNamespace(**named)))


def test_what_always_matters_or_never_seems_to_has_no_rule():
    assert rules(lambda p: True) == {}
    assert rules(lambda p: False) == {}, "another socket decides, or an older Blender does not tell"


def test_a_rule_that_another_socket_breaks_is_none():
    trials = [{"back": False, "door": False, "feet": "none", "boards": 0, "size": size} for size in (0.1, 0.9)]
    assert rules(lambda p: p.back or getattr(p, "size", 0.0) > 0.5, trials) == {}
    assert "size" in rules(lambda p: p.back, trials)


def test_of_very_many_combinations_the_first_switches_are_asked_for():
    many = [socket(f"flag_{i}", "bool") for i in range(20)]
    asked = []
    conditions(many, lambda values: asked.append(values) or set(), ())
    assert len(asked) == 256
