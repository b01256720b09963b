"""What the source calls random draws."""

import ast

import pytest

from shapewright.commands.procfunc.naming import Site, site

SOURCE = """\
def _seat_rand(rng):
    z = draw(1)
    x = z * draw(2) ** 2
    self.depth: float = draw(3)
    (y, w), v = f(draw(4)), g
    if (n := draw(5)) > 2:
        build(rng, height=0.5 + draw(6), other=(draw(7), 1))
    size += draw(8)
    return build(draw(9), draw(10))

value = choice(rng, [(legs, 1.0), ((draw(11)), 2.0)])
names = [draw(12) for _ in range(3)]
def outer():
    def inner(): return dict(length=draw(13))
    build(lambda: draw(14))
"""


def end(number):
    """Where a call ends."""
    found = [
        call
        for call in ast.walk(ast.parse(SOURCE))
        if isinstance(call, ast.Call) and ast.unparse(call) == f"draw({number})"
    ]
    return found[0].end_lineno, found[0].end_col_offset


@pytest.mark.parametrize(
    ("number", "name", "function"),
    [
        (1, "z", "_seat_rand"),
        (2, "x", "_seat_rand"),
        (3, "depth", "_seat_rand"),
        (4, "", "_seat_rand"),
        (5, "n", "_seat_rand"),
        (6, "height", "_seat_rand"),
        (7, "other", "_seat_rand"),
        (8, "size", "_seat_rand"),
        (9, "", "_seat_rand"),
        (10, "", "_seat_rand"),
        (11, "value", ""),
        (12, "names", ""),
        (13, "length", "inner"),
        (14, "", "outer"),
    ],
)
def test_a_draw_has_the_name_that_gets_its_value(number, name, function):
    found = site(SOURCE, end(number))
    assert (found.name, found.function) == (name, function)


def test_the_option_of_a_choice_that_a_draw_stands_in_is_known():
    line = SOURCE.splitlines().index("value = choice(rng, [(legs, 1.0), ((draw(11)), 2.0)])") + 1
    choice = (line, len(SOURCE.splitlines()[line - 1]))
    assert (site(SOURCE, end(11)).choice, site(SOURCE, end(11)).option) == (choice, 1)
    assert site(SOURCE, choice) == Site("value", options=("legs", ""))
    assert site(SOURCE, end(12)).choice is None


def test_without_a_column_the_line_is_enough_and_a_strange_place_has_no_name():
    assert site(SOURCE, (2, None)).name == "z"
    assert site(SOURCE, (2, 1)) == Site() == site("", (1, 1))
