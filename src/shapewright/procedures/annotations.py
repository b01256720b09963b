"""What an annotation says of an argument: its parameters, and how their values become what the function gets."""

from __future__ import annotations

import dataclasses
import functools
import types
import typing
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import numpy as np

from shapewright.parameters import Binary, Choice, Parameter, Range, Scalar, Seed, Value, When, whole_number
from shapewright.parameters.kinds import Condition
from shapewright.parameters.schema import condition_text
from shapewright.procedures.bindings import NONE, Binding, Given, Group, Member, Plain

AXES = "xyzw"
"""Names of the values of a vector: as many as it may have."""


class SignatureError(Exception):
    """An argument is no parameter. unknown: whether saying which annotations there are helps."""

    def __init__(self, message: str, unknown: bool = False) -> None:
        super().__init__(message)
        self.unknown = unknown


@dataclass(frozen=True)
class Argument:
    """What is known of an argument of a function.

    Attributes:
        name: of the argument.
        parameters: of the space, that it is made of.
        binding: makes it of their values; None where it stays at its default.
        meanings: what is said of parameters, by name.
    """

    name: str
    parameters: tuple[Parameter, ...] = ()
    binding: Binding | None = None
    meanings: Mapping[str, str] = dataclasses.field(default_factory=dict)


@dataclass(frozen=True)
class _Hint:
    """An annotation taken apart.

    Attributes:
        kind: the type.
        limits: its Range.
        when: when it matters.
        chance: whether it is a seed.
        meaning: what it says in words: a string, a Doc, or the description of pydantic's Field; empty without one.
    """

    kind: Any
    limits: Range | None
    when: Condition | None
    chance: bool
    meaning: str


def read(name: str, hint: Any, default: Any, missing: bool) -> Argument:
    """An argument by its annotation. missing: whether it has no default. Raises SignatureError, ValueError."""
    one = _taken_apart(hint)
    argument = _read(name, one, _plain(default), missing)
    if not one.meaning:
        return argument
    return replace(argument, meanings={**{p.name: one.meaning for p in argument.parameters}, **argument.meanings})


def _read(name: str, one: _Hint, default: Any, missing: bool) -> Argument:
    if one.chance:
        if missing:
            raise SignatureError(f"parameter {name!r} is a Seed and needs a default, such as 0")
        return Argument(name)
    if maybe := _without_none(one.kind):
        return _optional(name, replace(one, kind=maybe), default, missing)
    if one.kind is bool:
        return _alone(Binary(name, default if not missing else False, one.when))
    if get_origin(one.kind) is Literal:
        return _choice(name, get_args(one.kind), default, missing, one.when)
    if isinstance(one.kind, type) and issubclass(one.kind, Enum):
        return _choice(name, tuple(one.kind), default, missing, one.when)
    if get_origin(one.kind) is tuple:
        return _vector(name, one, default, missing)
    if isinstance(one.kind, type) and (fields := list(_fields(one.kind))):
        return _record(name, one.kind, fields, default, missing)
    if one.kind in (int, float) and one.limits:
        return _alone(_number(name, one.kind, one.limits, default, missing, one.when))
    if not missing:
        return Argument(name)
    if one.kind in (int, float):
        spelled = one.kind.__name__
        raise SignatureError(f"parameter {name!r} needs a Range: Annotated[{spelled}, Range(low, high)]")
    spelled = one.kind.__name__ if isinstance(one.kind, type) else str(one.kind)
    raise SignatureError(f"parameter {name!r}: the annotation {spelled} is not supported", unknown=True)


def _taken_apart(hint: Any) -> _Hint:
    extras: list[Any] = []
    while True:
        if get_origin(hint) is Annotated:
            extras = [*get_args(hint)[1:], *extras]
            hint = get_args(hint)[0]
        elif isinstance(hint, typing.NewType):
            hint = hint.__supertype__
        elif hasattr(hint, "__value__"):  # the type statement, and TypeAliasType
            hint = hint.__value__
        else:
            break
    if isinstance(hint, type) and issubclass(hint, np.number):
        hint = int if issubclass(hint, np.integer) else float
    limits = next((extra for extra in extras if isinstance(extra, Range)), None) or _bounds(extras)
    when = next((extra.condition for extra in extras if isinstance(extra, When)), limits.when if limits else None)
    chance = hint is Seed or any(extra is Seed or isinstance(extra, Seed) for extra in extras)
    said = (extra if isinstance(extra, str) else _said(extra) for extra in extras)
    return _Hint(hint, limits, when, chance, next((text for text in said if text), ""))


def _said(extra: Any) -> str:
    """What the annotations of others say in words."""
    texts = (getattr(extra, name, None) for name in ("documentation", "description"))
    return next((text for text in texts if isinstance(text, str)), "")


def _bounds(extras: Sequence[Any]) -> Range | None:
    """The limits that other libraries' annotations spell: ``range(1, 5)``, pydantic's Field, annotated_types."""
    flat = [part for extra in extras for part in (extra, *getattr(extra, "metadata", ()))]
    for extra in flat:
        if isinstance(extra, range):
            return Range(extra.start, extra[-1]) if len(extra) else None
    low = [getattr(extra, side) for extra in flat for side in ("ge", "gt") if getattr(extra, side, None) is not None]
    high = [getattr(extra, side) for extra in flat for side in ("le", "lt") if getattr(extra, side, None) is not None]
    return Range(max(low), min(high)) if low and high else None


def _plain(default: Any) -> Any:
    """numpy's numbers as Python's."""
    return default.item() if isinstance(default, np.generic) else default


def _alone(parameter: Parameter) -> Argument:
    return Argument(parameter.name, (parameter,), Plain(parameter.name))


def _number(name: str, kind: type, limits: Range, default: Any, missing: bool, when: Condition | None) -> Parameter:
    if not missing and (isinstance(default, bool) or not isinstance(default, int | float)):
        raise SignatureError(f"parameter {name!r}: the default {default!r} is no number")
    low, high = limits.low, limits.high
    if kind is float:
        steps = limits.steps if isinstance(limits.steps, int | None) else tuple(float(step) for step in limits.steps)
        middle = float(np.sqrt(low * high)) if limits.log and low > 0 else (low + high) / 2
        value = middle if missing else float(default)
        return Scalar(name, float(low), float(high), value, steps, when, limits.log)
    if (int(low), int(high)) != (low, high):
        raise SignatureError(f"parameter {name!r}: Range({low}, {high}) of an integer needs whole ends")
    if not missing and default != int(default):
        raise SignatureError(f"parameter {name!r}: the default {default!r} is no whole number")
    value = int(low) if missing else int(default)
    if limits.steps is None:
        return whole_number(name, int(low), int(high), value, when, limits.log)
    spread = np.geomspace if limits.log else np.linspace
    given = spread(low, high, limits.steps) if isinstance(limits.steps, int) else limits.steps
    return Choice(name, tuple(dict.fromkeys(round(float(step)) for step in given)), value, when)


def _choice(
    name: str, members: Sequence[Any], default: Any, missing: bool, when: Condition | None, none: bool = False
) -> Argument:
    """A choice of what a Literal lists, or of an enum's members; ``none``: or of None."""
    members = (None, *members) if none else tuple(members)
    options: dict[Value, Any] = {}
    for member in members:
        option = NONE if member is None else member.name if isinstance(member, Enum) else member
        if not isinstance(option, str | int | float | bool):
            raise SignatureError(f"parameter {name!r}: {member!r} is no option; use strings, numbers or an Enum")
        if option in options:
            raise SignatureError(f"parameter {name!r}: {member!r} and {options[option]!r} are the same option")
        options[option] = member
    chosen = members[0] if missing else default
    value = next((option for option, member in options.items() if member is chosen or member == chosen), chosen)
    choice = Choice(name, tuple(options), value, when)
    same = all(
        option is member or (option == member and not isinstance(member, Enum)) for option, member in options.items()
    )
    return _alone(choice) if same else Argument(name, (choice,), Member(name, options))


def _without_none(kind: Any) -> Any:
    """The type of what may be None; None where it may not."""
    if get_origin(kind) not in (Union, types.UnionType):
        return None
    others = [part for part in get_args(kind) if part is not type(None)]
    return others[0] if len(others) == 1 and len(others) < len(get_args(kind)) else None


def _optional(name: str, hint: _Hint, default: Any, missing: bool) -> Argument:
    """A choice has None as one more option. Anything else has a binary that says whether it is given."""
    inner = _taken_apart(hint.kind)
    none = default is None
    if get_origin(inner.kind) is Literal:
        return _choice(name, get_args(inner.kind), default, missing, hint.when, none=True)
    if isinstance(inner.kind, type) and issubclass(inner.kind, Enum):
        return _choice(name, tuple(inner.kind), default, missing, hint.when, none=True)
    home, dot, own = name.rpartition(".")
    flag = f"{home}{dot}with_{own}"
    spelled = hint.kind if inner.limits or not hint.limits else Annotated[hint.kind, replace(hint.limits, when=None)]
    one = read(name, spelled, default, missing or none)
    if not one.binding:
        return one
    parameters = tuple(replace(p, when=_Both(p.when, flag)) for p in one.parameters)
    given = Given(flag, one.binding)
    return Argument(name, (Binary(flag, not (missing or none), hint.when), *parameters), given, one.meanings)


@dataclass(frozen=True)
class _Both:
    """A condition that holds where a binary is on, and another one holds, too."""

    other: Condition | None
    flag: str

    @property
    def text(self) -> str:
        """For ``condition_text``."""
        return f"p.{self.flag}" if self.other is None else f"p.{self.flag} and ({condition_text(self.other)})"

    def __call__(self, values: Any) -> bool:
        given = functools.reduce(getattr, self.flag.split("."), values)
        return bool(given) and (self.other is None or bool(self.other(values)))


def _vector(name: str, hint: _Hint, default: Any, missing: bool) -> Argument:
    parts = get_args(hint.kind)
    if not parts or Ellipsis in parts or len(parts) > len(AXES):
        raise SignatureError(f"parameter {name!r}: a vector has one to {len(AXES)} values, each with its type")
    if not missing and (not isinstance(default, Sequence) or len(default) != len(parts)):
        raise SignatureError(f"parameter {name!r}: the default {default!r} has not {len(parts)} values")
    own = [part if get_origin(part) is Annotated or not hint.limits else Annotated[part, hint.limits] for part in parts]
    inner = [
        read(f"{name}.{axis}", part, None if missing else default[i], missing)
        for i, (axis, part) in enumerate(zip(AXES, own, strict=False))
    ]
    return _grouped(name, inner, tuple, None)


@dataclass(frozen=True)
class _Field:
    name: str
    hint: Any
    default: Any
    missing: bool


def _fields(kind: type) -> Iterator[_Field]:
    """Of a dataclass, or of a pydantic model."""
    if dataclasses.is_dataclass(kind):
        hints = typing.get_type_hints(kind, include_extras=True)
        for field in dataclasses.fields(kind):
            missing = field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
            default = field.default_factory() if field.default_factory is not dataclasses.MISSING else field.default
            yield _Field(field.name, hints[field.name], default, missing)
    for name, info in getattr(kind, "model_fields", {}).items():
        yield _Field(
            name, Annotated[info.annotation, info], None if info.is_required() else info.default, info.is_required()
        )


def _record(name: str, kind: type, fields: Sequence[_Field], default: Any, missing: bool) -> Argument:
    inner = []
    for field in fields:
        own = field.default if missing or default is None else getattr(default, field.name)
        inner.append(read(f"{name}.{field.name}", field.hint, own, field.missing and (missing or default is None)))
    names = tuple(one.name.rpartition(".")[2] for one in inner if one.binding)
    return _grouped(name, inner, kind, names)


def _grouped(
    name: str, inner: Sequence[Argument], make: Callable[..., Any], keywords: tuple[str, ...] | None
) -> Argument:
    bindings = tuple(one.binding for one in inner if one.binding)
    if not bindings or (keywords is None and len(bindings) < len(inner)):
        raise SignatureError(f"parameter {name!r} needs a Range for each of its values")
    meanings = {key: text for one in inner for key, text in one.meanings.items()}
    return Argument(name, tuple(p for one in inner for p in one.parameters), Group(make, bindings, keywords), meanings)
