"""A search in parts, each for some of the references, on the machines of an executor."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, Protocol, TypeVar

from shapewright.building import Crew, Workers
from shapewright.parameters import Parameters
from shapewright.search.objective import Criterion

_MOST = 16
"""References of one part, at most: a search for so many takes some seconds, and little is lost with a machine."""


class Divisible(Protocol):
    """Where searches begin, as far as parts need it."""

    def take(self, rows: Sequence[int], /) -> Any: ...


Start = TypeVar("Start", bound=Divisible)
Search = Callable[[Any, Criterion, Crew], list[Parameters]]


@dataclass(frozen=True, eq=False)
class _Part(Generic[Start]):
    """Where the searches for some of the references begin, and what they make small."""

    start: Start
    criterion: Criterion
    count: int

    def __len__(self) -> int:
        return self.count


def in_parts(
    start: Divisible,
    criterion: Criterion,
    crew: Workers,
    count: int,
    search: Search,
    progress: Callable[[int, int], None] | None,
) -> list[Parameters]:
    """What a search finds for each of ``count`` references, which does not depend on the other ones.

    search: a ``partial`` of a function of a module, so that it can be sent.
    """
    pieces = crew.slices(range(count), _MOST)
    parts = (_Part(start.take(piece), criterion.take(piece), len(piece)) for piece in pieces)
    found: list[Parameters] = []
    for done, some in enumerate(crew.spread(partial(_searched, search=search), parts), 1):
        found += some
        if progress:
            progress(done, len(pieces))
    return found


def _searched(crew: Crew, part: _Part[Any], search: Search) -> list[Parameters]:
    return search(part.start, part.criterion, crew)
