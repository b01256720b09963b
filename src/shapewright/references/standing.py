"""Up and front of references, found; the author's word is kept."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shapewright.references.orientation import AxesBy, Orientation
from shapewright.references.reference import Reference
from shapewright.shapes import Mesh, Points

if TYPE_CHECKING:
    from shapewright.axes.finding import Finding, Kind
    from shapewright.axes.looks import Looks

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
    references: Sequence[Reference],
    front: str | None = None,
    taught: Sequence[Mesh] = (),
    threads: int | None = None,
    recorded: Mapping[str, Mapping[str, Any]] | None = None,
) -> tuple[Reference, ...]:
    """The references as they are found to stand: meshes and points of which the author does not tell up and front.

    front: the axis of the files that points to the front, where the author says that. taught: shapes of the procedure
    that is to replicate them; they decide before all else. recorded: those that stay as a run found them, see
    ``found_axes``. What lies on its floor keeps its up. Drawings stay as they are.
    """
    from shapewright.axes.finding import Kind
    from shapewright.axes.looks import Looks

    known = recorded or {}
    given = [_as_given(each) for each in references]
    free = [i for i, each in enumerate(given) if is_free(each)]
    if any(given[i].name not in known for i in free):
        looks = Looks.of([shape for i in free if isinstance(shape := given[i].shape, Mesh | Points)], threads)
        axes = [(given[i].orientation, given[i].axes_by) for i in free]
        findings = found(axes, looks, front, Kind.taught(taught, threads))
        for i, finding in zip(free, findings, strict=True):
            given[i] = turned(given[i], finding)
    for i in free:
        if given[i].name in known:
            given[i] = recalled(given[i], known[given[i].name])
    return tuple(given)


def is_free(reference: Reference) -> bool:
    """Whether its up and front may be found: those of a mesh or points whose author does not tell them."""
    return reference.axes_by != "author" and isinstance(reference.shape, Mesh | Points)


def found(
    given: Sequence[tuple[Orientation, AxesBy]], looks: Looks, front: str | None, kind: Kind | None
) -> list[Finding]:
    """How each shape stands, by what is seen of it as it is given.

    given: the axes of their files that point up and to the front as they are, and who says so. front, kind: see
    ``stood``.
    """
    from shapewright.axes.finding import told as tell

    if front is None and all(by != "floor" for _, by in given):
        return tell(looks, None, kind)
    return tell(looks, np.array([_allowed(axes, by == "floor", front) for axes, by in given]), kind)


def _allowed(axes: Orientation, on_floor: bool, front: str | None) -> NDArray[np.bool_]:
    """(24,): turns that keep what is known; an author who tells a front that a floor rules out is right."""
    from shapewright.axes.turns import TURNS

    after = [axes.then(turn) for turn in TURNS]
    fronts = np.array([front in (None, each.front) for each in after])
    both = fronts & np.array([not on_floor or each.up == axes.up for each in after])
    return both if both.any() else fronts


def _as_given(reference: Reference) -> Reference:
    """Without what was found before."""
    from shapewright.axes.turns import INVERSE, TURNS

    if (before := reference.finding) is None:
        return reference
    return replace(reference.after(TURNS[INVERSE[before.turn]]), axes_by=reference.given_by, finding=None)


def turned(reference: Reference, finding: Finding) -> Reference:
    """A reference as it is given, turned as it was found to stand."""
    from shapewright.axes.turns import AS_IT_IS, TURNS

    given = replace(reference, finding=finding, given_by=reference.axes_by)
    return given if finding.turn == AS_IT_IS else replace(given.after(TURNS[finding.turn]), axes_by="found")


def recalled(reference: Reference, record: Mapping[str, Any]) -> Reference:
    """A reference as a record has it, one of ``found_axes``."""
    from shapewright.axes.finding import Finding
    from shapewright.axes.turns import turn_index

    given, orientation = _as_given(reference), recorded_orientation(record)
    finding = None
    if "sure_up" in record:
        turn = turn_index(orientation.matrix @ given.orientation.matrix.T)
        finding = Finding(turn, record["sure_up"], record["sure_front"], record["has_up"], record["fronts"])
    return replace(given.stood(orientation), axes_by=record["by"], finding=finding, given_by=given.axes_by)


def axes_record(reference: Reference) -> dict[str, Any]:
    """Up and front of a reference, who says so, and how sure that is, as plain values."""
    axes = {"up": reference.orientation.up, "front": reference.orientation.front, "by": reference.axes_by}
    if reference.finding is None:
        return axes
    found = asdict(reference.finding)
    sure = {"sure_up": round(found["up"], 3), "sure_front": round(found["front"], 3)}
    return {**axes, **sure, "has_up": found["has_up"], "fronts": found["fronts"]}


def found_axes(collection: Mapping[str, Any]) -> dict[str, Mapping[str, Any]]:
    """The axes that a run found, by name, in what it recorded of its collection.

    Those that the author told are none of them: what counts is what he tells now.
    """
    axes: Mapping[str, Mapping[str, Any]] = collection.get("axes") or {}
    return {name: record for name, record in axes.items() if record["by"] != "author"}


def recorded_orientation(record: Mapping[str, Any]) -> Orientation:
    """The orientation in an ``axes_record``."""
    return Orientation(record["up"], record["front"])
