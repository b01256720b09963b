"""Signatures as people write them."""

import functools
from dataclasses import dataclass, field
from enum import Enum, IntEnum, StrEnum
from typing import Annotated, Literal, NewType, Optional, TypeAlias

import numpy as np
import pytest
from typing_extensions import TypeAliasType

import shapewright as sw
from shapewright import Binary, Choice, Integer, Range, Scalar, Seed, When
from shapewright.modelling.solids import box

Length: TypeAlias = Annotated[float, Range(1, 2)]
Named = TypeAliasType("Named", Annotated[float, Range(1, 2)])
Metres = NewType("Metres", float)


class Legs(Enum):
    FOUR = "four"
    PEDESTAL = "pedestal"


class Words(StrEnum):
    A = "a"
    B = "b"


class Numbers(IntEnum):
    ONE = 1
    TWO = 2


@dataclass(frozen=True)
class Shelf:
    level: Annotated[float, Range(0, 1)] = 0.5
    thick: bool = False
    detail: int = 3


@dataclass
class Desk:
    shelf: Shelf = field(default_factory=Shelf)
    width: Length = 1.5


def got(**arguments):
    """What the function of a procedure was called with."""
    called.append(arguments)
    return box(1)


called: list[dict] = []


@pytest.fixture(autouse=True)
def _empty():
    called.clear()


def one(annotation, default=...):
    """A procedure with one such argument beside a plain scalar."""

    def made(w: Length = 1.5, x=None):
        return got(x=x)

    made.__annotations__["x"] = annotation
    made.__defaults__ = (1.5, default)
    if default is ...:

        def bare(x, w: Length = 1.5):
            return got(x=x)

        bare.__annotations__["x"] = annotation
        return sw.procedure(bare)
    return sw.procedure(made)


# annotation, default, the parameters, what the function gets for their defaults
FORMS = [
    (Annotated[float, Range(1, 2)], 1.2, [Scalar("x", 1, 2, 1.2)], 1.2),
    (Length, ..., [Scalar("x", 1, 2, 1.5)], 1.5),
    (Named, 1.1, [Scalar("x", 1, 2, 1.1)], 1.1),
    (Annotated[Metres, Range(1, 2)], 1.1, [Scalar("x", 1, 2, 1.1)], 1.1),
    (Annotated[Annotated[float, "metres"], Range(1, 2)], 1.1, [Scalar("x", 1, 2, 1.1)], 1.1),
    (Annotated[np.float64, Range(1, 2)], np.float32(1.5), [Scalar("x", 1, 2, 1.5)], 1.5),
    (Annotated[float, Range(1, 4, steps=np.linspace(1, 4, 4))], 2, [Scalar("x", 1, 4, 2.0, (1, 2, 3, 4))], 2.0),
    (Annotated[float, Range(0.01, 1, log=True)], ..., [Scalar("x", 0.01, 1, 0.1, log=True)], 0.1),
    (Annotated[int, Range(0, 3)], np.int64(2), [Integer("x", 0, 3, 2)], 2),
    (Annotated[int, Range(0, 3)], 2.0, [Integer("x", 0, 3, 2)], 2),
    (Annotated[np.int32, Range(0, 3)], 1, [Integer("x", 0, 3, 1)], 1),
    (Annotated[int, range(1, 5)], 2, [Integer("x", 1, 4, 2)], 2),
    (Annotated[int, Range(10, 160)], 40, [Scalar("x", 10, 160, 40, whole=True)], 40),
    (Annotated[int, Range(4, 64, steps=4)], 24, [Choice("x", (4, 24, 44, 64), 24)], 24),
    (Annotated[int, Range(4, 64, steps=(4, 8, 64))], 8, [Choice("x", (4, 8, 64), 8)], 8),
    (bool, True, [Binary("x", True)], True),
    (Annotated[bool, When(lambda p: p.w > 1)], False, [Binary("x", False)], False),
    (Literal["a", "b"], "b", [Choice("x", ("a", "b"), "b")], "b"),
    (Literal[4, 8, 16], 8, [Choice("x", (4, 8, 16), 8)], 8),
    (Literal[0.5, 1.0], ..., [Choice("x", (0.5, 1.0), 0.5)], 0.5),
    (Literal["round", None], None, [Choice("x", ("round", "none"), "none")], None),
    (Literal[Legs.FOUR, Legs.PEDESTAL], Legs.PEDESTAL, [Choice("x", ("FOUR", "PEDESTAL"), "PEDESTAL")], Legs.PEDESTAL),
    (Legs, Legs.FOUR, [Choice("x", ("FOUR", "PEDESTAL"), "FOUR")], Legs.FOUR),
    (Legs, ..., [Choice("x", ("FOUR", "PEDESTAL"), "FOUR")], Legs.FOUR),
    (Words, Words.B, [Choice("x", ("A", "B"), "B")], Words.B),
    (Numbers, Numbers.TWO, [Choice("x", ("ONE", "TWO"), "TWO")], Numbers.TWO),
    (
        Optional[Legs],  # noqa: UP045
        None,
        [Choice("x", ("none", "FOUR", "PEDESTAL"), "none")],
        None,
    ),
    (Legs | None, Legs.FOUR, [Choice("x", ("none", "FOUR", "PEDESTAL"), "FOUR")], Legs.FOUR),
    (Literal["a", "b"] | None, "a", [Choice("x", ("none", "a", "b"), "a")], "a"),
    (
        Optional[Length],  # noqa: UP045
        None,
        [Binary("with_x", False), Scalar("x", 1, 2, 1.5)],
        None,
    ),
    (Annotated[float | None, Range(1, 2)], 1.2, [Binary("with_x", True), Scalar("x", 1, 2, 1.2)], 1.2),
    (tuple[Length, Length], (1.0, 2.0), [Scalar("x.x", 1, 2, 1.0), Scalar("x.y", 1, 2, 2.0)], (1.0, 2.0)),
    (
        Annotated[tuple[float, float, float], Range(1, 2)],
        (1, 1, 2),
        [Scalar("x.x", 1, 2, 1.0), Scalar("x.y", 1, 2, 1.0), Scalar("x.z", 1, 2, 2.0)],
        (1.0, 1.0, 2.0),
    ),
    (Shelf, ..., [Scalar("x.level", 0, 1, 0.5), Binary("x.thick", False)], Shelf()),
    (Shelf, Shelf(0.25, True), [Scalar("x.level", 0, 1, 0.25), Binary("x.thick", True)], Shelf(0.25, True)),
    (
        Desk,
        ...,
        [Scalar("x.shelf.level", 0, 1, 0.5), Binary("x.shelf.thick", False), Scalar("x.width", 1, 2, 1.5)],
        Desk(),
    ),
    # left at their defaults
    (Annotated[int, Seed()], 7, [], 7),
    (Seed, 7, [], 7),
    (int, 32, [], 32),
    (float, 1.5, [], 1.5),
    (str, "hello", [], "hello"),
    (dict[str, int], {}, [], {}),
]


@pytest.mark.parametrize(("annotation", "default", "parameters", "value"), FORMS, ids=[str(f[0])[:60] for f in FORMS])
def test_an_annotation_spells_parameters_and_the_function_gets_what_it_means(annotation, default, parameters, value):
    made = one(annotation, default)
    assert [parameter for parameter in made.space if parameter.name != "w"] == parameters
    made(**made.space.defaults)
    made()
    assert called == [{"x": value}] * 2 and all(type(call["x"]) is type(value) for call in called)
    assert made.signature.fixed == (() if parameters else ("x",))
    for values in made.space.sample(20, 0):
        assert made.space.decode(made.space.encode(values)) == pytest.approx(values)
        made(**values)


@pytest.mark.parametrize(
    ("annotation", "default", "message"),
    [
        (Annotated[float, Range(1, 5)], 9, r"the default 9.0 lies outside Range\(1, 5\), by 4"),
        (Annotated[float, Range(1, 5)], None, "the default None is no number"),
        (Annotated[int, Range(1, 5)], 2.5, "no whole number"),
        (Annotated[float, Range(0, 5, log=True)], 1, "needs ends above 0"),
        (tuple[float, ...], (1.0,), "each with its type"),
        (tuple[float, float], (1.0, 2.0), "needs a Range for each"),
        (tuple[Length, Length], (1.0,), "has not 2 values"),
        (Literal["none", None], None, "the same option"),
        (Annotated[int, Seed()], ..., "needs a default"),
        (float, ..., "needs a Range"),
        (list[float], ..., "is not supported"),
        (float | int | None, ..., "is not supported"),
    ],
)
def test_what_is_no_parameter_is_refused_with_its_line(annotation, default, message):
    with pytest.raises(sw.ProcedureError, match=message) as error:
        one(annotation, default)
    assert "test_signature.py:" in str(error.value)


def test_an_optional_is_none_where_its_binary_is_off():
    made = one(Length | None, None)
    made(with_x=True, x=1.25)
    made(with_x=False, x=1.25)
    made(x=1.25)  # the function's own argument
    assert [call["x"] for call in called] == [1.25, None, 1.25]
    assert {v["x"] for v in made.space.sample(30, 0) if not v["with_x"]} == {1.5}


def test_nested_values_are_attributes_for_a_condition():
    @sw.procedure
    def desk(shelf: Shelf, drawer: Annotated[bool, When(lambda p: p.shelf.thick)] = True):
        return box(1)

    assert "drawer" not in desk.space.active(desk.space.defaults)
    assert "drawer" in desk.space.active({**desk.space.defaults, "shelf.thick": True})


def test_the_function_may_be_called_with_its_own_arguments():
    made = one(Shelf)
    made(x=Shelf(1.0))
    made(**{"x.level": 0.25})
    made(Shelf(0.75))
    assert [call["x"] for call in called] == [Shelf(1.0), Shelf(0.25), Shelf(0.75)]
    legs = one(Legs, Legs.FOUR)
    legs(x=Legs.PEDESTAL)
    legs(x="PEDESTAL")
    assert [call["x"] for call in called[3:]] == [Legs.PEDESTAL] * 2


def test_arguments_without_a_range_stay_at_their_defaults_and_are_named():
    @sw.procedure
    def part(w: Length = 1.5, *more, debug=False, quality: int = 32, **others):
        return got(debug=debug, quality=quality, more=more, others=others)

    assert part.space.names == ("w",) and part.signature.fixed == ("debug", "quality")
    part(w=1.0)
    assert called == [{"debug": False, "quality": 32, "more": (), "others": {}}]


def test_a_procedure_may_be_whatever_can_be_called():
    def plain(w: Length, detail: int = 1):
        return got(w=w, detail=detail)

    class Builder:
        def __call__(self, w: Length = 1.25):
            return got(w=w)

        def build(self, w: Length = 1.25):
            return got(w=w)

        @staticmethod
        def fixed(w: Length = 1.25):
            return got(w=w)

        @classmethod
        def of(cls, w: Length = 1.25):
            return got(w=w)

    @dataclass
    class Table:
        w: Length = 1.25

        def __call__(self):
            return got(w=self.w)

    @functools.wraps(plain)
    def wrapped(*args, **kwargs):
        return plain(*args, **kwargs)

    several = {
        "plain": functools.partial(plain, detail=3),
        "Builder": Builder(),
        "build": Builder().build,
        "fixed": staticmethod(Builder.fixed),
        "of": Builder.of,
        "Table": Table,
    }
    for name, function in several.items():
        made = sw.procedure(function)
        assert made.name == name and made.space.names == ("w",)
        made(w=1.75)
        assert called.pop()["w"] == 1.75 and "test_signature.py" in str(made.place)
    for function in (wrapped, functools.lru_cache(plain)):
        made = sw.procedure(function)
        assert made.name == "plain" and made.place.line == sw.procedure(plain).place.line


def test_positional_only_arguments_are_given_in_their_order():
    @sw.procedure
    def part(w: Length, n: Annotated[int, Range(1, 4)] = 2, /, x: bool = False):
        return got(w=w, n=n, x=x)

    part(n=3, w=1.25)
    assert called == [{"w": 1.25, "n": 3, "x": False}]


def test_the_decorator_may_stand_with_brackets_and_twice():
    @sw.procedure()
    def part(w: Length = 1.5):
        return box(w)

    assert part.name == "part" and sw.procedure(part) is part


def test_annotations_as_text_mean_names_of_the_function_around(tmp_path):
    path = tmp_path / "model.py"
    path.write_text(
        """from __future__ import annotations
from typing import TYPE_CHECKING, Annotated
from shapewright import Range, procedure
if TYPE_CHECKING:
    import cadquery as cq
def made():
    Length = Annotated[float, Range(1, 2)]
    @procedure
    def part(w: Length = 1.5) -> cq.Workplane:
        return [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    return part
part = made()
"""
    )
    assert sw.load_procedure(path).space.names == ("w",)


def test_a_condition_that_fails_says_so_when_the_procedure_is_made():
    with pytest.raises(sw.ProcedureError, match=r"x: its when= failed: AttributeError.*shelves") as error:
        one(Annotated[float, Range(1, 2, when=lambda p: p.shelves > 0)], 1.5)
    assert "test_signature.py:" in str(error.value)


def test_an_async_function_is_refused():
    async def part(w: Length = 1.5):
        return box(w)

    with pytest.raises(sw.ProcedureError, match="leave async out"):
        sw.procedure(part)


def test_a_seed_with_all_integers_takes_no_memory():
    made = one(Annotated[int, Range(0, 2**31 - 1)], 0)
    assert len({values["x"] for values in made.space.sample(50, 0)}) == 50
    assert all(isinstance(values["x"], int) for values in made.space.sample(50, 0))


class Said:
    documentation = "how wide"


@pytest.mark.parametrize(
    ("annotation", "default"),
    [
        (Annotated[float, sw.Range(1, 2), "how wide"], 1.5),
        (Annotated[float, "how wide", sw.Range(1, 2)], 1.5),
        (Annotated[float, sw.Range(1, 2), Said()], 1.5),
        (Annotated[bool, "how wide"], True),
        (Annotated[tuple[Length, Length], "how wide"], (1.5, 1.5)),
        (tuple[Annotated[Length, "how wide"], Annotated[Length, "how wide"]], (1.5, 1.5)),
        (Annotated[float | None, sw.Range(1, 2), "how wide"], None),
    ],
    ids=str,
)
def test_what_an_annotation_says_in_words_is_kept_for_its_parameters(annotation, default):
    made = one(annotation, default)
    names = [name for name in made.space.names if name != "w"]
    assert names and made.signature.meanings == dict.fromkeys(names, "how wide")


def test_nothing_is_said_where_no_annotation_has_words():
    assert one(Length, 1.5).signature.meanings == {}
