"""Which shapes an author looks at who explores a procedure: random ones, or a grid along one or two parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

from shapewright.parameters import Parameters, ParameterSpace, Value
from shapewright.studio.wire.requests import Explore

_ROW, _SIDE = 12, 7
"""Values of a parameter that varies alone, and of each of two: more do not fit on a screen."""


@dataclass(frozen=True)
class Plan:
    """Parameters of shapes.

    Attributes:
        shapes: of each.
        along: the parameters that these go along with their values, the last one fastest; empty where they are random.
    """

    shapes: tuple[Parameters, ...]
    along: tuple[tuple[str, tuple[Value, ...]], ...] = ()


def planned(space: ParameterSpace, order: Explore) -> Plan:
    """The shapes that are asked for; names that the space has not are passed over. Raises ValueError of a ``when``."""
    names = [name for name in dict.fromkeys(order.vary) if name in space.names]
    if not names:
        return Plan(tuple(space.draw(order.count, order.seed, order.locked)))
    most = _ROW if len(names) == 1 else _SIDE
    values = [_spread(space, name, most) for name in names]
    base = {**(order.base or {}), **order.locked}
    cells = ({**base, **dict(zip(names, cell, strict=True))} for cell in product(*values))
    return Plan(tuple(space.carry(cell) for cell in cells), tuple(zip(names, values, strict=True)))


def _spread(space: ParameterSpace, name: str, most: int) -> tuple[Value, ...]:
    """All values of a parameter, or so many of them from one end of its Range to the other."""
    parameter = space[name]
    levels: Sequence[Value] | None = parameter.levels
    if levels is not None and (len(levels) <= most or not isinstance(levels[0], int | float)):
        return tuple(levels[:most])
    count = parameter.classes - 1 if parameter.classes else 1
    spread = (parameter.decode(count * i / (most - 1)) for i in range(most))
    return tuple(dict.fromkeys(spread))
