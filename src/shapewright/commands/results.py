"""The file that a program leaves: its shape, and what is wrong where it leaves none."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from shapewright.procedures import Facts, Place, ProcedureError
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import contents
from shapewright.shapes import Drawing, Mesh, Shape

_CLOCKS = 2.0
"""Seconds by which the times of files may be coarser than the clock: FAT has 2."""
_SHOWN = 5
"""Other files that a message names at most."""


def shape_of(out: Path, facts: Facts, started: float, place: Place | None, up: str | None = None) -> Shape:
    """The shape of a file, in the axes and the unit of the facts, with names of parts as labels.

    A file whose format states its axis that points up, or its unit, as glTF does, is taken by its word.
    Raises ProcedureError where there is no file, an old one, one that cannot be read, or one without surfaces.

    Args:
        out: the file.
        facts: what the author says of all shapes.
        started: the time at which the program was started, as ``time.time()`` gives it.
        place: the author's line, for the error.
        up: the axis that points up in the file, where the program knows it and its format does not state it.
    """
    try:
        written = out.stat()
    except OSError as error:
        others = sorted(path.name for path in out.parent.iterdir() if path.name != "params.json")
        instead = f"; it wrote {', '.join(others[:_SHOWN])}" if others else "; it wrote nothing"
        raise ProcedureError(f"the program ended well, but there is no {out.name}{instead}", place) from error
    if written.st_mtime < started - _CLOCKS:
        raise ProcedureError(f"the program left an old {out.name}: it was written before the program began", place)
    if not written.st_size:
        raise ProcedureError(f"the program left an empty {out.name}", place)
    try:
        found = contents(out)
    except UnreadableError as error:
        raise ProcedureError(f"what the program wrote is no shape: {out.name}: {error}", place) from error
    shape = found.shape
    if not isinstance(shape, Mesh | Drawing):
        raise ProcedureError(f"the program wrote points into {out.name}; a shape needs surfaces", place)
    if (axis := found.up or up) is not None and isinstance(shape, Mesh):
        shape = facts.laid(Facts.of({"up": axis}).stood(shape))
    if found.unit and facts.metres and isinstance(shape, Mesh):
        shape = shape.transformed(np.eye(3) * (found.unit / facts.metres))
    return shape
