"""A replica for every reference, shape by shape: pictures of all first, then what is measured."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from shapewright.rendering.thumbnails import thumbnail
from shapewright.shapes import Shape
from shapewright.studio.bench.gallery import Shelf, in_turn, shape_bytes
from shapewright.studio.bench.messages import Measured, News, SweepEnded, Swept
from shapewright.studio.bench.workshop import Built, Workshop
from shapewright.studio.wire.problems import Problem, of_failure
from shapewright.studio.wire.values import Slug, Values

PICTURE = 160
"""Pixels of a replica's thumbnail while it may still change."""
_PATIENCE = 3
"""Shapes that exceed the time limit, after which a sweep is given up."""
_MEMORY = 24 * 2**20


@dataclass(frozen=True, eq=False)
class Sweep:
    """A replica for each of some parameters."""

    number: int  # goes with every answer
    items: Mapping[Slug, Values]  # parameters by slug
    first: Callable[[], list[Slug]]  # says which references the author looks at
    root: Path  # folder that problems name files relative to
    workshop: Workshop
    unlike: Callable[[Slug, Shape], str | None]  # why the two cannot be compared, by their kinds; None where they can
    measure: Callable[[Slug, Shape], tuple[float, float] | None]  # distance and fidelity; None without a reference
    send: Callable[[News, bytes], None]  # takes an answer and its payload
    least: Mapping[Slug, Values] | None = None  # parameters that those of the items have to be better than

    def run(self) -> Iterator[None]:
        """One shape a step. Ends early when it is interrupted, or when too many shapes exceed the time limit.

        Raises Broken when the procedure has become unusable.
        """
        for _ in self._all() if self.least is None else self._better(self.least):
            yield

    def _all(self) -> Iterator[None]:
        shelf: Shelf[Built] = Shelf(_MEMORY, lambda built: shape_bytes(built.build.shape))
        late = 0
        for slug in in_turn(self.items, self.first):
            built = self.workshop.build(self.items[slug], slug=slug)
            if built is None:
                return
            shelf.put(slug, built)
            self._send_built(slug, built)
            late += _is_late(built)
            if late >= _PATIENCE:
                self.send(SweepEnded(sweep=self.number, given_up=True), b"")
                return
            yield
        for slug in in_turn(self.items, self.first):
            again = shelf.get(slug) or self.workshop.build(self.items[slug], slug=slug)
            if again is None:
                return
            measured = self._measured(slug, again)
            if measured:
                self.send(measured, b"")
            yield
        self.send(SweepEnded(sweep=self.number, given_up=False), b"")

    def _better(self, least: Mapping[Slug, Values]) -> Iterator[None]:
        """Sends no shape that is further from its reference than the one with the least parameters."""
        late = 0
        for slug in in_turn(self.items, self.first):
            guess, other = self.workshop.build(self.items[slug], slug=slug), self.workshop.build(least[slug], slug=slug)
            if guess is None or other is None:
                return
            found, floor = self._measured(slug, guess), self._measured(slug, other)
            # What cannot be measured, NaN, is not known to be worse.
            worse = found is not None and floor is not None and _fidelity(found) < _fidelity(floor)
            if guess.build.shape is not None and not worse:
                self._send_built(slug, guess)
                if found:
                    self.send(found, b"")
            late += _is_late(guess) + _is_late(other)
            if late >= _PATIENCE:
                break
            yield
        self.send(SweepEnded(sweep=self.number, given_up=late >= _PATIENCE), b"")

    def _measured(self, slug: Slug, built: Built) -> Measured | None:
        """None without a shape, or without a reference to measure it against."""
        measured = self.measure(slug, built.build.shape) if built.build.shape is not None else None
        if measured is None:
            return None
        distance, fidelity = measured
        return Measured(sweep=self.number, slug=slug, fidelity=fidelity, distance=distance)

    def _send_built(self, slug: Slug, built: Built) -> None:
        made = built.build
        unlike = self.unlike(slug, made.shape) if made.shape is not None else None
        problem = Problem("no shape", unlike) if unlike else None
        message = Swept(
            sweep=self.number,
            slug=slug,
            parameters=made.parameters,
            active=list(built.active),
            at_limit=list(built.at_limit),
            problem=of_failure(made.failure, self.root, made.parameters) if made.failure else problem,
        )
        self.send(message, thumbnail(made.shape, PICTURE) if made.shape is not None else b"")


def _is_late(built: Built) -> bool:
    return built.build.failure is not None and built.build.failure.kind == "time"


def _fidelity(measured: Measured) -> float:
    return math.nan if measured.fidelity is None else measured.fidelity
