"""Up and front of references, found; the author's word is kept."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from shapewright.references.orientation import Orientation
from shapewright.references.reference import Reference
from shapewright.shapes import Mesh

AUTO = "auto"
"""In place of an axis: it is to be found."""


def told(up: str, front: str | None) -> tuple[bool, str | None]:
    """Whether up is to be found, and the front that the author tells, as one of AXES where it is."""
    if up.strip().lower() != AUTO:
        return False, front
    if front is None:
        return True, None
    other = "y" if front.strip().lower().endswith("x") else "x"
    return True, Orientation.of(other, front).front


def stood(
    references: Sequence[Reference], front: str | None = None, taught: Sequence[Mesh] = (), threads: int | None = None
) -> tuple[Reference, ...]:
    """The references as they are found to stand: meshes of which the author does not tell up and front.

    front: the axis of the files that points to the front, where the author says that. taught: shapes of the procedure
    that is to replicate them; they decide before all else. Points and drawings stay as they are.
    """
    from shapewright.axes.finding import find
    from shapewright.axes.turns import AS_IT_IS, INVERSE, TURNS

    free = [i for i, each in enumerate(references) if each.axes_by != "author" and isinstance(each.shape, Mesh)]
    if not free:
        return tuple(references)
    given = list(references)
    for i in free:
        if (before := given[i].finding) is not None:
            given[i] = given[i].after(TURNS[INVERSE[before.turn]])
    allowed = None
    if front is not None:
        allowed = np.array([[given[i].orientation.then(turn).front == front for turn in TURNS] for i in free])
    shapes = [shape for i in free if isinstance(shape := given[i].shape, Mesh)]
    for i, finding in zip(free, find(shapes, allowed, taught, threads), strict=True):
        turned = given[i].after(TURNS[finding.turn]) if finding.turn != AS_IT_IS else given[i]
        by = "found" if finding.turn != AS_IT_IS else "default" if given[i].axes_by == "found" else given[i].axes_by
        given[i] = replace(turned, axes_by=by, finding=finding)
    return tuple(given)


def axes_record(reference: Reference) -> dict[str, Any]:
    """Up and front of a reference, who says so, and how sure that is, as plain values."""
    axes = {"up": reference.orientation.up, "front": reference.orientation.front, "by": reference.axes_by}
    if reference.finding is None:
        return axes
    found = asdict(reference.finding)
    sure = {"sure_up": round(found["up"], 3), "sure_front": round(found["front"], 3)}
    return {**axes, **sure, "has_up": found["has_up"], "fronts": found["fronts"]}


def recorded_orientation(record: Mapping[str, Any]) -> Orientation:
    """The orientation in an ``axes_record``."""
    return Orientation(record["up"], record["front"])
