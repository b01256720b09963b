"""A replica for every reference, shape by shape: pictures of all first, then what is measured."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from shapewright.judging.target import Target
from shapewright.rendering.thumbnails import thumbnail
from shapewright.shapes import Shape
from shapewright.studio.bench.gallery import Shelf, in_turn, shape_bytes
from shapewright.studio.bench.messages import Measured, News, SweepEnded, Swept
from shapewright.studio.bench.workshop import Built, Workshop
from shapewright.studio.wire.problems import of_failure
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
    target: Callable[[str], Target | None]  # what replicas are measured against; None where it cannot be read
    same: Callable[[str, Shape], float]  # how like its size is to the reference's, by what its fidelity is multiplied
    send: Callable[[News, bytes], None]  # takes an answer and its payload

    def run(self) -> Iterator[None]:
        """One shape a step. Ends early when it is interrupted, or when too many shapes exceed the time limit.

        Raises Broken when the procedure has become unusable.
        """
        shelf: Shelf[Built] = Shelf(_MEMORY, lambda built: shape_bytes(built.build.shape))
        late = 0
        for slug in in_turn(self.items, self.first):
            built = self.workshop.build(self.items[slug])
            if built is None:
                return
            shelf.put(slug, built)
            self._send_built(slug, built)
            failure = built.build.failure
            late += failure is not None and failure.kind == "time"
            if late >= _PATIENCE:
                self.send(SweepEnded(sweep=self.number, given_up=True), b"")
                return
            yield
        for slug in in_turn(self.items, self.first):
            again = shelf.get(slug) or self.workshop.build(self.items[slug])
            if again is None:
                return
            target = self.target(slug)
            if target and again.build.shape is not None:
                replica = again.build.shape.normalised()
                distance = target.nearest(replica)[0]
                fidelity = target.fidelity(replica) * self.same(slug, again.build.shape)
                self.send(Measured(sweep=self.number, slug=slug, fidelity=fidelity, distance=distance), b"")
            yield
        self.send(SweepEnded(sweep=self.number, given_up=False), b"")

    def _send_built(self, slug: Slug, built: Built) -> None:
        made = built.build
        message = Swept(
            sweep=self.number,
            slug=slug,
            parameters=made.parameters,
            active=list(built.active),
            at_limit=list(built.at_limit),
            problem=of_failure(made.failure, self.root, made.parameters) if made.failure else None,
        )
        self.send(message, thumbnail(made.shape, PICTURE) if made.shape is not None else b"")
