"""Proportions of a reference against those that a procedure can make."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from scipy.stats import spearmanr

from shapewright.building import Workers
from shapewright.parameters import Integer, Parameters, ParameterSpace, Scalar, Side
from shapewright.shapes import Floats, Mesh

WORDS = ("wide", "tall", "deep")
"""Of the axes X, Y and Z."""
# By trial on tables and lamps.
_SAMPLES = 96  # random shapes that tell what a procedure makes
_PUSHED = 4  # of these, the most extreme of either way, whose numbers are moved to the ends of their Ranges
_MOVES = 0.2  # rank correlation from which a number is moved with a proportion
_GOVERNS = 0.45  # and from which it is named
_BEYOND = 1.06  # times what a procedure makes at most, from which a proportion is beyond it


@dataclass(frozen=True)
class Limit:
    """The end of a Range that keeps a proportion from growing."""

    parameter: str
    end: float  # of the Range
    side: Side  # which end that is


@dataclass(frozen=True)
class Proportion:
    """A proportion that is larger than parameters can make it."""

    long: str  # of WORDS, the side that is too short in all shapes of the procedure
    short: str  # and the one that it is compared with
    reference: float  # how many times as long as short the reference is
    replica: float  # the same of the replica that is shown
    reach: float  # the most that the procedure gives
    limit: Limit | None  # what seems to keep it from more, None where nothing stands out

    def wish(self) -> float | None:
        """The value of the limiting parameter that would do, if the proportion grows with it; None without a limit."""
        if self.limit is None:
            return None
        factor = self.reference / self.reach
        return self.limit.end * (factor if (self.limit.side == "high") == (self.limit.end > 0.0) else 1.0 / factor)

    @property
    def words(self) -> str:
        """Such as "2.8 times as deep as wide, the replica 1.2 times; your depth ends at 1.1"."""
        often = "" if 0.95 < self.reference < 1.05 else f"{self.reference:.2g} times "
        said = f"{often}as {self.long} as {self.short}, the replica {self.replica:.2g} times"
        if self.limit is None:
            return f"{said}, the procedure {self.reach:.2g} times at most"
        verb = "ends" if self.limit.side == "high" else "starts"
        return f"{said}; your {self.limit.parameter} {verb} at {self.limit.end:.4g}"


@dataclass(frozen=True, eq=False)
class Reach:
    """The proportions that a procedure makes, as logarithms of the ratio of two extents."""

    low: Floats  # (3,), of width to height, width to depth, height to depth
    high: Floats  # (3,)
    scalars: tuple[Scalar, ...]
    follows: Floats  # (scalars, 3), rank correlations of each with the proportions

    @classmethod
    def of(cls, crew: Workers, seed: int) -> Reach | None:
        """By random shapes, and by extreme ones pushed further; None where too few can be built."""
        space = crew.procedure.space
        vectors, ratios = _built(crew, space.sample(_SAMPLES, seed))
        if len(vectors) < _SAMPLES // 8:
            return None
        numbers = [p for p in space if isinstance(p, Scalar | Integer)]
        encoded = np.array([space.encode(values) for values in vectors])
        columns = {p.name: i for i, p in enumerate(space)}
        follows = {p.name: [_rank(encoded[:, columns[p.name]], ratios[:, k]) for k in range(3)] for p in numbers}
        pushed: list[Parameters] = []
        for k in range(3):
            order = np.argsort(ratios[:, k])
            for sign, rows in ((-1, order[:_PUSHED]), (1, order[-_PUSHED:])):
                pushed += [_pushed(space, vectors[row], {n: sign * f[k] for n, f in follows.items()}) for row in rows]
        more = _built(crew, pushed)[1]
        every = np.concatenate([ratios, more]) if len(more) else ratios
        scalars = tuple(p for p in numbers if isinstance(p, Scalar))
        ranks = np.array([follows[p.name] for p in scalars]).reshape(-1, 3)
        return cls(every.min(axis=0), every.max(axis=0), scalars, ranks)

    def beyond(self, reference: Mesh, replica: Mesh) -> Proportion | None:
        """The proportion of a reference that is furthest beyond what the procedure makes; None where none is."""
        theirs, ours = _ratios(reference), _ratios(replica)
        over, under = theirs - self.high, self.low - theirs
        excess = np.maximum(over, under)
        k = int(excess.argmax())
        if excess[k] < np.log(_BEYOND):
            return None
        reach = self.high[k] if over[k] > 0.0 else self.low[k]
        limit = self._limit(np.where(excess > 0.0, np.sign(over - under), 0.0))
        long, short = _PAIRS[k] if over[k] > 0.0 else _PAIRS[k][::-1]
        sign = 1.0 if over[k] > 0.0 else -1.0
        there, here, most = (float(np.exp(sign * value)) for value in (theirs[k], ours[k], reach))
        return Proportion(WORDS[long], WORDS[short], there, here, most, limit)

    def _limit(self, ways: Floats) -> Limit | None:
        """What keeps proportions from growing (1) or falling (-1) most, ways (3,): all those that have to, at once."""
        if not self.scalars:
            return None
        strengths = self.follows @ ways / np.abs(ways).sum()
        chief = int(np.abs(strengths).argmax())
        if abs(strengths[chief]) < _GOVERNS:
            return None
        parameter, side = self.scalars[chief], _END[bool(strengths[chief] > 0.0)]
        return Limit(parameter.name, float(getattr(parameter, side)), side)


_END: dict[bool, Side] = {True: "high", False: "low"}
_PAIRS = tuple(combinations(range(3), 2))


def _ratios(mesh: Mesh) -> Floats:
    extent = np.log(np.maximum(mesh.extent, 1e-6))
    return np.array([extent[a] - extent[b] for a, b in _PAIRS])


def _built(crew: Workers, vectors: Sequence[Parameters]) -> tuple[list[Parameters], Floats]:
    """Those that can be built, and their ratios (N, 3)."""
    builds = [build for build in crew.build(list(vectors)) if isinstance(build.shape, Mesh)]
    ratios = [_ratios(build.shape) for build in builds if isinstance(build.shape, Mesh)]
    return [build.parameters for build in builds], np.array(ratios).reshape(-1, 3)


def _rank(values: Floats, ratios: Floats) -> float:
    """Rank correlation, 0 where one of the two does not vary."""
    if np.ptp(values) == 0.0 or np.ptp(ratios) == 0.0:
        return 0.0
    return float(spearmanr(values, ratios).statistic)


def _pushed(space: ParameterSpace, values: Parameters, way: dict[str, float]) -> Parameters:
    """The values with every number that counts at the end of its Range that a way says: up where it is positive."""
    moved = dict(values)
    for name, strength in way.items():
        parameter = space[name]
        if abs(strength) > _MOVES and isinstance(parameter, Scalar | Integer):
            moved[name] = parameter.high if strength > 0.0 else parameter.low
    return space.canonical(moved)
