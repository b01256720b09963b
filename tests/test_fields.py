import math
from dataclasses import dataclass
from typing import Annotated, Literal

import pytest

from shapewright.fields import Within, either, fields_of, meant


@dataclass
class Tea:
    sort: Annotated[Literal["green", "black"], "What it is made of."] = "green"
    minutes: Annotated[float, Within(above=0, most=10), "How long it draws."] = 3.0
    cups: Annotated[int | None, Within(least=2, step=2), "How many there are."] = None
    hot: bool = True


def test_fields_are_read_from_annotations():
    fields = fields_of(Tea)
    assert list(fields) == ["sort", "minutes", "cups", "hot"]
    assert fields["sort"].choices == ("green", "black") and fields["sort"].help == "What it is made of."
    assert (fields["cups"].kind, fields["cups"].optional, fields["cups"].default) == (int, True, None)
    assert fields["hot"].allowed == "True or False" and fields["hot"].default is True


@pytest.mark.parametrize(
    ("name", "good", "wrong"),
    [
        ("sort", ["black"], ["blue", None, 1]),
        ("minutes", [10, 0.5], [0, 10.5, math.nan, math.inf, "3", True]),
        ("cups", [None, 4], [0, 3, 2.0]),
        ("hot", [False], [0, None]),
    ],
)
def test_values_are_checked(name, good, wrong):
    field = fields_of(Tea)[name]
    assert [field.checked(value) for value in good] == good
    for value in wrong:
        with pytest.raises(ValueError, match=f"{name}=.* must be "):
            field.checked(value)


def test_what_is_allowed_is_said_in_words():
    assert str(Within(above=0, most=10)) == "greater than 0 and at most 10"
    assert fields_of(Tea)["cups"].allowed == "a whole number, at least 2 and a multiple of 2, or None"
    assert either(["a", "b", "c"]) == "a, b or c" and either(["a"]) == "a"
    assert meant("grean", ["green", "black"]) == "; did you mean green?" and not meant("x", ["green"])
