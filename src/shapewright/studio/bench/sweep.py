"""A replica for every reference, shape by shape: pictures of all first, then their distances."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shapewright.judging.target import Target
from shapewright.parameters import Parameters
from shapewright.studio.bench.built import Built
from shapewright.studio.bench.gallery import Shelf, picture, shape_bytes
from shapewright.studio.bench.telling import plain
from shapewright.studio.bench.workshop import Workshop
from shapewright.studio.wire.problems import of_failure

PICTURE = 160
"""Pixels of a replica's thumbnail while it may still change."""
_PATIENCE = 3
"""Shapes that exceed the time limit, after which a sweep is given up."""
_MEMORY = 24 * 2**20
Tell = Callable[[Mapping[str, Any], bytes], None]


@dataclass(frozen=True, eq=False)
class Sweep:
    """number: told with every answer. items: parameters by slug. first: says which slugs the author is looking at."""

    number: int
    items: Mapping[str, Parameters]
    first: Callable[[], list[str]]
    root: Path
    workshop: Workshop
    target: Callable[[str], Target | None]
    tell: Tell

    def run(self) -> Iterator[None]:
        """One shape a step. Ends early when it is interrupted, or when too many shapes exceed the time limit.

        Raises Broken when the procedure has become unusable.
        """
        shelf: Shelf[Built] = Shelf(_MEMORY, _bytes)
        late = 0
        for slug in self._order():
            built = self.workshop.build(self.items[slug])
            if built is None:
                return
            shelf.put(slug, built)
            self._tell_built(slug, built)
            failure = built.build.failure
            late += failure is not None and failure.kind == "time"
            if late >= _PATIENCE:
                self._say({"type": "swept all", "given_up": True})
                return
            yield
        for slug in self._order():
            again = shelf.get(slug) or self.workshop.build(self.items[slug])
            if again is None:
                return
            target = self.target(slug)
            if target and again.build.shape is not None:
                distance, _ = target.nearest(again.build.shape.normalised())
                self._say({"type": "measured", "slug": slug, "distance": plain(distance)})
            yield
        self._say({"type": "swept all", "given_up": False})

    def _order(self) -> Iterator[str]:
        remaining = dict.fromkeys(self.items)
        while remaining:
            slug = next((each for each in self.first() if each in remaining), None) or next(iter(remaining))
            del remaining[slug]
            yield slug

    def _tell_built(self, slug: str, built: Built) -> None:
        made = built.build
        found = of_failure(made.failure, self.root, made.parameters).record() if made.failure else None
        message = {"type": "swept", "slug": slug, "parameters": made.parameters, "problem": found}
        drawn = picture(made.shape, PICTURE) if made.shape is not None else b""
        self._say({**message, "active": list(built.active), "at_limit": list(built.at_limit)}, drawn)

    def _say(self, message: Mapping[str, Any], payload: bytes = b"") -> None:
        self.tell({**message, "sweep": self.number}, payload)


def _bytes(built: Built) -> int:
    return shape_bytes(built.build.shape) if built.build.shape is not None else 0
