"""Words that the messages of the page and the server share."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias, TypeVar

import msgspec
import numpy as np
from msgspec import Meta, Struct

from shapewright.parameters import Value as ParameterValue

Slug: TypeAlias = Annotated[str, Meta(title="Slug")]
"""Addresses a reference: letters, digits, ``-`` and ``_``, unique in the collection. People read its name instead."""
Value: TypeAlias = Annotated[ParameterValue, Meta(title="Value")]
Values: TypeAlias = Annotated[dict[str, Value], Meta(title="Values")]
"""Parameters of one shape by name, in the procedure's own units."""
Vector: TypeAlias = Annotated[tuple[float, float, float], Meta(title="Vector")]
Axis: TypeAlias = Annotated[Literal["x", "-x", "y", "-y", "z", "-z"], Meta(title="Axis")]
"""Of a file."""
Address: TypeAlias = Annotated[str, Meta(title="Address")]
"""A path on this server, such as ``/api/pictures/1f0c.png``: a picture there never changes."""
Kind = TypeVar("Kind", bound=Struct)


class Message(Struct, frozen=True, kw_only=True, tag_field="type"):
    """One message of the WebSocket. Its ``type`` says which."""


def message_of(kind: type[Kind], source: object, **others: Any) -> Kind:
    """A message of a kind: some fields are given, others are what ``source`` has under the same name."""
    shared = {name: getattr(source, name) for name in kind.__struct_fields__ if hasattr(source, name)}
    return kind(**{**shared, **others})


def encode(message: Any) -> bytes:
    """A message as JSON; numbers that are not finite become null."""
    return msgspec.json.encode(message, enc_hook=_plain)


def _plain(value: Any) -> Any:
    """The Python number of one of numpy's."""
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} has no form in JSON")
