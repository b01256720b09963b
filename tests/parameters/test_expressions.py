"""Conditions as text: what holds, what is refused, and that they keep their text."""

import pickle
from types import SimpleNamespace

import pytest

from shapewright.parameters.expressions import Expression
from shapewright.parameters.schema import condition_text


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("style == 'drawer'", True),
        ("style in ('plain', 'door')", False),
        ("shelves > 0 and not lid", True),
        ("( not lid ) and width - 2 * wall >= 0.8", True),
        ("lid == true", False),
        ("shelves", True),
        ("legs.count == 4 or lid", True),
        ("0 < shelves < 3", True),
    ],
)
def test_a_condition_says_whether_it_holds(text, holds):
    values = {"style": "drawer", "shelves": 2, "lid": False, "width": 1.0, "wall": 0.1}
    values |= {"legs": SimpleNamespace(count=4)}
    assert Expression(text)(values) is holds
    assert Expression(text)(SimpleNamespace(**values)) is holds


def test_it_knows_what_it_is_about():
    assert Expression("lid == true and width > wall or lid").names == ("lid", "width", "wall")


@pytest.mark.parametrize(
    "text",
    ["__import__('os')", "open('x')", "a.__class__", "[x for x in a]", "a = 1", "", "lambda: 1", "a[0]", "f'{a}'"],
)
def test_what_is_more_than_a_condition_is_refused(text):
    with pytest.raises(ValueError, match="condition"):
        Expression(text)


def test_it_travels_to_other_processes_and_keeps_its_text():
    condition = pickle.loads(pickle.dumps(Expression("style == 'drawer'")))
    assert condition({"style": "drawer"}) and condition_text(condition) == "style == 'drawer'"
