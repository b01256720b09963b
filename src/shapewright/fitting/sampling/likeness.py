"""The distribution of parameters that the references of a run showed, and draws from it."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shapewright.parameters import Parameter, Parameters, ParameterSpace, Scalar, Value
from shapewright.runs.folder import RunError, read_record
from shapewright.runs.result import grade_in
from shapewright.shapes.arrays import Floats

_LEAST_SPREAD = 0.02
"""Of a scalar's kernel, in shares of its Range: one reference alone is no distribution. Chosen by hand."""
_VAIN = 20_000
"""Draws in a row without a new vector after which there are no more."""


@dataclass(frozen=True, eq=False)
class Likeness:
    """A kernel density of encoded parameters: one kernel for each reference, weighted by how well it is replicated.

    A scalar's kernel is normal, as wide as Scott's rule says (Scott 1992), and reflected at the ends of the Range.
    Another parameter keeps its class, but for one draw in N + 1, N references, that takes any. What did not matter to a
    reference, or is new since, is drawn as if there were no references.

    Attributes:
        centres: (N, P) parameters of the references, encoded.
        known: (N, P) which of them mattered.
        weights: (N,) of the references, which add up to 1.
    """

    space: ParameterSpace
    centres: Floats
    known: NDArray[np.bool_]
    weights: Floats

    @classmethod
    def of_run(cls, run: Path, space: ParameterSpace) -> Likeness:
        """What the references of a run's folder showed, for the present version of its procedure.

        A reference weighs its fidelity; in runs without fidelities, 1 where it is replicated. Raises RunError when no
        reference weighs anything, or when none of its parameters is one of the space's.
        """
        found = [(entry["parameters"], _weight(entry)) for entry in read_record(run)["references"]]
        told = [(values, weight) for values, weight in found if values and weight > 0.0]
        if not told:
            raise RunError(f"{run}: none of its references is replicated, so they show no distribution")
        if not any(name in values for values, _ in told for name in space.names):
            raise RunError(f"{run}: it is of another procedure: there is no parameter {', '.join(space.names)} in it")
        carried = [space.carry(values) for values, _ in told]
        known = [
            [name in values and name in space.active(own) for name in space.names]
            for (values, _), own in zip(told, carried, strict=True)
        ]
        weights = np.array([weight for _, weight in told])
        return cls(space, np.array([space.encode(own) for own in carried]), np.array(known), weights / weights.sum())

    @property
    def digest(self) -> str:
        """The same for the same distribution: 16 hexadecimal digits."""
        parts = (array.tobytes() for array in (self.centres, self.known, self.weights))
        return hashlib.blake2b(b"".join(parts), digest_size=8).hexdigest()

    def draw(self, count: int, seed: int) -> Iterator[Parameters]:
        """``count`` different vectors; fewer when the space holds no more that are at all likely."""
        rng = np.random.default_rng(seed)
        number = 1.0 / float((self.weights**2).sum())  # of references, if all weighed the same
        spreads = self._spreads(number)
        ends = np.cumsum(self.weights)

        def drawn() -> Parameters:
            row = min(int(np.searchsorted(ends, rng.random(), side="right")), len(ends) - 1)
            values: Parameters = {}
            for column, parameter in enumerate(self.space):
                if not self.known[row, column]:
                    values[parameter.name] = parameter.sample(rng)
                elif parameter.classes:
                    kept = rng.random() >= 1.0 / (number + 1.0)
                    at = self.centres[row, column] if kept else rng.integers(parameter.classes)
                    values[parameter.name] = parameter.decode(float(at))
                else:
                    at = self.centres[row, column] + spreads[column] * rng.standard_normal()
                    values[parameter.name] = _nearest_level(parameter, _reflected(at))
            return values

        return islice(self._different(drawn), count)

    def _spreads(self, number: float) -> Floats:
        """(P,) of the kernels."""
        factor = number ** (-1.0 / (self.space.scalars.sum() + 4.0))
        weights = np.where(self.known, self.weights[:, None], 0.0)
        total = np.maximum(weights.sum(axis=0), 1e-12)
        means = (weights * self.centres).sum(axis=0) / total
        variances = (weights * (self.centres - means) ** 2).sum(axis=0) / total
        spreads: Floats = np.maximum(factor * np.sqrt(variances), _LEAST_SPREAD)
        return spreads

    def _different(self, drawn: Callable[[], Parameters]) -> Iterator[Parameters]:
        seen: set[tuple[Value, ...]] = set()
        vain = 0
        while vain < _VAIN:
            vector = self.space.canonical(drawn())
            vain += 1
            if (values := tuple(vector.values())) not in seen:
                seen.add(values)
                vain = 0
                yield vector


def _weight(entry: Mapping[str, Any]) -> float:
    fidelity = entry.get("fidelity")
    return float(grade_in(entry) == "replicated") if fidelity is None else float(fidelity)


def _reflected(at: float) -> float:
    """A number brought into [0, 1] by mirrors at both ends."""
    at = abs(at) % 2.0
    return 2.0 - at if at > 1.0 else at


def _nearest_level(parameter: Parameter, at: float) -> Value:
    """The value at an encoded scalar, of those that it is sampled at."""
    value = parameter.decode(at)
    if isinstance(parameter, Scalar) and parameter.steps is not None and parameter.levels is not None:
        return min(parameter.levels, key=lambda level: abs(parameter.encode(level) - at))
    return value
