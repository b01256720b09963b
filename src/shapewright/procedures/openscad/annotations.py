"""What the Customizer's annotation of a value says: which values it may have, in the words of a Python signature.

The forms are those of the OpenSCAD manual's page "Customizer": ``// [0:10]``, ``// [0:0.5:10]``, ``// [10]``,
``// [a, b, c]``, ``// [10:Small, 20:Large]``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Annotated, Any, Literal, TypeAlias

from shapewright.parameters import Range

Plain: TypeAlias = bool | int | float | str
Literally: TypeAlias = Plain | tuple[int | float, ...]
"""What OpenSCAD calls a literal: a boolean, a number, a string, or a vector of numbers."""

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_LIST = re.compile(r"\s*\[(.*?)\]")
_LIMITS = re.compile(rf"\s*{NUMBER}\s*(?::\s*{NUMBER}\s*){{0,2}}")
_OPTION = re.compile(r'\s*(?:"([^"]*)"|([^:,]*?))\s*(?::([^,]*))?(?:,|$)')
_CHOSEN = 12
"""Whole numbers with a step, such as 4, 6, 8, are a choice up to this number of them: a model that asks for even
numbers gets no others. More of them are any whole number between the ends, so that what is learned of one helps for
the next."""


def hint(value: Literally, comment: str) -> tuple[Any, str]:
    """The annotation of a Python signature, and what there is to say of it, for a value and the comment behind it.

    The annotation is None where nothing says which values there are: the value is held. Said is what the options are
    called, and where the comment leaves the value out, which is taken in all the same: OpenSCAD builds it.
    Raises ValueError where the comment is in the form of an annotation, but is none for this value.
    """
    if isinstance(value, bool):
        return bool, ""
    listed = _LIST.match(comment)
    if listed is None:
        return None, ""
    inside = listed[1]
    if isinstance(value, tuple):
        if not _LIMITS.fullmatch(inside):
            return None, ""
        limits = tuple(_limits(inside, one) for one in value)
        if None in limits:
            return None, ""
        return tuple[limits], _left_out(inside, *value)  # type: ignore[valid-type]
    if not isinstance(value, str) and _LIMITS.fullmatch(inside):
        return _limits(inside, value), _left_out(inside, value)
    return _options(inside, value)


def number(text: str) -> int | float:
    """A number as it is written: one with a point or an exponent is no whole number."""
    return int(text) if re.fullmatch(r"[-+]?\d+", text.strip()) else float(text)


def _ends(inside: str) -> tuple[int | float, int | float]:
    first, *others = [number(part) for part in inside.split(":")]
    return (first, others[-1]) if others else (0, first)


def _left_out(inside: str, *values: int | float) -> str:
    low, high = _ends(inside)
    beyond = [value for value in values if not low <= value <= high]
    return _beside(inside, *beyond) if beyond else ""


def _beside(inside: str, *values: Plain) -> str:
    return f"its annotation [{inside}] leaves out {', '.join(map(str, values))}"


def _limits(inside: str, value: int | float) -> Any:
    numbers = [number(part) for part in inside.split(":")]
    low, high = _ends(inside)
    step = numbers[1] if len(numbers) == 3 else 1
    if low == high == value and len(numbers) > 1:
        return None  # a slider that cannot be moved
    if not low < high:
        raise ValueError(f"[{inside}] has no values; write the lower end first: [low:high] or [low:step:high]")
    if not step > 0:
        raise ValueError(f"[{inside}] has a step of {step:g}; write one above 0: [low:step:high]")
    low, high = min(low, value), max(high, value)
    if all(isinstance(one, int) for one in (value, low, high, step)):
        return Annotated[int, Range(low, high, _steps(int(low), int(high), int(step), int(value)))]
    count = (high - low) / step + 1
    given = len(numbers) == 3 and count >= 2 and abs(count - round(count)) < 1e-6
    return Annotated[float, Range(low, high, round(count) if given else None)]


def _steps(low: int, high: int, step: int, value: int) -> Sequence[float] | None:
    """The values of whole numbers with a step, the default among them; None where any number is one."""
    values = sorted({*range(low, high + 1, step), value})
    return values if step > 1 and len(values) <= _CHOSEN else None


def _options(inside: str, value: Plain) -> tuple[Any, str]:
    found: list[Plain] = []
    labels: list[str] = []
    strange: list[str] = []
    for match in _OPTION.finditer(inside):
        if match.end() == match.start():
            continue
        text = (match[2] if match[1] is None else match[1]) or ""
        if not text and match[1] is None:
            continue
        if isinstance(value, str):
            found.append(text)
        elif re.fullmatch(NUMBER, text):
            found.append(number(text))
        else:
            strange.append(text)
        if match[3] and match[3].strip() != text:
            labels.append(f"{text}: {match[3].strip()}")
    if not found or (isinstance(value, str) and len(found) < 2):
        return None, ""  # a remark, such as [mm], or what other customizers know, such as [image_surface:100x100]
    if strange:
        raise ValueError(f"[{inside}] is for a number, and {strange[0]!r} is none")
    if len(found) < 2:
        raise ValueError(f"[{inside}] has one value; write at least two, such as [a, b], or a range: [low:high]")
    if value not in found:
        found.append(value)
        labels.append(_beside(inside, value))
    return Literal[tuple(dict.fromkeys(found))], ", ".join(labels)
