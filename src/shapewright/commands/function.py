"""A spec as a function: called as an author's is, by keywords with values of the space."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from shapewright.commands.spec import Spec
from shapewright.procedures import Infeasible, Place


@dataclass(frozen=True)
class Function:
    """What makes shapes as a spec says.

    Attributes:
        spec: what it says.
        make: the shape, of the spec and the values of the parameters.
    """

    spec: Spec
    make: Callable[[Spec, dict[str, Any]], Any]

    @property
    def __name__(self) -> str:
        return self.spec.name

    @property
    def __signature__(self) -> inspect.Signature:
        return inspect.Signature(self.spec.entries.parameters)

    @property
    def own_names(self) -> Mapping[str, str]:
        """What the tool calls its parameters."""
        return self.spec.entries.names

    @property
    def place(self) -> Place | None:
        """The line that says what is run or called."""
        return self.spec.place

    def __call__(self, **values: Any) -> Any:
        return self.make(self.spec, values)


def arguments(spec: Spec, values: dict[str, Any]) -> dict[str, Any]:
    """What the tool gets, by the names that it knows. Raises Infeasible where a constraint does not hold."""
    for constraint in spec.constraints:
        if not constraint(values):
            raise Infeasible(f"it does not hold that {constraint.text}")
    return {spec.entries.names[name]: value for name, value in values.items()} | dict(spec.entries.fixed)
