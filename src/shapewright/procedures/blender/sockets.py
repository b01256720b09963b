"""The inputs of a geometry node group as arguments of a function: their limits are the Ranges."""

from __future__ import annotations

import inspect
import keyword
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import GenericAlias
from typing import Annotated, Any, Literal

from shapewright.parameters import Range, Seed, When
from shapewright.parameters.expressions import Expression

_UNLIMITED = {"int": 2.0**31 - 1.0, "float": 3.4e38, "vector": 3.4e38}
"""From here on a limit is none: what Blender shows where nobody set one, the greatest number of its kind."""
_TYPES: Mapping[str, Any] = {"float": float, "int": int, "bool": bool, "string": str}


@dataclass(frozen=True)
class Socket:
    """An input of a node group.

    Attributes:
        argument: the name that it has in Python.
        identifier: Blender's own name of it.
        name: that people see.
        panel: that it stands in; empty without one.
        description: its tooltip.
        kind: "float", "int", "bool", "menu", "vector", or what else Blender has, as "object".
        default: its value, a list for a vector, the name of a data-block.
        low: its minimum; None where its kind has none.
        high: its maximum.
        options: of a menu.
        hidden: whether the modifier hides it.
        when: says when it matters.
    """

    argument: str
    identifier: str
    name: str
    panel: str
    description: str
    kind: str
    default: Any
    low: float | None
    high: float | None
    options: tuple[str, ...]
    hidden: bool
    when: Expression | None = None

    @property
    def held(self) -> str | None:
        """Why it stays at its default; None where it is a parameter."""
        if self.hidden:
            return "it is hidden in the modifier"
        if self.kind == "int" and re.search(r"(?i)\bseed\b", self.name):
            return "it is a seed"
        if self.kind in _UNLIMITED:
            most = _UNLIMITED[self.kind]
            if self.low is None or self.high is None or self.low <= -most or self.high >= most:
                return "it needs a minimum and a maximum"
            return None if self.low < self.high else "its minimum is its maximum"
        if self.kind == "menu":
            return None if len(self.options) > 1 else "its menu has less than two items"
        return None if self.kind == "bool" else f"its kind is {self.kind}"

    @property
    def parameter(self) -> inspect.Parameter:
        """The argument of a function that it is."""
        default = self._inside if not self.held else self.default
        return inspect.Parameter(
            self.argument,
            inspect.Parameter.KEYWORD_ONLY,
            default=tuple(default) if isinstance(default, list) else default,
            annotation=self._annotation,
        )

    @property
    def said(self) -> str:
        """Its name as people see it, and its tooltip."""
        return f"{self.name}: {self.description}" if self.description else self.name

    @property
    def _annotation(self) -> Any:
        if self.held == "it is a seed":
            return Annotated[int, Seed()]
        if self.held:
            return _TYPES.get(self.kind, inspect.Parameter.empty)
        limits = [Range(self.low, self.high, when=self.when)] if self.low is not None and self.high is not None else []
        extras = [*limits, *([When(self.when)] if self.when else []), self.said]
        kinds = {"menu": Literal[self.options], "vector": GenericAlias(tuple, (float,) * len(_values(self.default)))}
        spelled: Any = kinds.get(self.kind) or _TYPES[self.kind]
        for extra in extras:
            spelled = Annotated[spelled, extra]
        return spelled

    @property
    def _inside(self) -> Any:
        """Its default. One that its limits leave out is at the nearer limit: Blender's own slider moves it there."""
        if self.kind == "menu":
            return self.default if self.default in self.options else self.options[0]
        if self.kind == "bool" or self.low is None or self.high is None:
            return self.default
        inside = [min(max(value, self.low), self.high) for value in _values(self.default)]
        return inside if isinstance(self.default, list) else inside[0]


def _values(default: Any) -> Sequence[Any]:
    return default if isinstance(default, list) else [default]


def sockets_of(records: Sequence[Mapping[str, Any]]) -> tuple[Socket, ...]:
    """The sockets that the program in Blender describes, with names for Python.

    Sockets of one name get that of their panel in front, and a number where that is not enough.
    """
    names = [str(record["name"]) for record in records]
    taken: set[str] = set()
    sockets = []
    for record, name in zip(records, names, strict=True):
        full = f"{record['panel']} {name}" if names.count(name) > 1 and record["panel"] else name
        argument = free = _argument(full)
        number = 1
        while free in taken:
            number += 1
            free = f"{argument}_{number}"
        taken.add(free)
        sockets.append(Socket(free, **{**record, "options": tuple(record["options"])}))
    return tuple(sockets)


def _argument(name: str) -> str:
    """A name for Python: "Leg Height" is leg_height."""
    plain = re.sub(r"\W+", "_", name.lower()).strip("_") or "socket"
    plain = plain if plain.isidentifier() else f"socket_{plain}"
    return f"{plain}_" if keyword.iskeyword(plain) else plain
