"""A change of one replica's mesh that may turn it into its reference, and what it costs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapewright.feedback.parts.attachment import loose
from shapewright.feedback.parts.pieces import Piece
from shapewright.feedback.parts.supports import splayed
from shapewright.shapes import Mesh, concatenate

Costs = Callable[[Sequence[Mesh]], Sequence[float]]
"""Costs of meshes as replicas of one reference, by the measure to search by."""

ALL_OTHERS = "*"
"""Stands for all parts but those that are removed."""
_PRICE = 220.0  # raw light field distance that each changed part and each piece must save
_LOOSE = 1500.0  # the same of each piece that hangs in the air


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """A change of a replica."""

    removed: tuple[str, ...] = ()  # labels of the parts that are taken away
    inset: tuple[str, ...] = ()  # labels of the parts that are drawn towards the middle
    splayed: tuple[str, ...] = ()  # labels of the parts that are drawn so at their low end only
    scale: tuple[float, float] = (1.0, 1.0)  # factors along x and z of what is drawn
    pieces: tuple[Piece, ...] = ()  # what is put in, in the replica's units
    cost: float = np.inf  # of the changed replica
    before: float = np.inf  # cost of the replica
    loose: int = 0  # number of the pieces that hang in the air

    @property
    def score(self) -> float:
        """The cost, and what the change itself costs: simple changes suit more references."""
        changes = len(self.removed) + len(self.pieces) + len(self.inset) + len(self.splayed)
        return self.cost + _PRICE * changes + _LOOSE * self.loose

    @property
    def key(self) -> tuple[object, ...]:
        """Equal for hypotheses that call for the same rule."""
        return (self.removed, self.inset, self.splayed, tuple(sorted((piece.key for piece in self.pieces), key=str)))


def applied(hypothesis: Hypothesis, replica: Mesh) -> Mesh:
    """The changed replica, as a soup of its visible faces and the new pieces."""
    return concatenate([*_standing(hypothesis, replica), *(piece.mesh() for piece in hypothesis.pieces)] or [replica])


def _standing(hypothesis: Hypothesis, replica: Mesh) -> list[Mesh]:
    """What stays of the replica: the parts that keep their place, those drawn in, and those splayed."""
    names = np.array([*replica.label_names, ""], dtype=object)
    labels = names[replica.face_labels] if replica.face_labels is not None else np.full(len(replica.faces), "")
    kept = ~np.isin(labels, hypothesis.removed)
    drawn = np.ones(len(labels), dtype=bool) if hypothesis.inset == (ALL_OTHERS,) else np.isin(labels, hypothesis.inset)
    middle = replica.bounds.mean(axis=0)
    factors = np.array([hypothesis.scale[0], 1.0, hypothesis.scale[1]])
    leans = [labels == label for label in hypothesis.splayed]
    stays = ~np.any([drawn, *leans], axis=0)
    parts = [
        Mesh(replica.vertices, replica.faces[kept & stays]),
        Mesh((replica.vertices - middle) * factors + middle, replica.faces[kept & drawn]),
        *(splayed(Mesh(replica.vertices, replica.faces[faces]), factors) for faces in leans if faces.any()),
    ]
    return [part for part in parts if len(part.faces)]


def priced(several: Sequence[Hypothesis], replica: Mesh, costs: Costs) -> list[Hypothesis]:
    """The same with their costs; pieces that hang in the air are counted where a change helps."""
    prices = costs([applied(one, replica) for one in several])
    return [
        replace(one, cost=float(price), loose=_loose(one, replica) if price < one.before else 0)
        for one, price in zip(several, prices, strict=True)
    ]


def _loose(hypothesis: Hypothesis, replica: Mesh) -> int:
    return loose(hypothesis.pieces, _standing(hypothesis, replica)) if hypothesis.pieces else 0
