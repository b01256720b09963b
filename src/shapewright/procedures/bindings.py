"""From the values of a space to what the author's function is called with: members of enums, vectors, records."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from shapewright.parameters import Value

NONE = "none"
"""The option of a choice that stands for None."""


@dataclass(frozen=True)
class Plain:
    """A value as it is.

    Attributes:
        name: of the parameter.
    """

    name: str

    @property
    def names(self) -> tuple[str, ...]:
        return (self.name,)

    def __call__(self, values: Mapping[str, Value]) -> Any:
        return values[self.name]


@dataclass(frozen=True)
class Member:
    """An option that stands for something else: a member of an enum, or None.

    Attributes:
        name: of the parameter.
        members: what each option stands for.
    """

    name: str
    members: Mapping[Value, Any]

    @property
    def names(self) -> tuple[str, ...]:
        return (self.name,)

    def __call__(self, values: Mapping[str, Any]) -> Any:
        """What is no option is what the function was called with itself."""
        value = values[self.name]
        return self.members.get(value, value) if isinstance(value, str | int | float) else value


@dataclass(frozen=True)
class Given:
    """What may be None.

    Attributes:
        flag: the binary that says that it is not.
        inner: what it is then.
    """

    flag: str
    inner: Binding

    @property
    def names(self) -> tuple[str, ...]:
        return (self.flag, *self.inner.names)

    def __call__(self, values: Mapping[str, Value]) -> Any:
        return self.inner(values) if values[self.flag] else None


@dataclass(frozen=True)
class Group:
    """Several values together: a vector, a dataclass, a model.

    Attributes:
        make: makes it of them, in their order.
        inner: each of them.
        keywords: their names; None for a vector, whose values have none.
    """

    make: Callable[..., Any]
    inner: tuple[Binding, ...]
    keywords: tuple[str, ...] | None = None

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(name for each in self.inner for name in each.names)

    def __call__(self, values: Mapping[str, Value]) -> Any:
        made = [each(values) for each in self.inner]
        return self.make(made) if self.keywords is None else self.make(**dict(zip(self.keywords, made, strict=True)))


Binding: TypeAlias = Plain | Member | Given | Group
