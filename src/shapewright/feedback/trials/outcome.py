"""What a changed procedure gives for references: a replica for each, as near as it is known by now."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from shapewright.feedback.case import Replica
from shapewright.feedback.parts.attachment import separate
from shapewright.parameters import Parameters

PROMISING = 1.7
"""A shape that is further apart, see ``Replica``, before any search is hardly ever replicated after it."""


@dataclass(frozen=True, eq=False)
class Outcome:
    """Replicas that a changed procedure makes."""

    replicas: Mapping[int, Replica]  # by the row of their reference
    counted: tuple[int, ...]  # rows of the replicas that count. From the others a search may begin all the same.

    @classmethod
    def of(cls, replicas: Iterable[Replica]) -> Outcome:
        """All of them count."""
        by_row = {replica.row: replica for replica in replicas}
        return cls(by_row, tuple(by_row))

    @property
    def replicated(self) -> tuple[int, ...]:
        """Rows of the references that are replicated."""
        return tuple(row for row in self.counted if self.replicas[row].apart <= 1.0)

    def apart(self, row: int) -> float:
        """Infinite where no replica counts."""
        return self.replicas[row].apart if row in self.counted else np.inf

    @property
    def parameters(self) -> dict[int, Parameters]:
        """Of all replicas, by row."""
        return {row: replica.parameters for row, replica in self.replicas.items()}

    def only_counted(self) -> Outcome:
        """Without the replicas that do not count."""
        return replace(self, replicas={row: self.replicas[row] for row in self.counted})

    def whole(self, pieces: Mapping[int, int]) -> Outcome:
        """Only replicas count that fall into no more pieces than they may: nothing may float.

        pieces: how many those are, by row. Whether far replicas float does not matter.
        """
        return self._counting(lambda r: r.apart > PROMISING or separate(r.mesh) <= pieces[r.row])

    def using(self, uses: Callable[[Parameters], bool]) -> Outcome:
        """Only replicas count that make use of the change: others a longer search would have found without it."""
        return self._counting(lambda replica: uses(replica.parameters))

    def joined(self, other: Outcome) -> Outcome:
        """The nearer of both replicas for each reference."""
        nearer = {row: other.replicas[row] for row in other.counted if other.apart(row) < self.apart(row)}
        counted = tuple(dict.fromkeys([*self.counted, *nearer]))
        return replace(self, replicas={**self.replicas, **nearer}, counted=counted)

    def _counting(self, counts: Callable[[Replica], bool]) -> Outcome:
        return replace(self, counted=tuple(row for row in self.counted if counts(self.replicas[row])))
