"""Random draws of procfunc, recorded and set. ``caller.py`` loads this file where procfunc is, and no shapewright.

A draw is known by the places in the source through which the call went, and by how often it went there before. Its
value depends on nothing else, so that no draw moves another one.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import inspect
import itertools
import math
import sys
from collections.abc import Callable, Iterator
from typing import Any

SPREAD = 3.0
"""Standard deviations to each side of the mean that the range of a normal distribution has."""
_EVEN, _BELLS = ("uniform", "uniform_tails", "triangular", "randint"), ("normal", "clip_gaussian", "wrap_gaussian")
NUMBERS = (*_EVEN, *_BELLS, "log_uniform", "log_normal", "beta")
"""Draws of procfunc.random that have a range. The others stay as they are drawn."""


def called(
    function: Any, arguments: dict[str, Any], values: dict[str, Any], seed: int, middle: bool = False
) -> tuple[Any, list[dict[str, Any]]]:
    """What a function returns that takes ``rng``, and its draws; arguments that it does not take are left out."""
    import numpy as np

    takes = inspect.signature(function).parameters
    if "rng" not in takes:
        raise TypeError("it takes no rng, and draws nothing; say the ranges of its arguments under [parameters]")
    given = {name: value for name, value in arguments.items() if name in takes}
    records: list[dict[str, Any]] = []
    with in_place(records, values, seed, middle):
        return function(**{**given, "rng": np.random.default_rng(seed)}), records


@contextlib.contextmanager
def in_place(records: list[dict[str, Any]], values: dict[str, Any], seed: int, middle: bool) -> Iterator[None]:
    """Inside, draws have these values.

    Args:
        records: what is drawn inside is added to these.
        values: by the draws' keys: ``["value", number]``, ``["share", 0 to 1 of its range]``, ``["option", index]``.
        seed: of the draws that have no value here.
        middle: whether these have the middle of their range instead, or the option with the greatest weight.
    """
    import procfunc as library

    seen: dict[str, int] = {}
    patched = [(library.random, name) for name in NUMBERS] + [(library.control, "choice")]
    own = [getattr(module, name) for module, name in patched]
    for (module, name), function in zip(patched, own):  # noqa: B905 - Python 3.8
        draw = functools.partial(_drawn, name, function, inspect.signature(function), seen, records, values)
        setattr(module, name, functools.wraps(function)(_with_frame(draw, seed, middle)))
    try:
        yield
    finally:
        for (module, name), function in zip(patched, own):  # noqa: B905 - Python 3.8
            setattr(module, name, function)


def _with_frame(draw: Callable[..., Any], seed: int, middle: bool) -> Callable[..., Any]:
    def drawn(*args: Any, **kwargs: Any) -> Any:
        return draw(seed, middle, sys._getframe(1), args, kwargs)

    return drawn


def _drawn(
    kind: str,
    function: Callable[..., Any],
    signature: inspect.Signature,
    seen: dict[str, int],
    records: list[dict[str, Any]],
    values: dict[str, Any],
    seed: int,
    middle: bool,
    frame: Any,
    args: Any,
    kwargs: Any,
) -> Any:
    import numpy as np

    bound = signature.bind(*args, **kwargs)
    bound.apply_defaults()
    given = dict(bound.arguments)
    if given.get("chosen_idx") is not None or given.get("size") is not None:
        return function(*args, **kwargs)
    record = _site(frame, seen)
    stands = values.get(record["key"])
    rng = next(iter(given))
    own = np.random.default_rng([seed, *record["key"].encode()])
    records.append(record)
    if kind == "choice":
        options = list(given["choice_options"])
        weights = [float(weight) for _, weight in options]
        record["options"] = [_label(option, i) for i, (option, _) in enumerate(options)]
        record["held"] = record["held"] or any(_of_material(option) for option, _ in options)
        usual = (
            weights.index(max(weights)) if middle else int(own.choice(len(options), p=np.array(weights) / sum(weights)))
        )
        record["value"] = min(int(stands[1]), len(options) - 1) if stands else usual
        return options[record["value"]][0]
    record.update(_range(kind, given))
    if "low" not in record or (not stands and (record["held"] or not middle)):
        drawn = function(**{**given, rng: own})
    else:
        share = stands[1] if stands and stands[0] == "share" else 0.5
        drawn = stands[1] if stands and stands[0] == "value" else _between(record, share)
    record["value"] = drawn.item() if hasattr(drawn, "item") and getattr(drawn, "size", 1) == 1 else drawn
    if not isinstance(record["value"], (int, float)):
        record["value"] = None
        record.pop("low", None)
    return drawn


def _range(kind: str, given: dict[str, Any]) -> dict[str, Any]:
    """The range of a draw, empty where it has none."""
    try:
        low, high = given.get("low"), given.get("high")
        if kind in ("normal", "clip_gaussian"):
            low = given["mean"] - SPREAD * given["std"] if low is None else low
            high = given["mean"] + SPREAD * given["std"] if high is None else high
        elif kind == "log_normal":
            low, high = (given["mean"] * math.exp(sign * SPREAD * given["std"]) for sign in (-1, 1))
        elif kind == "beta":
            low, high = 0.0, 1.0
        low, high = float(low), float(high)  # type: ignore[arg-type]
    except (TypeError, ValueError):  # of vectors
        return {}
    if kind == "randint":
        return {"low": int(low), "high": int(high) - 1, "integer": True} if high - low > 1 else {}
    log = kind.startswith("log_") and low > 0.0
    return {"low": low, "high": high, "log": log} if math.isfinite(low + high) and low < high else {}


def _between(record: dict[str, Any], share: float) -> Any:
    low, high = record["low"], record["high"]
    if record.get("integer"):
        return min(int(low + share * (high + 1 - low)), high)
    return low * (high / low) ** share if record.get("log") else low + share * (high - low)


def _site(frame: Any, seen: dict[str, int]) -> dict[str, Any]:
    """Where a draw is: its key, its file, the line and the column where its call ends, and the way there."""
    file, function, (line, column) = frame.f_code.co_filename, frame.f_code.co_name, _end(frame)
    held, way = False, []
    inner = frame
    while inner is not None and inner.f_code.co_filename != __file__:
        module, name = inner.f_globals.get("__name__", ""), inner.f_code.co_name
        held = held or _names_material(module, name)
        if not module.startswith("procfunc"):
            way.append(f"{module}:{name}:" + ("" if inner is frame else "{}:{}".format(*_end(inner))))
        inner = inner.f_back
    outer = _digest(way)
    key = _digest([outer, str(line), str(column)])
    seen[key] = seen.get(key, 0) + 1
    key = f"{key}#{seen[key]}"
    place = {"file": file, "function": function, "line": line, "column": column}
    return {"key": key, "outer": outer, "held": held, **place}


def _end(frame: Any) -> tuple[int, int | None]:
    positions = getattr(frame.f_code, "co_positions", None)
    if positions is None:  # before Python 3.11
        return frame.f_lineno, None
    found = next(itertools.islice(positions(), frame.f_lasti // 2, None))
    return found[1] or frame.f_lineno, found[3]


def _digest(texts: list[str]) -> str:
    return hashlib.sha1("|".join(texts).encode()).hexdigest()[:12]


def _names_material(module: str, name: str) -> bool:
    return "shaders" in module.split(".") or "material" in name


def _inner(option: Any) -> Any:
    while hasattr(option, "__wrapped__") or isinstance(option, functools.partial):
        option = option.func if isinstance(option, functools.partial) else option.__wrapped__
    return option


def _of_material(option: Any) -> bool:
    inner = _inner(option)
    return callable(inner) and _names_material(getattr(inner, "__module__", "") or "", getattr(inner, "__name__", ""))


def _label(option: Any, index: int) -> Any:
    """What an option is called: its function, without what all their names have; itself, where it is plain."""
    if isinstance(option, (bool, int, float, str)) and option != "":
        return option
    name = getattr(_inner(option), "__name__", "")
    name = name.strip("_<>")
    return (name[:-5] if name.endswith("_rand") else name) or f"option_{index + 1}"
