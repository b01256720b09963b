"""A shard: one of several equal parts of the same samples, which any machine can make for itself."""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Shard:
    """Part ``number`` (from 1) of ``of`` parts; written ``17/200``. Raises ValueError when there is no such part."""

    number: int
    of: int

    def __post_init__(self) -> None:
        if not 1 <= self.number <= self.of:
            raise ValueError(f"there is no shard {self}: they are 1/{self.of} to {self.of}/{self.of}")

    @classmethod
    def parse(cls, text: str) -> Shard:
        """A shard from its text. Raises ValueError."""
        found = re.fullmatch(r"(\d+)/(\d+)", text.strip())
        if not found or int(found[2]) == 0:
            raise ValueError(f"{text!r} is no shard: write K/M, for example 17/200")
        return cls(int(found[1]), int(found[2]))

    def part(self, count: int) -> range:
        """Which of ``count`` samples are its own: all shards together have each sample once, in order."""
        return range(count * (self.number - 1) // self.of, count * self.number // self.of)

    def __str__(self) -> str:
        return f"{self.number}/{self.of}"
