"""Up and front of shapes: found by their looks, by how others of a collection stand, and by a procedure's shapes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shapewright.axes.agreement import agreement
from shapewright.axes.everyday import Weights, everyday, log_likely, scaled
from shapewright.axes.linear import Linear, log_softmax
from shapewright.axes.looks import ALIKE, Looks
from shapewright.axes.turns import AFTER, AS_IT_IS, INVERSE, TURNS, UPRIGHT, UPS
from shapewright.shapes import Floats, Mesh, Points

_SURE, _SURE_FRONT, _TIE = 0.6, 0.95, 1e-6
"""Least likelihood of an up, and of a front without a procedure, that is turned to; below it nothing is turned."""
_DOUBT, _DOUBT_TAUGHT = 0.1, 0.03
"""How often a shape alone is told wrong: by its looks, and with a procedure's shapes (docs/benchmarks.md)."""
_STRANGE, _UNUSUAL = 0.1, 0.5
"""How often a reference is none of the procedure's kind, so that its shapes tell nothing of it; and how often a kind of
things stands in another way than everyday things. Guesses; that the first is less makes the procedure decide."""
_MOSTLY = 0.8  # share of a procedure's shapes that look the same after a turn, from which on the turn does not matter
_BETTER = 3.0
"""By how much the logarithm of the likelihood has to be larger without a procedure's shapes than with them, where a
collection does not look as they do. A guess."""
SAMPLES = 300
"""Shapes of a procedure that are learned from. docs/benchmarks.md has other numbers."""
_ENOUGH = 20  # of them, from which on they are learned from at all


@dataclass(frozen=True)
class Finding:
    """Which way a shape stands.

    Attributes:
        turn: of TURNS, what brings it to stand right.
        up: how likely its up is right then, 0 to 1.
        front: how likely its front is right as well, where its up is.
        has_up: whether it looks another way on its other sides; a box does not, whatever its proportions.
        fronts: how many of its four sides look as its front does: 4 for one that has no front, as a round table.
    """

    turn: int
    up: float
    front: float
    has_up: bool
    fronts: int

    @property
    def sure(self) -> bool:
        """Whether its up is; else the shape is left as it was given."""
        return self.up >= _SURE


@dataclass(frozen=True, eq=False)
class Kind:
    """What a procedure's shapes tell of the things that it is made for."""

    linear: Linear
    alike: NDArray[np.bool_]  # (24,): the turns after which most of them look the same; none has a front then

    @classmethod
    def of(cls, looks: Looks, weights: Weights | None = None) -> Kind:
        """Learned from shapes that stand right."""
        right = looks.apart[:, 1] <= ALIKE
        return cls(Linear.learned(scaled(looks.features, weights), right), right.mean(axis=0) >= _MOSTLY)

    @classmethod
    def taught(cls, shapes: Sequence[Mesh], threads: int | None = None) -> Kind | None:
        """Learned from shapes of a procedure, which stand right; None from too few."""
        return cls.of(Looks.of(shapes, threads)) if len(shapes) >= _ENOUGH else None


def find(
    shapes: Sequence[Mesh | Points],
    allowed: NDArray[np.bool_] | None = None,
    taught: Sequence[Mesh] = (),
    threads: int | None = None,
) -> list[Finding]:
    """How each shape of a collection has to be turned to stand right.

    A shape is turned only where that is likely enough; its up and its front are decided one after the other.

    Args:
        shapes: of the collection, as they are given.
        allowed: (N, 24), the turns that may be found for each; all by default.
        taught: shapes of the procedure that is to replicate them: they stand right. Too few are not learned from.
        threads: one a core by default.
    """
    return told(Looks.of(shapes, threads), allowed, Kind.taught(taught, threads))


def told(
    looks: Looks,
    allowed: NDArray[np.bool_] | None = None,
    kind: Kind | None = None,
    weights: Weights | None = None,
) -> list[Finding]:
    """``find``, where what is seen is known. weights: of everyday things, others than those that come along."""
    features, known = _everyday(looks, weights)
    doubt, sure = _DOUBT, _SURE_FRONT
    no_matter = np.arange(len(TURNS)) == AS_IT_IS
    if kind is not None:
        theirs = kind.linear.log_likely(features)
        if agreement(known, _DOUBT).fit <= agreement(theirs, _DOUBT).fit + _BETTER:
            known = log_softmax(_doubted(theirs, _STRANGE) + _doubted(known, _UNUSUAL))
            doubt, sure = _DOUBT_TAUGHT, _SURE
        no_matter = kind.alike
    if allowed is not None:
        known = log_softmax(np.where(allowed, known, -np.inf))
    likely = agreement(known, doubt).likely
    likely = likely if allowed is None else np.where(allowed, likely, 0.0)
    return [finding(*row, no_matter, sure) for row in zip(likely, looks.apart, strict=True)]


def _everyday(looks: Looks, weights: Weights | None) -> tuple[Floats, Floats]:
    """Features (N, 24, F), scaled, and logarithms of likelihoods (N, 24); points and meshes by weights of their own."""
    features, known = np.empty_like(looks.features), np.empty(looks.features.shape[:2])
    for points in (False, True):
        rows = looks.points == points
        of_kind = weights or everyday(points)
        features[rows] = scaled(looks.features[rows], of_kind)
        known[rows] = log_likely(features[rows], of_kind)
    return features, known


def _doubted(logs: Floats, doubt: float) -> Floats:
    """Logarithms of likelihoods (..., 24) that are worth nothing as often as ``doubt`` says."""
    return np.asarray(np.log((1.0 - doubt) * np.exp(logs) + doubt / len(TURNS)))


def finding(likely: Floats, apart: Floats, no_matter: NDArray[np.bool_], sure_front: float = _SURE_FRONT) -> Finding:
    """What is told of one shape.

    Args:
        likely: (24,), of each turn.
        apart: (2, 24), as ``Sides.apart`` gives it.
        no_matter: (24,), turns of a shape that stands right after which it does so too, whatever it is.
        sure_front: the least likelihood of a front that is turned to.
    """
    looks, whole = apart <= ALIKE
    alike, free = np.flatnonzero(whole), np.flatnonzero(no_matter)
    as_right = [np.unique(AFTER[np.ix_(free, row)]) for row in AFTER[:, alike]]  # of each turn
    ups = np.array([likely[np.unique(AFTER[np.ix_(UPRIGHT, row)])].sum() for row in as_right])
    sure = bool(ups.max() >= _SURE and ups.max() > ups[AS_IT_IS] + _TIE)
    upright = int(ups.argmax()) if sure else AS_IT_IS
    ways = AFTER[UPRIGHT, upright]
    fronts = np.array([likely[as_right[way]].sum() for way in ways]) / max(ups[upright], _TIE)
    best = int(fronts.argmax()) if fronts.max() > fronts[0] + _TIE else 0
    if not sure and fronts[best] < sure_front:
        best = 0
    turn = int(ways[best])
    again = AFTER[AFTER[INVERSE[turn], UPRIGHT], turn]  # about the up axis of the shape as it was given
    return Finding(
        turn=turn,
        up=float(min(ups[upright], 1.0)),
        front=float(min(fronts[best], 1.0)),
        has_up=not looks[UPS[AFTER[turn]] != UPS[turn]].any(),
        fronts=int((whole[again] | no_matter[UPRIGHT]).sum()),
    )
