"""What references have in common: groups by cause, and by where their surfaces differ."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.ndimage import gaussian_filter

from shapewright.comparison.grouping import group
from shapewright.feedback.causes.causes import Cause
from shapewright.feedback.surfaces.residuals import Residuals, Side
from shapewright.parameters import ParameterSpace
from shapewright.shapes import Floats

_CELLS = 8
_HALF = 0.75  # of the cube that the cells fill: a replica may reach beyond its reference
_ALIKE = 0.6  # one less the cosine of two signatures, up to which residuals are grouped
_STRUCTURE = ("missing part", "surplus part", "wrong form")


@dataclass(frozen=True, eq=False)
class Misfit:
    """The causes of one incompatible reference, and where its surface differs."""

    causes: tuple[Cause, ...]
    residuals: Residuals


def shared(space: ParameterSpace, misfits: Mapping[str, Misfit]) -> list[dict[str, Any]]:
    """Groups of references by cause, the largest first: kind, text, references, representative, and what else is known.

    References whose chief cause lies in the parts of the shape are grouped by where the surfaces differ as well; a
    reference may want several longer Ranges, and is then in several groups.
    """
    wishes = _ranges(space, misfits)
    kinds: dict[str, list[str]] = {}
    for name, misfit in misfits.items():
        if misfit.causes and misfit.causes[0].kind != "out of range":
            kinds.setdefault(misfit.causes[0].kind, []).append(name)
    others = [entry for kind, names in kinds.items() for entry in _of_kind(kind, names, misfits)]
    return sorted([*wishes, *others], key=lambda entry: -len(entry["references"]))


def signature(residuals: Residuals) -> Floats:
    """Where two surfaces differ, as a unit vector: shares of both sides' regions in blurred cells; 0 without any."""
    return _unit(np.concatenate([_filled(residuals, side).ravel() for side in ("unexplained", "surplus")]))


def _filled(residuals: Residuals, side: Side) -> Floats:
    cells = np.zeros((_CELLS,) * 3)
    for region in residuals.of(side):
        places = np.clip(((region.points + _HALF) / (2.0 * _HALF) * _CELLS).astype(int), 0, _CELLS - 1)
        np.add.at(cells, tuple(places.T), region.share / len(region.points))
    return np.asarray(gaussian_filter(cells, 0.8))


def _unit(vector: Floats) -> Floats:
    length = float(np.linalg.norm(vector))
    return vector / length if length > 0.0 else vector


def _of_kind(kind: str, names: Sequence[str], misfits: Mapping[str, Misfit]) -> list[dict[str, Any]]:
    if kind not in _STRUCTURE:
        return [_entry(kind, "", names, names[0])]
    signatures = np.array([signature(misfits[name].residuals) for name in names])
    between = np.clip(1.0 - signatures @ signatures.T, 0.0, None)
    np.fill_diagonal(between, 0.0)
    entries = []
    for alike in group(names, between, _ALIKE, absolute=True):
        label = misfits[alike.representative].causes[0].evidence.get("label")
        entries.append(_entry(kind, f" near {label}" if label else "", alike.members, alike.representative))
    return entries


def _entry(kind: str, where: str, names: Sequence[str], representative: str) -> dict[str, Any]:
    text = f"{kind}{where}: {_count(len(names))}"
    return {"kind": kind, "text": text, "references": list(names), "representative": representative}


def _ranges(space: ParameterSpace, misfits: Mapping[str, Misfit]) -> list[dict[str, Any]]:
    wishes: dict[tuple[str, str], dict[str, float]] = {}
    for name, misfit in misfits.items():
        for wish in (w for c in misfit.causes[:1] if c.kind == "out of range" for w in c.evidence["wishes"]):
            wishes.setdefault((wish["parameter"], wish["side"]), {})[name] = wish["value"]
    entries = []
    for (parameter, side), values in wishes.items():
        furthest = max(values, key=lambda name: values[name] if side == "high" else -values[name])
        value, end = values[furthest], getattr(space[parameter], side)
        verb, way = ("ends", "up") if side == "high" else ("starts", "down")
        want = "wants" if len(values) == 1 else "want"
        text = f"{parameter}: {_count(len(values))} {want} {way} to {value:.3g}; Range {verb} at {end:.4g}"
        entry = {"kind": "out of range", "text": text, "references": list(values), "representative": furthest}
        entries.append({**entry, "parameter": parameter, "side": side, "value": value, "end": end})
    return entries


def _count(count: int) -> str:
    return f"{count} reference{'' if count == 1 else 's'}"
