"""Which parameter vectors a folder of samples is to hold, and the names of their files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import islice

from shapewright.fitting.sampling.likeness import Likeness
from shapewright.fitting.sampling.shards import Shard
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure


@dataclass(frozen=True)
class Drawn:
    """Parameter vectors, those of one shard where there are shards.

    count: of all shards together, as it was asked for; a space that holds fewer gives fewer.
    start: the number of the first one among those of all shards.
    names: of their files, without extensions.
    """

    count: int
    start: int
    names: tuple[str, ...]
    vectors: tuple[Parameters, ...]

    @classmethod
    def of(
        cls,
        procedure: Procedure,
        count: int,
        seed: int,
        given: Mapping[str, Parameters] | None = None,
        shard: Shard | None = None,
        like: Likeness | None = None,
    ) -> Drawn:
        """Random vectors, of a distribution where there is one; or ``given`` ones by the names of their files."""
        count = count if given is None else len(given)
        part = shard.part(count) if shard else range(count)
        if given is not None:
            own = list(given.items())[part.start : part.stop]
            return cls(count, part.start, tuple(name for name, _ in own), tuple(vector for _, vector in own))
        every = like.draw(count, seed) if like else procedure.space.draw(count, seed)
        vectors = tuple(islice(every, part.start, part.stop))
        names = (f"{procedure.name}-{number:05d}" for number in part[: len(vectors)])
        return cls(count, part.start, tuple(names), vectors)
