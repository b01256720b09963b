"""How pieces stand in shapes: relative to the bounding boxes of parts, as simply as the shapes that want them agree."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapewright.feedback.parts.pieces import Piece
from shapewright.shapes import Floats

WHOLE = ""
"""Stands for the whole shape among the frames, which are bounding boxes (2, 3) by label."""
NEW = "new "
"""Before the names of the rule's own pieces among the frames."""
INNER = "inner "
"""Before these, of pieces that stand on both sides: the box between the copies."""
Frames = Mapping[str, Floats]
Ends = tuple[tuple[str, int], tuple[str, int]]
"""The two sides that a piece reaches from and to, each as (frame, 0 for its low or 1 for its high side)."""

# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_TOUCHING = 0.5  # share of the misfits whose pieces have to touch a side
_AGREE = 0.5  # share of the misfits that have to agree
_FLUSH, _TOUCH = 0.045, 0.07  # of the whole's largest extent: how near sides are that are one, or touch
_LARGE = 1.3  # of a frame: it is no measure for what is larger
_ALIKE = 1.35  # greatest ratio of two sizes that are one
_SLIM = ("cylinder", "rod x", "rod z", "frustum", "foot", "sphere")  # as wide as the whole, they fill it no more
_THIN = 0.4  # of a piece's own size: sides further off are not its own, however near to each other they are


@dataclass(frozen=True)
class Along:
    """A piece along one axis of a frame."""

    size: str  # "full" or "free"
    place: str  # how it stands in the frame: "middle", "low", "high", "on", "under" or "free"
    ratios: Floats  # sizes in units of the frame, one a misfit
    offsets: Floats  # places in units of the frame, one a misfit
    ends: Ends | None = None  # where it reaches from and to; None for the frame itself
    unlike: float = 0.0  # share of the misfits that do not agree with the place

    @property
    def free(self) -> float:
        spread = np.ptp(np.quantile(self.ratios, [0.1, 0.9])) if self.size == "free" else 0.0
        moved = np.ptp(np.quantile(self.offsets, [0.1, 0.9])) if self.place == "free" else 0.0
        large = self.size == "free" and float(np.median(self.ratios)) > _LARGE
        count = (self.size == "free") + (self.place == "free") + large
        return count + self.unlike + 0.5 * float(spread + moved) + 0.3 * bool(self.ends)


def best_frame(several: Sequence[Piece], frames: Sequence[Frames]) -> tuple[str, tuple[Along, ...]]:
    """The frame that leaves least free; the whole shape on a tie."""
    shared = [name for name in frames[0] if not name.startswith(INNER) and all(name in each for each in frames)]
    found = {name: _along(several, frames, name, shared) for name in shared}
    best = min(
        (name for name in shared if not name.startswith(NEW)),
        key=lambda name: sum(axis.free for axis in found[name]) - 0.2 * (name == WHOLE),
    )
    return best, found[best]


def _along(several: Sequence[Piece], frames: Sequence[Frames], frame: str, shared: Sequence[str]) -> tuple[Along, ...]:
    boxes, wholes = [each[frame] for each in frames], [each[WHOLE] for each in frames]
    result = []
    for axis in range(3):
        low, high = (np.array([getattr(piece, end)[axis] for piece in several]) for end in ("low", "high"))
        start, end = (np.array([box[i, axis] for box in boxes]) for i in (0, 1))
        slack = _FLUSH * np.array([np.ptp(whole, axis=0).max() for whole in wholes])
        extent = np.maximum(end - start, 1e-6)
        mirrored = axis != 1 and several[0].mirrored[0 if axis == 0 else 1]
        places = {
            "middle": np.abs(low + high - start - end) / 2.0 < slack,
            "low": np.abs(low - start) < slack,
            "high": np.abs(high - end) < slack,
            "on": np.abs(low - end) < slack,
            "under": np.abs(high - start) < slack,
        }
        slim = several[0].kind in _SLIM and several[0].thin[axis]
        full = (not slim) & (np.abs(low - start) < slack) & (np.abs(high - end) < slack) & (high - low > 0.5 * extent)
        fills = full.mean() >= _AGREE and not mirrored
        ends = None if mirrored or fills else _ends(low, high, frames, axis, slack, shared)
        if fills or ends:
            half, unlike = np.full(len(several), 0.5), 1.0 - float(full.mean()) if fills else 0.0
            result.append(Along("full", "middle", 2.0 * half, half, ends, unlike))
            continue
        possible = ("high",) if mirrored else tuple(places)
        agreed = sorted((p for p in possible if places[p].mean() >= _AGREE), key=lambda p: -float(places[p].mean()))
        middle = (start + end) / 2.0
        offset = ((low + high) / 2.0 - middle) / extent * 2.0 if mirrored else ((low + high) / 2.0 - start) / extent
        place, unlike = (agreed[0], 1.0 - float(places[agreed[0]].mean())) if agreed else ("free", 0.0)
        result.append(Along("free", place, (high - low) / extent, offset, unlike=unlike))
    return tuple(result)


def _ends(
    low: Floats, high: Floats, frames: Sequence[Frames], axis: int, slack: Floats, shared: Sequence[str]
) -> Ends | None:
    """The sides of parts that pieces reach from and to, where these are two different ones.

    A piece between the copies of another reaches from the outer side of one to that of the other, so that they meet.
    """
    for name in shared:
        if all(f"{INNER}{name}" in each for each in frames):
            outer, inner = (np.array([each[key][:, axis] for each in frames]) for key in (name, f"{INNER}{name}"))
            begins = (low > outer[:, 0] - slack) & (low < inner[:, 0] + slack)
            ends = (high < outer[:, 1] + slack) & (high > inner[:, 1] - slack)
            if (outer != inner).any() and (begins & ends).mean() >= _AGREE:
                return (name, 0), (name, 1)
    chosen: list[tuple[str, int]] = []
    near = np.minimum(slack * (_TOUCH / _FLUSH), np.maximum(_THIN * (high - low), 0.2 * slack))
    for end in (low, high):
        best, least = None, np.inf
        for name in shared:
            for side in (0, 1):
                if axis != 1 and name != WHOLE:
                    continue
                off = np.abs(end - np.array([each[name][side, axis] for each in frames]))
                error = float(np.minimum(off, 2.0 * slack).mean()) - 1e-3 * float(slack.mean()) * (name == WHOLE)
                if (off < near).mean() >= _TOUCHING and error < least:
                    best, least = (name, side), error
        if best is None:
            return None
        chosen.append(best)
    return (chosen[0], chosen[1]) if chosen[0] != chosen[1] else None


def made_bounds(piece: Piece, frame: str, along: Sequence[Along], frames: Frames) -> Floats:
    """The box (2, 3) of a piece and its copies that a rule makes which says its place in this way."""
    low, high = piece.low.copy(), piece.high.copy()
    for axis, here in enumerate(along):
        start, end = frames[frame][:, axis]
        if here.ends:
            start, end = (frames[name][side, axis] for name, side in here.ends)
        half = (end - start if here.size == "full" else high[axis] - low[axis]) / 2.0
        middle = {
            "middle": (start + end) / 2.0,
            "low": start + half,
            "high": end - half,
            "on": end + half,
            "under": start - half,
            "free": (low[axis] + high[axis]) / 2.0,
        }[here.place]
        low[axis], high[axis] = middle - half, middle + half
    x, z = frames[frame].mean(axis=0)[[0, 2]]  # copies are mirrored about the frame
    return replace(piece, low=low, high=high, middle=(float(x), float(z))).outer


def inside_of(piece: Piece, outer: Floats) -> Floats:
    """The box (2, 3) between a piece's copies, given the box around them all."""
    inner = outer.copy()
    for axis, mirrored in ((0, piece.mirrored[0]), (2, piece.mirrored[1])):
        if mirrored:
            inner[0, axis] += piece.size[axis]
            inner[1, axis] -= piece.size[axis]
    return inner


def equal_sizes(several: Sequence[Piece], along: Sequence[Along]) -> dict[int, int]:
    """Axes along which the piece is as large as along an earlier one, where both are free."""
    sizes = np.array([piece.size for piece in several])
    shared: dict[int, int] = {}
    for second in (1, 2):
        for first in range(second):
            if along[first].size == along[second].size == "free" and first not in shared:
                ratio = sizes[:, second] / sizes[:, first]
                if ((ratio < _ALIKE) & (ratio > 1.0 / _ALIKE)).mean() >= _AGREE:
                    shared.setdefault(second, first)
    return shared
