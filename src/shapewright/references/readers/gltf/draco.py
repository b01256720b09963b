"""Triangles that are compressed by Draco."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shapewright.references.errors import UnreadableError
from shapewright.shapes import Ints


@dataclass(frozen=True, eq=False)
class Decoded:
    """What a Draco stream holds.

    Attributes:
        faces: (F, 3).
        attributes: the values (V, width) of each attribute, by its number in the stream.
    """

    faces: Ints
    attributes: dict[int, NDArray[Any]]


Streams = Callable[[int], Decoded]
"""What the stream in a buffer view holds."""


def decode(data: memoryview) -> Decoded:
    """The triangles of a stream. Raises UnreadableError where it cannot be decompressed."""
    import DracoPy

    try:
        mesh = DracoPy.decode(bytes(data))
    except MemoryError:
        raise
    except Exception as error:  # whatever the library raises, the stream is broken
        raise UnreadableError(f"broken: its Draco compression cannot be read ({error})") from error
    faces = np.asarray(getattr(mesh, "faces", np.empty((0, 3))), dtype=np.int64).reshape(-1, 3)
    return Decoded(faces, {int(a["unique_id"]): np.asarray(a["data"]) for a in mesh.attributes})
