"""Shapes without references, one after another: built, drawn, and examined for soundness."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from shapewright.building.outcomes import Failure
from shapewright.rendering.thumbnails import thumbnail
from shapewright.shapes import Mesh, Shape
from shapewright.studio.bench.workshop import Built, Workshop
from shapewright.studio.wire.answers import Along, ExploredMessage, ExploringMessage, Soundness
from shapewright.studio.wire.problems import of_failure
from shapewright.studio.wire.requests import Explore
from shapewright.studio.wire.values import message_of

PICTURE = 192
"""Pixels of a shape's picture."""
MOST_EXAMINED = 100_000
"""Triangles; a mesh of more would keep everybody waiting."""
_PATIENCE = 3
"""Shapes that exceed the time limit, after which the others are given up."""


@dataclass(frozen=True, eq=False)
class Exploration:
    """What one page wants to see."""

    order: Explore
    root: Path  # folder that problems name files relative to
    workshop: Workshop
    send: Callable[[ExploringMessage | ExploredMessage, bytes], None]  # takes an answer and a PNG

    def run(self) -> Iterator[None]:
        """One shape a step. Ends early where it is interrupted. Raises Broken when the procedure is unusable."""
        plan = self.workshop.plan(self.order)
        if plan is None:
            return
        if isinstance(plan, Failure):
            problem = of_failure(plan, self.root)
            self.send(ExploringMessage(id=self.order.id, shapes=[], along=[], problem=problem), b"")
            return
        along = [Along(name=name, values=list(values)) for name, values in plan.along]
        self.send(ExploringMessage(id=self.order.id, shapes=list(plan.shapes), along=along, problem=None), b"")
        yield
        late = 0
        for i, values in enumerate(plan.shapes):
            built = self.workshop.build(values)
            if built is None:
                return
            failure = built.build.failure
            late += failure is not None and failure.kind == "time"
            self._send_built(i, built, late >= _PATIENCE)
            if late >= _PATIENCE:
                return
            yield

    def _send_built(self, index: int, built: Built, given_up: bool) -> None:
        made = built.build
        message = ExploredMessage(
            id=self.order.id,
            index=index,
            parameters=made.parameters,
            active=list(built.active),
            soundness=examined(made.shape),
            problem=of_failure(made.failure, self.root, made.parameters) if made.failure else None,
            given_up=given_up,
        )
        self.send(message, thumbnail(made.shape, PICTURE) if made.shape is not None else b"")


def examined(shape: Shape | None) -> Soundness | None:
    """None of a drawing, of what is too large, and of nothing."""
    if not isinstance(shape, Mesh) or len(shape.faces) > MOST_EXAMINED:
        return None
    return message_of(Soundness, shape.soundness())
