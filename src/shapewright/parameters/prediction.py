"""What is likely for some shapes: a number for each scalar, a probability for each class of the other parameters."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from shapewright.parameters.kinds import Parameters, Value
from shapewright.parameters.space import ParameterSpace

Floats = NDArray[np.float32]
Vector = NDArray[np.float64]

_LEAST_CHANCE = 1e-4
"""Probability below which nothing is more surprising: a network that never saw a class says 0. Chosen by hand."""
_BEAMS = 4
"""Combinations that are kept for each one asked for, as several may decode to equal parameters. Chosen by hand."""


@dataclass(frozen=True, eq=False)
class Prediction:
    """What is likely for N shapes; one column and one spread a parameter, in the space's order.

    A spread is the scale b of the Laplace distribution of a scalar's error, encoded: half of the true values lie within
    b ln 2 of the predicted ones, nine in ten within b ln 10. There are no spreads where nobody knows them.
    """

    space: ParameterSpace
    columns: tuple[Floats, ...]  # (N,) encoded values of a scalar, or (N, classes) probabilities
    spreads: tuple[Floats | None, ...] = ()  # (N,) for a scalar, None for the other kinds

    @classmethod
    def of(
        cls,
        space: ParameterSpace,
        parameters: Sequence[Mapping[str, Value]],
        doubt: float = 0.0,
        least: float = 0.0,
        most: float = 1.0,
        sure: Collection[str] = (),
    ) -> Prediction:
        """Known parameters as a prediction.

        doubt: the probability that is spread evenly over all classes of a parameter; the known class has the rest.
        least, most: each probability is moved between these; it need not add up to 1 then.
        sure: names of parameters without any doubt.
        """
        encoded = np.array([space.encode(values) for values in parameters], dtype=np.float32)
        columns: list[Floats] = []
        for parameter, column in zip(space, encoded.reshape(len(parameters), len(space)).T, strict=True):
            if parameter.classes:
                known = np.eye(parameter.classes, dtype=np.float32)[column.astype(int)]
                if parameter.name not in sure:
                    known = known * np.float32(1.0 - doubt) + np.float32(doubt / parameter.classes)
                    known = known.clip(least, most)
                columns.append(known)
            else:
                columns.append(column)
        return cls(space, tuple(columns))

    def __len__(self) -> int:
        """N, the number of shapes; 0 where the space has no parameters."""
        return len(self.columns[0]) if self.columns else 0

    def take(self, rows: Sequence[int] | NDArray[np.int64]) -> Prediction:
        """The prediction for some of the shapes."""
        spreads = tuple(None if spread is None else spread[rows] for spread in self.spreads)
        return replace(self, columns=tuple(column[rows] for column in self.columns), spreads=spreads)

    def decode(self) -> list[Parameters]:
        """For each shape the numbers and the likeliest classes; parameters that do not matter are at their defaults."""
        columns = [column.argmax(axis=1) if column.ndim == 2 else column for column in self.columns]
        return [self.space.canonical(self.space.decode(row)) for row in zip(*columns, strict=True)]

    def likeliest(self, row: int, count: int) -> list[Vector]:
        """The ``count`` likeliest encoded vectors (P,) of one shape, likeliest first: each combines other classes.

        Of vectors that decode to equal parameters only the first counts. What has no chance at all is left out.
        """
        beams: list[tuple[float, list[float]]] = [(0.0, [])]
        for parameter, column in zip(self.space, self.columns, strict=True):
            if parameter.classes:
                possible = np.flatnonzero(column[row] > 0.0)
                logs = np.log(column[row][possible])
                classes = list(zip(possible, logs, strict=True))
                beams = [(total + log, [*head, float(k)]) for total, head in beams for k, log in classes]
                beams = sorted(beams, key=lambda beam: -beam[0])[: _BEAMS * count]
            else:
                beams = [(total, [*head, float(column[row])]) for total, head in beams]
        return self.space.distinct([np.array(vector) for _, vector in beams])[:count]

    def surprise(self, row: int, vector: Vector) -> float:
        """Minus the logarithm of the probability that one shape has the choices of an encoded vector that matter."""
        active = set(self.space.active(self.space.decode(vector)))
        chances = [
            column[row][int(encoded)]
            for parameter, column, encoded in zip(self.space, self.columns, vector, strict=True)
            if parameter.classes and parameter.name in active
        ]
        return -float(np.log(np.maximum(chances, _LEAST_CHANCE)).sum())
