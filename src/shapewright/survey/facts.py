"""What is known of each reference of a collection, and of all together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal

import numpy as np

from shapewright.references import Reference
from shapewright.settings import Preparing
from shapewright.shapes import Drawing, Mesh, Points
from shapewright.survey.extras import found
from shapewright.survey.objects import objects
from shapewright.survey.pieces import Pieces

_OTHER_SIZE = 5.0
"""Times larger or smaller than the middle of its collection: perhaps another unit."""


@dataclass(frozen=True)
class Facts:
    """What is known of one reference.

    Attributes:
        name: its own.
        file: where it was read from; None for a shape made in memory.
        format: the extension of its file, such as GLB; empty without a file.
        kind: mesh, points, drawing, or views of an object.
        count: triangles, or points; None for others.
        pieces: how many parts of a mesh share no place; None for others.
        size: width, height and depth, of a drawing width and height.
        unit: of the size: metres where the file states one, else that of the file.
        up: the axis of the file that points up; empty for drawings.
        front: the axis that points to the front; empty for drawings.
        axes_by: who says so.
        seems: axes that it seems to have instead, as "z up, -y front", where that is likely enough and its author does
            not tell them; else empty. Nothing is turned for it.
        closed: whether every edge of a mesh has a face on either side; None for others.
        names: of its parts.
        notes: what was left out.
        odd: what may be wrong, in words.
    """

    name: str
    file: str | None
    format: str
    kind: Literal["mesh", "points", "drawing", "views"]
    count: int | None
    pieces: int | None
    size: tuple[float, ...]
    unit: Literal["m", "file's"]
    up: str
    front: str
    axes_by: str
    closed: bool | None
    names: tuple[str, ...]
    notes: tuple[str, ...]
    odd: tuple[str, ...]
    seems: str = ""

    def record(self) -> dict[str, Any]:
        """As plain values for JSON."""
        return {name: list(value) if isinstance(value, tuple) else value for name, value in asdict(self).items()}


def facts(reference: Reference, how: Preparing) -> Facts:
    """Of one reference that is prepared. how: what was left out already, and so is not told as odd."""
    shape, odd = reference.shape, list[str]()
    pieces = Pieces.of(shape) if isinstance(shape, Mesh) else None
    if pieces:
        extras = found(pieces)
        odd += [f"perhaps {extra.words}" for extra in extras]
        rest = np.setdiff1d(np.arange(len(pieces)), [i for extra in extras for i in extra.pieces])
        several = len(objects(pieces, rest)) if reference.part_of is None else 1
        odd += [f"{several} objects that stand apart"] if several > 1 else []
    is_flat = not isinstance(shape, Drawing)
    known = {Mesh: "mesh", Points: "points", Drawing: "drawing"}
    return Facts(
        name=reference.name,
        file=str(reference.path) if reference.path else None,
        format=reference.path.suffix[1:].upper() if reference.path else "",
        kind=known.get(type(shape), "views"),  # type: ignore[arg-type]
        count=len(shape.faces) if isinstance(shape, Mesh) else len(shape) if isinstance(shape, Points) else None,
        pieces=pieces.components if pieces else None,
        size=tuple(float(side) for side in reference.size),
        unit="m" if reference.unit else "file's",
        up=reference.orientation.up if is_flat else "",
        front=reference.orientation.front if is_flat else "",
        axes_by=reference.axes_by,
        closed=pieces.closed if pieces else None,
        names=pieces.names(range(len(pieces))) if pieces else (),
        notes=reference.notes,
        odd=tuple(odd),
    )


def other_sizes(known: Sequence[Facts]) -> dict[str, str]:
    """Of those that are much larger or smaller than most, in words, by name; each unit by itself."""
    told: dict[str, str] = {}
    for unit in ("m", "file's"):
        sides = {each.name: max(each.size) for each in known if each.unit == unit and each.kind != "drawing"}
        middle = float(np.median(list(sides.values()))) if len(sides) > 2 else 0.0
        for name, side in sides.items():
            if middle and side > _OTHER_SIZE * middle:
                told[name] = f"{side / middle:.3g} times as large as most: perhaps in another unit"
            elif middle and side < middle / _OTHER_SIZE:
                told[name] = f"{middle / side:.3g} times as small as most: perhaps in another unit"
    return told
