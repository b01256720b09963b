"""Parameters as plain values, for files. A parameter's ``when`` is code: a record cannot keep it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from shapewright.parameters.kinds import Binary, Choice, Parameter, Scalar, whole_number

_KINDS: Mapping[str, Callable[..., Parameter]] = {
    "scalar": Scalar,
    "integer": whole_number,
    "choice": Choice,
    "binary": Binary,
}
_FIELDS = ("name", "low", "high", "steps", "options", "default", "log")


def to_record(parameter: Parameter) -> dict[str, Any]:
    """The kind and _FIELDS of a parameter, None where its kind has no such field; without its ``when``.

    A scalar of whole numbers is an integer, and ``log`` is there where it holds.
    """
    values = {name: getattr(parameter, name, None) for name in _FIELDS if name != "log"}
    plain = {name: list(value) if isinstance(value, tuple) else value for name, value in values.items()}
    if not isinstance(parameter, Scalar):
        return {"kind": type(parameter).__name__.lower(), **plain}
    return {"kind": "integer" if parameter.whole else "scalar", **plain, **({"log": True} if parameter.log else {})}


def from_record(record: Mapping[str, Any]) -> Parameter:
    """The inverse of ``to_record``: the parameter matters always, since no ``when`` is recorded."""
    given = {name: record[name] for name in _FIELDS if record.get(name) is not None}
    return _KINDS[record["kind"]](**{k: tuple(v) if isinstance(v, list) else v for k, v in given.items()})
