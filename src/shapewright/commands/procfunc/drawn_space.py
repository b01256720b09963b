"""The space that the random draws of a function are: what it draws, tried with one option after the other."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

from shapewright.commands.entries import identifier
from shapewright.commands.procfunc.naming import Site
from shapewright.parameters.expressions import Expression

Record = Mapping[str, Any]
"""What ``draws.py`` says of one draw."""
Forced = dict[str, tuple[str, Any]]
"""Values of draws by their keys, as ``draws.py`` takes them."""
MOST_RUNS = 60
"""Calls at most by which a space is read. chair_rand of Infinigen 2.0.0a3 takes 21."""
FEW = 8
"""A whole number with at most so many values is tried with each: it says how often something else is drawn."""


@dataclass(frozen=True)
class Draw:
    """A draw that is a parameter.

    Attributes:
        key: by which the other Python knows it.
        kind: what it is given: its value, its share of a range that depends on other draws, or the index of an option.
        table: what a spec would say of it.
        options: the values of the parameter for the options.
        conditions: what has to hold, so that it is drawn: the other parameter, and the condition.
    """

    key: str
    kind: Literal["value", "share", "option"]
    table: Mapping[str, Any]
    options: tuple[Any, ...] = ()
    conditions: tuple[tuple[str, str], ...] = ()

    def given(self, value: Any) -> tuple[str, Any]:
        """What the other Python gets for a value of the parameter."""
        return self.kind, self.options.index(value) if self.kind == "option" else value


@dataclass
class _Tried:
    """What is known of a function: all that was drawn, and what depended on one draw alone."""

    runs: list[dict[str, Record]] = field(default_factory=list)
    groups: dict[str, dict[Any, dict[str, Record]]] = field(default_factory=dict)
    contexts: list[Forced] = field(default_factory=list)


def read_draws(
    run: Callable[[Forced, int | None], Sequence[Record]], site_of: Callable[[Record], Site]
) -> dict[str, Draw]:
    """The draws of a function that are parameters, by their names.

    Those that matter to materials only are none. Neither are those that were drawn in some calls and not in others,
    for no reason that an option or a whole number tells.

    Args:
        run: what is drawn with given values; others have the middle of their ranges, or are drawn with a seed.
        site_of: what the source says of a draw.
    """
    tried = _tried(lambda forced, seed: {each["key"]: each for each in run(forced, seed)}, site_of)
    records = {key: each for there in reversed(tried.runs) for key, each in there.items()}
    order = dict.fromkeys(key for there in tried.runs for key in there)
    steady = {key for there in tried.runs[: len(tried.runs) - len(tried.contexts)] for key in there}
    sites = {key: site_of(records[key]) for key in order}
    kept = [key for key in order if key in steady and not _held(records[key], sites[key]) and _ranged(records[key])]
    names = dict(zip(kept, _names([(records[key], sites[key]) for key in kept]), strict=True))
    parts = {key: _part([there[key] for there in tried.runs if key in there], sites[key]) for key in kept}
    made: dict[str, Draw] = {}
    for key, name in names.items():
        kind, options, table = parts[key]
        conditions = _conditions(key, tried.groups, names, parts)
        within = _within(records[key], sites[key], records)
        if within in names and parts[within][0] == "option":
            other = names[within]
            conditions.append((other, f"{other} == {parts[within][1][sites[key].option]!r}"))
        place = f"{Path(records[key]['file']).name}:{records[key]['line']}"
        said = {"description": f"{sites[key].function or records[key]['function']}, {place}"}
        made[name] = Draw(key, kind, {**table, **said}, options, tuple(dict.fromkeys(conditions)))
    return settled(made, {})


def settled(draws: Mapping[str, Draw], fixed: Mapping[str, Any]) -> dict[str, Draw]:
    """The draws where some are fixed, with their conditions in their tables; those that are never made so are left out.

    fixed: values of parameters, by their names.
    """
    known = dict(fixed)  # and what is never drawn counts with its default
    while gone := [name for name, draw in draws.items() if name not in known and _fails(draw, known)]:
        known.update({name: draws[name].table.get("default") for name in gone})
    made = {}
    for name, draw in draws.items():
        if name in fixed or name not in known:
            texts = [text for other, text in draw.conditions if other not in known]
            texts = [f"({text})" if " or " in text and len(texts) > 1 else text for text in texts]
            table = {key: value for key, value in draw.table.items() if key != "when"}
            made[name] = replace(draw, table={**table, "when": " and ".join(texts)} if texts else table)
    return made


def _fails(draw: Draw, known: Mapping[str, Any]) -> bool:
    return any(other in known and not Expression(text)({other: known[other]}) for other, text in draw.conditions)


def _tried(run: Callable[[Forced, int | None], dict[str, Record]], site_of: Callable[[Record], Site]) -> _Tried:
    first = run({}, None)
    tried = _Tried([first], {}, [{}])
    known = set(first)
    waiting: list[tuple[str, Forced, dict[str, Record]]] = [(key, {}, first) for key in first]
    while waiting:
        key, forced, there = waiting.pop(0)
        if _held(there[key], site_of(there[key])):
            continue
        group = {there[key]["value"]: there}
        for value, given in _others(there[key]):
            if len(tried.runs) >= MOST_RUNS:
                break
            here = run({**forced, key: given}, None)
            tried.runs.append(here)
            group[value] = here
            if new := [other for other in here if other not in known]:
                known.update(new)
                tried.contexts.append({**forced, key: given})
                waiting += [(other, tried.contexts[-1], here) for other in new]
        tried.groups[key] = group
    tried.runs += [run(forced, seed) for seed, forced in enumerate(tried.contexts)]
    return tried


def _others(record: Record) -> list[tuple[Any, tuple[str, Any]]]:
    """The other values of a draw on which other draws may depend, and how they are given."""
    if "options" in record:
        return [(i, ("option", i)) for i in range(len(record["options"])) if i != record["value"]]
    if record.get("integer") and record["high"] - record["low"] < FEW:
        values = range(record["low"], record["high"] + 1)
        return [(value, ("value", value)) for value in values if value != record["value"]]
    return []


def _ranged(record: Record) -> bool:
    return "low" in record or len(record.get("options", ())) > 1


def _held(record: Record, site: Site) -> bool:
    return bool(record["held"]) or "material" in site.name


def _names(draws: Sequence[tuple[Record, Site]]) -> list[str]:
    """A name for each, by what the source says; those that would be the same get numbers, in their order."""
    plain = [
        identifier(site.name or (site.function or record["function"]).strip("_<>").removesuffix("_rand"))
        for record, site in draws
    ]
    names: list[str] = []
    for name in plain:
        again = Counter(names)
        number = 2
        unique = name
        while again[unique] or (number > 2 and unique in plain):
            unique, number = f"{name}_{number}", number + 1
        names.append(unique)
    return names


def _part(
    found: Sequence[Record], site: Site
) -> tuple[Literal["value", "share", "option"], tuple[Any, ...], dict[str, Any]]:
    """How a draw is given, its options, and its table. found: it in all calls in which it was drawn."""
    first = found[0]
    if "options" in first:
        options = _options([tuple(each["options"]) for each in found], site)
        usual = options[min(first["value"], len(options) - 1)]
        if set(options) == {True, False} and all(isinstance(each, bool) for each in options):
            return "option", options, {"bool": True, "default": usual}
        return "option", options, {"choices": list(options), "default": usual}
    low, high = first["low"], first["high"]
    if any("low" not in each or (each["low"], each["high"]) != (low, high) for each in found):
        return "share", (), {"range": [0.0, 1.0]}
    table: dict[str, Any] = {"range": [low, high]}
    if first.get("integer"):
        return "value", (), {**table, "integer": True, "default": first["value"]}
    return "value", (), {**table, "log": True} if first.get("log") else table


def _options(found: Sequence[tuple[Any, ...]], site: Site) -> tuple[Any, ...]:
    """What the options are called: one that differs from call to call by its variable, or else "drawn"."""
    count = min(len(each) for each in found)
    variables = site.options if len(site.options) == count else ("",) * count
    labels = [
        found[0][i] if len({repr(each[i]) for each in found}) == 1 else variables[i] or "drawn" for i in range(count)
    ]
    if len({type(label) for label in labels}) > 1:
        labels = [str(label) for label in labels]
    twice = [label for label, times in Counter(labels).items() if times > 1]
    return tuple(f"{label}_{i + 1}" if label in twice else label for i, label in enumerate(labels))


def _within(record: Record, site: Site, records: Mapping[str, Record]) -> str | None:
    """The key of the choice among whose options a draw stands."""
    if site.choice is None:
        return None
    number = record["key"].partition("#")[2]
    return next(
        (
            key
            for key, other in records.items()
            if other["outer"] == record["outer"]
            and (other["line"], other["column"]) == site.choice
            and key.partition("#")[2] == number
        ),
        None,
    )


def _conditions(
    key: str,
    groups: Mapping[str, Mapping[Any, Mapping[str, Record]]],
    names: Mapping[str, str],
    parts: Mapping[str, tuple[str, tuple[Any, ...], dict[str, Any]]],
) -> list[tuple[str, str]]:
    """What has to hold of other draws, so that this one is drawn."""
    found = []
    for other, group in groups.items():
        with_it = sorted(value for value, there in group.items() if key in there)
        if other == key or other not in names or not 0 < len(with_it) < len(group) or parts[other][0] == "share":
            continue
        name = names[other]
        if parts[other][0] == "option":
            options = tuple(parts[other][1][i] for i in with_it)
            text = f"{name} == {options[0]!r}" if len(options) == 1 else f"{name} in {options!r}"
        elif with_it == sorted(group)[-len(with_it) :]:
            text = f"{name} >= {with_it[0]}"
        else:
            text = " or ".join(f"{name} == {value}" for value in with_it)
        found.append((name, text))
    return found
