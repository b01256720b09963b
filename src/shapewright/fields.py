"""What one field of a settings value may be: read from its annotation, checked, and put into words."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import MISSING, dataclass, fields
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np


@dataclass(frozen=True)
class Within:
    """Bounds of a number, in an annotation: ``Annotated[int, Within(least=20), "What it is."]``."""

    least: float | None = None  # the smallest value
    most: float | None = None  # the largest value
    above: float | None = None  # the value is greater than this one
    below: float | None = None  # the value is less than this one
    step: int | None = None  # the value is a multiple of this one

    def __contains__(self, value: float) -> bool:
        return (
            _is_finite(value)
            and (self.least is None or value >= self.least)
            and (self.most is None or value <= self.most)
            and (self.above is None or value > self.above)
            and (self.below is None or value < self.below)
            and (self.step is None or value % self.step == 0)
        )

    def __str__(self) -> str:
        bounds = {"at least": self.least, "greater than": self.above, "at most": self.most, "less than": self.below}
        words = [f"{word} {bound:g}" for word, bound in bounds.items() if bound is not None]
        return " and ".join([*words, *([f"a multiple of {self.step}"] if self.step else [])])


@dataclass(frozen=True)
class Field:
    """What a field may be."""

    name: str
    kind: type[bool | int | float | str | tuple[float, ...]]
    default: Any  # its value where none is given
    help: str  # what it is, in one sentence
    choices: tuple[str, ...] = ()  # the values that it may have, where these are words
    within: Within = Within()  # bounds of a number, or of each number of a tuple
    length: int = 0  # how many numbers a tuple has
    optional: bool = False  # whether it may be None

    @property
    def allowed(self) -> str:
        """In words: "a whole number, at least 20"."""
        kinds = {bool: "True or False", int: "a whole number", float: "a finite number", str: "a text"}
        words = kinds.get(self.kind, f"{self.length} finite numbers")
        if self.choices:
            words = either(self.choices)
        return ", ".join(filter(None, [words, str(self.within)])) + (", or None" if self.optional else "")

    def checked(self, value: Any) -> Any:
        """The value as its plain type. Raises ValueError, which says what is allowed."""
        plain = value.item() if isinstance(value, np.generic) else value
        if self.allows(plain):
            return self.kind(plain) if plain is not None else None
        raise ValueError(f"{self.name}={value!r} must be {self.allowed}{meant(value, self.choices)}")

    def allows(self, value: Any) -> bool:
        """Whether it may have this value, of a plain type."""
        if value is None:
            return self.optional
        if self.choices:
            return isinstance(value, str) and value in self.choices
        if self.kind is tuple:
            return isinstance(value, tuple | list) and len(value) == self.length and all(map(self._is_number, value))
        if self.kind in (int, float):
            return self._is_number(value)
        return isinstance(value, self.kind)

    def _is_number(self, value: Any) -> bool:
        kinds = (int,) if self.kind is int else (int, float)
        return isinstance(value, kinds) and not isinstance(value, bool) and value in self.within


def _is_finite(value: float) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:  # a whole number that no float comes near to
        return False


def fields_of(kind: type[Any]) -> Mapping[str, Field]:
    """The fields of a dataclass by name; each is annotated with its type, its bounds if it has any, and its help."""
    hints = get_type_hints(kind, include_extras=True)
    return {field.name: _field(field.name, hints[field.name], field.default) for field in fields(kind)}


def either(words: Iterable[str]) -> str:
    """In words: "off, quick or thorough"."""
    *others, last = words
    return f"{', '.join(others)} or {last}" if others else last


def meant(word: Any, words: Iterable[str]) -> str:
    """A question after the message about a word that is none of the words; empty where none resembles it."""
    import difflib

    close = difflib.get_close_matches(word, list(words), n=1) if isinstance(word, str) else []
    return f"; did you mean {close[0]}?" if close else ""


def _field(name: str, hint: Any, default: Any) -> Field:
    kind, *notes = get_args(hint) if get_origin(hint) is Annotated else (hint,)
    optional = get_origin(kind) in (Union, UnionType)
    if optional:
        (kind,) = (part for part in get_args(kind) if part is not NoneType)
    within = next((note for note in notes if isinstance(note, Within)), Within())
    text = next((note for note in notes if isinstance(note, str)), "")
    origin, parts = get_origin(kind), get_args(kind)
    return Field(
        name=name,
        kind=str if origin is Literal else origin or kind,
        default=None if default is MISSING else default,
        help=text,
        choices=parts if origin is Literal else (),
        within=within,
        length=len(parts) if origin is tuple else 0,
        optional=optional,
    )
