"""At which values of menus, booleans and small integers the other sockets of a node group matter: Blender tells it.

Since version 4.5 Blender greys out a socket that changes nothing. So each combination of these values is asked for.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from typing import Any

from shapewright.parameters.expressions import Expression
from shapewright.parameters.kinds import MOST_CLASSES
from shapewright.procedures.blender.sockets import Socket

_MOST = 256
"""Combinations that are asked for, at most: half a second."""


def conditions(
    sockets: Sequence[Socket],
    idle: Callable[[Mapping[str, Any]], Collection[str]],
    trials: Sequence[Mapping[str, Any]],
) -> dict[str, Expression]:
    """When a socket matters, by its argument; one that always does, or for which no such rule holds, is left out.

    Args:
        sockets: of the group.
        idle: the arguments of the sockets that change nothing at values of others, by argument.
        trials: values of all parameters. A rule that is wrong at one of them is none: other sockets decide as well.
    """
    switches = _switches(sockets)
    names = list(switches)
    found = {values: idle(dict(zip(names, values, strict=True))) for values in itertools.product(*switches.values())}
    rules: dict[str, Expression] = {}
    for name in [socket.argument for socket in sockets if not socket.held]:
        on = {values for values, at_rest in found.items() if name not in at_rest}
        others = [i for i, switch in enumerate(names) if switch != name and _decides(i, on, found)]
        if on and others:
            rules[name] = Expression(_text(on, others, switches))
    resting = [(trial, idle(trial)) for trial in trials] if rules else []
    return {
        name: rule for name, rule in rules.items() if all(rule(trial) or name in at_rest for trial, at_rest in resting)
    }


def _switches(sockets: Sequence[Socket]) -> dict[str, list[Any]]:
    """Values of the sockets that may decide about others; small integers as long as there are few combinations."""
    switches: dict[str, list[Any]] = {}
    for kinds in ({"bool", "menu"}, {"int"}):
        for socket in sockets:
            values = list(_values(socket)) if socket.kind in kinds and not socket.held else []
            if values and math.prod(map(len, [*switches.values(), values])) <= _MOST:
                switches[socket.argument] = values
    return switches


def _values(socket: Socket) -> Iterator[Any]:
    if socket.kind == "bool":
        yield from (False, True)
    elif socket.kind == "menu":
        yield from socket.options
    elif socket.low is not None and socket.high is not None and socket.high - socket.low < MOST_CLASSES:
        yield from range(int(socket.low), int(socket.high) + 1)


def _decides(place: int, on: Collection[tuple[Any, ...]], every: Collection[tuple[Any, ...]]) -> bool:
    """Whether the value at a place changes anything about what is on."""
    kept: dict[tuple[Any, ...], set[bool]] = {}
    for values in every:
        kept.setdefault((*values[:place], *values[place + 1 :]), set()).add(values in on)
    return any(len(states) > 1 for states in kept.values())


def _text(on: Collection[tuple[Any, ...]], places: Sequence[int], switches: Mapping[str, Sequence[Any]]) -> str:
    """The rule in Python: each value is among some, or one of them is, or each combination by itself."""
    names = [list(switches)[place] for place in places]
    every = [list(switches[name]) for name in names]
    rows = {tuple(values[place] for place in places) for values in on}
    off = set(itertools.product(*every)) - rows
    if columns := _product(rows, every):
        return " and ".join(map(_among, names, columns, every))
    if columns := _product(off, every):
        rest = [[value for value in all_ if value not in column] for all_, column in zip(every, columns, strict=True)]
        return " or ".join(map(_among, names, rest, every))
    each = (" and ".join(_among(n, [v], e) for n, v, e in zip(names, row, every, strict=True)) for row in rows)
    return " or ".join(sorted(each))


def _product(rows: Collection[tuple[Any, ...]], every: Sequence[Sequence[Any]]) -> list[list[Any]] | None:
    """Of which values of each the rows are all combinations; None where they are not."""
    columns = [[value for value in values if any(row[k] == value for row in rows)] for k, values in enumerate(every)]
    return columns if math.prod(map(len, columns)) == len(rows) else None


def _among(name: str, chosen: Sequence[Any], every: Sequence[Any]) -> str:
    if isinstance(every[0], bool):
        return name if chosen[0] else f"not {name}"
    if len(chosen) == 1:
        return f"{name} == {chosen[0]!r}"
    if isinstance(every[0], int) and list(every[-len(chosen) :]) == list(chosen):
        return f"{name} >= {chosen[0]}"
    if len(chosen) == len(every) - 1:
        return f"{name} != {next(value for value in every if value not in chosen)!r}"
    return f"{name} in {tuple(chosen)!r}"
