"""Paints: plain colours, and gradients with the lines along which they turn from light to dark."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np
import shapely

from shapewright.references.readers.svg.coordinates import apply, inverse, matrix
from shapewright.shapes import Floats

LUMA = (0.299, 0.587, 0.114)
"""Of red, green and blue in what is seen (ITU-R BT.601)."""
_SAMPLES = 17
"""Of a gradient between two stops, to find where it crosses one half; the crossing is interpolated between them."""
_BANDS = np.arange(0.04, 1.0, 0.04).tolist()
"""Along a gradient that is not opaque: each band counts as even."""
_REPEATS = 40
"""How often a gradient is repeated, either way, at most."""
_CIRCLE = 64


@dataclass(frozen=True)
class Solid:
    """One colour.

    Attributes:
        rgb: from 0 to 1.
        alpha: from 0 to 1.
    """

    rgb: tuple[float, float, float]
    alpha: float = 1.0

    def faded(self, opacity: float) -> Solid:
        return replace(self, alpha=self.alpha * opacity)

    def shifted(self, by: Floats) -> Solid:
        """The same paint on what is moved by (2,)."""
        return self

    def at(self, points: Floats) -> tuple[Floats, Floats]:
        """(N, 3) colours and (N,) alphas at points of the page."""
        return np.tile(self.rgb, (len(points), 1)), np.full(len(points), self.alpha)

    def cuts(self, box: Floats) -> list[Any]:
        """Lines along which the paint turns from light to dark inside a box (2, 2)."""
        return []


@dataclass(frozen=True)
class Gradient:
    """A linear or radial gradient.

    Attributes:
        offsets: (S,) of the stops, ascending from 0 to 1.
        colours: (S, 4): red, green, blue and alpha of each.
        matrix: (3, 3) from the page to the gradient: there a linear one goes from x = 0 to 1.
        spread: what is before the first and after the last stop: "pad", "repeat" or "reflect".
        circles: of a radial one, in its space: focal x, y, radius, then outer x, y, radius.
    """

    offsets: Floats
    colours: Floats
    matrix: Floats
    spread: str
    circles: tuple[float, float, float, float, float, float] | None = None

    def faded(self, opacity: float) -> Gradient:
        return replace(self, colours=self.colours * [1.0, 1.0, 1.0, opacity])

    def shifted(self, by: Floats) -> Gradient:
        """The same paint on what is moved by (2,)."""
        return replace(self, matrix=self.matrix @ matrix(e=-by[0], f=-by[1]))

    def at(self, points: Floats) -> tuple[Floats, Floats]:
        """(N, 3) colours and (N,) alphas at points of the page."""
        place, drawn = self._place(apply(self.matrix, points))
        found = self._mixed(self._spread(place))
        return found[:, :3], np.where(drawn, found[:, 3], 0.0)

    def cuts(self, box: Floats) -> list[Any]:
        """Lines along which the paint turns from light to dark inside a box (2, 2), on the page."""
        corners = np.array([[x, y] for x in box[:, 0] for y in box[:, 1]])
        local = apply(self.matrix, corners)
        low, high = (0.0, 1.0) if self.spread == "pad" else self._reach(local)
        wanted = [turn + k for k in range(int(low), int(high) + 1) for turn in self._turns(k)]
        if self.spread == "pad":
            wanted = self._turns(0)
        back = inverse(self.matrix)
        lines = [shapely.LineString(apply(back, self._line(t, local))) for t in wanted if self._drawn(t)]
        kept: Any = shapely.intersection(lines, shapely.box(*box.ravel())) if lines else []
        return [line for line in shapely.get_parts(kept) if line.length > 0.0]

    def _turns(self, k: int) -> list[float]:
        """Places from 0 to 1 where light becomes dark, as on white paper or as a mask, in the k-th repeat."""
        edges = np.unique(np.concatenate([[0.0, 1.0], self.offsets]))
        t = np.unique(np.concatenate([np.linspace(a, b, _SAMPLES) for a, b in itertools.pairwise(edges)]))
        jumps = self.offsets[1:][np.diff(self.offsets) == 0.0].tolist()
        found = self._mixed(t)
        luma, alpha = found[:, :3] @ LUMA, found[:, 3]
        turns = [] if self.spread != "repeat" else [0.0]
        if (alpha < 1.0).any():  # what lies below shines through, and it is not known here where it is too dark
            turns += _BANDS
        for value in (alpha * luma - 0.5, 0.5 - alpha * (1.0 - luma), alpha - 0.5):
            i = np.flatnonzero((value[:-1] > 0.0) != (value[1:] > 0.0))
            turns += (t[i] - value[i] * (t[i + 1] - t[i]) / (value[i + 1] - value[i])).tolist()
        turns = sorted({*turns, *jumps})
        return [1.0 - turn for turn in turns] if self.spread == "reflect" and k % 2 else turns

    def _mixed(self, t: Floats) -> Floats:
        right = np.clip(np.searchsorted(self.offsets, t, "right"), 0, len(self.offsets))
        one, two = np.maximum(right - 1, 0), np.minimum(right, len(self.offsets) - 1)
        gap = self.offsets[two] - self.offsets[one]
        share = np.clip((t - self.offsets[one]) / np.where(gap > 0.0, gap, 1.0), 0.0, 1.0)[:, None]
        mixed: Floats = self.colours[one] * (1.0 - share) + self.colours[two] * share
        return mixed

    def _spread(self, t: Floats) -> Floats:
        if self.spread == "repeat":
            return t - np.floor(t)
        if self.spread == "reflect":
            return np.abs(t - 2.0 * np.round(t / 2.0))
        return t

    def _place(self, local: Floats) -> tuple[Floats, Any]:
        """Where along the gradient each point lies, and whether it is painted there."""
        if self.circles is None:
            return local[:, 0], np.ones(len(local), dtype=bool)
        fx, fy, fr, cx, cy, r = self.circles
        px, py, dx, dy, dr = local[:, 0] - fx, local[:, 1] - fy, cx - fx, cy - fy, r - fr
        a, b, c = dx * dx + dy * dy - dr * dr, px * dx + py * dy + fr * dr, px * px + py * py - fr * fr
        root = np.sqrt(np.maximum(b * b - a * c, 0.0))
        if abs(a) < 1e-12:
            t = c / np.where(b == 0.0, 1e-12, 2.0 * b)
            return t, fr + t * dr >= 0.0
        both = np.stack([(b + root) / a, (b - root) / a])
        both = np.where(fr + both * dr >= 0.0, both, -np.inf)
        t = both.max(axis=0)
        return np.where(np.isfinite(t), t, 0.0), np.isfinite(t) & (b * b - a * c >= 0.0)

    def _reach(self, local: Floats) -> tuple[float, float]:
        place, _ = self._place(local)
        low = min(float(place.min()), 0.0) if self.circles is None else 0.0
        return max(np.floor(low), -_REPEATS), min(np.ceil(float(place.max())), _REPEATS)

    def _drawn(self, t: float) -> bool:
        return self.circles is None or self.circles[2] + t * (self.circles[5] - self.circles[2]) > 0.0

    def _line(self, t: float, local: Floats) -> Floats:
        if self.circles is None:
            low, high = local[:, 1].min() - 1.0, local[:, 1].max() + 1.0
            return np.array([[t, low], [t, high]])
        fx, fy, fr, cx, cy, r = self.circles
        angle = np.linspace(0.0, 2.0 * np.pi, _CIRCLE + 1)
        centre, radius = np.array([fx + t * (cx - fx), fy + t * (cy - fy)]), fr + t * (r - fr)
        return centre + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


Paint: TypeAlias = Solid | Gradient
