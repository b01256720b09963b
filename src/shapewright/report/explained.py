"""What the report shows of an explanation: badges, outlines of regions over the thumbnails, cards of suggestions."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.judging.verdict import Grade
from shapewright.rendering.cameras import THUMBNAIL
from shapewright.runs.folder import EXPLANATION, read_json
from shapewright.shapes import Floats

PICTURES = "suggestions"
SHOWN = 6
"""Regions drawn on a pair of thumbnails, at most; a record lists the weightiest first."""
_EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if (a ^ b) in (1, 2, 4)]


def read_explanation(folder: Path) -> dict[str, Any] | None:
    """The record of an explanation in a folder, None where there is none; pictures as data that a page can hold."""
    path = folder / EXPLANATION
    if not path.is_file():
        return None
    record = read_json(path)
    seconds = record.get("seconds", {})
    record["sought"] = sum(seconds.get(stage, 0.0) for stage in ("hypotheses", "trials"))
    record.setdefault("tried", [])
    for suggestion in record["suggestions"]:
        suggestion["diff"] = followed(suggestion.get("diff", []))
        picture = folder / suggestion["picture"] if suggestion.get("picture") else None
        suggestion["picture"] = embedded(picture.read_bytes()) if picture and picture.is_file() else None
    return record


def followed(lines: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """The lines of a difference, each with whether nothing is left out before it."""
    told, before, after = [], 0, 0
    for line in lines:
        follows = line["before"] == before + 1 if line["before"] else line["after"] == after + 1
        told.append({**line, "follows": follows})
        before, after = line["before"] or before, line["after"] or after
    return told


def quiet(told: Mapping[str, Any] | None, grade: Grade) -> str | None:
    """What still differs in a replica that is good enough, or close."""
    if told is None or grade == "different":
        return None
    found = told.get("remark") if grade == "replicated" else next(iter(told["causes"]), None)
    return str(found["text"]) if found else None


def embedded(picture: bytes) -> str:
    """A PNG as the address of an image that a page holds itself."""
    return "data:image/png;base64," + base64.b64encode(picture).decode()


def told_cause(cause: Mapping[str, Any]) -> dict[str, Any]:
    """Its kind, its text and the address of its picture, None where it has none."""
    picture = f"data:image/png;base64,{cause['picture']}" if cause.get("picture") else None
    return {"kind": cause["kind"], "text": cause["text"], "picture": picture}


def outlines(reference: Mapping[str, Any]) -> tuple[list[str], list[str]]:
    """Paths, in a picture of 100 x 100, of the regions on the reference's thumbnail and on the replica's."""
    placement = reference.get("placement") or {"centre": [0.0, 0.0, 0.0], "scale": 1.0}
    centre, scale = np.array(placement["centre"]), float(placement["scale"])
    on: dict[str, list[str]] = {"unexplained": [], "surplus": []}
    for region in reference["regions"][:SHOWN]:
        corners = _corners(region)
        if region["side"] == "surplus":
            corners = corners / scale + centre
        on[region["side"]].append(_frame(corners) if reference.get("dimensions") == 2 else _path(corners))
    return on["unexplained"], on["surplus"]


def boxes(reference: Mapping[str, Any]) -> tuple[list[str], list[str]]:
    """The same of the regions that the judge found; entries of a run's record."""
    kinds = ("missing", "surplus")
    if len(reference.get("places", ())) > 1:  # regions are those of the first picture, of several in a thumbnail
        return [], []
    missing, surplus = (
        [_outline(_box(region), reference) for region in reference.get(kind, ())[:SHOWN]] for kind in kinds
    )
    return missing, surplus


def _box(region: Mapping[str, Any]) -> Floats:
    """(8, 3): see ``_corners``."""
    return np.array(list(product(*zip(region["low"], region["high"], strict=True))), dtype=np.float64)


def _outline(corners: Floats, reference: Mapping[str, Any]) -> str:
    flat = (reference.get("replica") or "").endswith(".svg") or bool(reference.get("places"))
    return _frame(corners) if flat else _path(corners)


def _corners(region: Mapping[str, Any]) -> Floats:
    """(8, 3): neighbours along an axis differ in one bit of their index."""
    half = np.array(list(product((-0.5, 0.5), repeat=3))) * np.array(region["size"])
    return np.asarray(np.array(region["centre"]) + half @ np.array(region["axes"]))


def _path(corners: Floats) -> str:
    """The edges of a box as an SVG path."""
    column, row, _ = THUMBNAIL.project(corners, 100)
    return "".join(f"M{column[a]:.1f} {row[a]:.1f}L{column[b]:.1f} {row[b]:.1f}" for a, b in _EDGES)


def _frame(corners: Floats) -> str:
    """The box around a region of a drawing as an SVG path, on a thumbnail of it."""
    from shapewright.rendering.ink import HALF  # numba, which the studio's server does without
    from shapewright.rendering.thumbnails import DRAWN

    places = corners[:, :2] * [1.0, -1.0] * DRAWN / (2.0 * HALF) + 0.5
    low, high = places.min(axis=0) * 100.0, places.max(axis=0) * 100.0
    return f"M{low[0]:.1f} {low[1]:.1f}H{high[0]:.1f}V{high[1]:.1f}H{low[0]:.1f}Z"
