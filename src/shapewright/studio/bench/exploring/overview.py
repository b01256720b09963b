"""What the bench answers about many shapes at once, in steps between its other work."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from shapewright.studio.bench import messages
from shapewright.studio.bench.exploring.exploration import Exploration
from shapewright.studio.bench.exploring.looks import Looks
from shapewright.studio.bench.exploring.mapping import Mapping
from shapewright.studio.bench.gallery import Gallery
from shapewright.studio.bench.workshop import Workshop
from shapewright.studio.wire.detail import CollectionMap


class Overview:
    """The answers; each is a task that does one shape a step.

    send: takes an answer and its payload.
    """

    def __init__(self, workshop: Workshop, send: Callable[[messages.Answer, bytes], None]) -> None:
        self._workshop, self._send = workshop, send
        self._looks = Looks(None)
        self._left = 0  # references that are not looked at yet

    def look(self, references: Callable[[], Gallery], cache: Path | None) -> Iterator[None]:
        """Look at all references, and tell which are alike."""
        gallery = references()
        looks = self._looks = Looks(cache)
        self._left = len(gallery.listed.sources)
        for _ in looks.look(gallery):
            self._left -= 1
            yield
        self._left = 0
        found = yield from looks.duplicates(gallery)
        self._send(messages.Alike(duplicates=found), b"")

    def explore(self, request: messages.Exploring, root: Path) -> Iterator[None]:
        """root: folder that problems name files relative to."""

        def answer(message: messages.LiveMessage, payload: bytes) -> None:
            self._send(messages.Answered(client=request.client, message=message), payload)

        return Exploration(request.order, root, self._workshop, answer).run()

    def map(self, request: messages.Fetch) -> Iterator[None]:
        """The size of the request is the seed of the samples."""

        def answer(message: CollectionMap) -> None:
            self._send(messages.Reply(request=request.request, message=message), b"")

        return Mapping(self._looks, self._left, self._workshop, request.size, answer).run()

    def alike(self, request: messages.Fetch) -> Iterator[None]:
        """Answered at once."""
        try:
            self._send(messages.Reply(request=request.request, message=self._looks.alike(request.slug or "")), b"")
        except KeyError as error:
            self._send(messages.Reply(request=request.request, error=str(error.args[0])), b"")
        return iter(())
