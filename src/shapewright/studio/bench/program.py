"""The program of the bench: the process that draws and measures for the server, beside any fit.

Requests and answers are frames (see wire/child). What the author waits for at this moment, live evaluation, comes
first; pictures and sweeps over the whole collection are done in between, shape by shape.
"""

from __future__ import annotations

import threading
from collections.abc import Collection, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, BinaryIO

from shapewright.procedures import Facts
from shapewright.references.errors import CollectionError, UnreadableError
from shapewright.references.reading import Readers
from shapewright.settings import Settings
from shapewright.shapes import Drawing, Mesh, Shape
from shapewright.studio.bench import messages, shape_messages
from shapewright.studio.bench.answering.fetching import fetched
from shapewright.studio.bench.exploring.overview import Overview
from shapewright.studio.bench.gallery import Gallery, Stance
from shapewright.studio.bench.inbox import Inbox
from shapewright.studio.bench.residual_colours import ResidualColours
from shapewright.studio.bench.standing import Standing
from shapewright.studio.bench.sweep import Sweep
from shapewright.studio.bench.targets import Targets
from shapewright.studio.bench.workshop import Broken, Workshop
from shapewright.studio.project.listing import Listing, listing
from shapewright.studio.project.stores.shape_store import LARGE, keep_message
from shapewright.studio.wire.answers import DrawingMessage, FailedMessage
from shapewright.studio.wire.child import own_streams, read_frame, write_frame
from shapewright.studio.wire.detail import About
from shapewright.studio.wire.problems import Problem, of_failure
from shapewright.studio.wire.requests import Evaluate
from shapewright.studio.wire.values import Slug

_LOOKS = "looks"
"""The task that waits for all others."""
_EXPLORED = "explored"
"""How the names of tasks begin that show a page shapes without references."""


class Bench:
    """Answers the requests of an inbox until one of them is to end."""

    def __init__(self, answers: BinaryIO, inbox: Inbox, workshop: Workshop) -> None:
        self._answers, self._inbox, self._workshop = answers, inbox, workshop
        self._readers = Readers(1)
        self._gallery = Gallery(Listing({}, {}), None, self._readers)
        self._colours: ResidualColours | None = None
        self._cache: Path | None = None
        self._settings = Settings()
        self._targets = self._new_targets()
        self._root = Path()
        self._first: list[Slug] = []
        self._wanted: dict[Slug, None] = {}  # of which the pictures are still to be drawn
        self._tasks: dict[str, Iterator[None]] = {}
        self._standing = Standing()
        self._overview = Overview(workshop, self._send)
        workshop.on_printed = lambda slug, text: self._send(messages.Printed(slug=slug, text=text))

    def run(self) -> None:
        """Serve; tasks are moved on while no request waits."""
        self._send(messages.Ready())
        while True:
            request = self._inbox.take(wait=not self._tasks)
            match request:
                case None:
                    self._advance(next((name for name in self._tasks if name != _LOOKS), _LOOKS))
                case messages.References():
                    self._list(request)
                case messages.Pictures():
                    self._want({*request.slugs, *self._gallery.uncertain})
                case messages.First():
                    self._first = request.slugs
                case messages.Load():
                    self._load(request)
                case messages.SweepOrder():
                    self._sweep(request)
                case messages.Live():
                    self._evaluate(request.client, request.evaluate)
                case messages.Exploring():
                    if self._workshop.open:
                        self._begin(f"{_EXPLORED} {request.client}", self._overview.explore(request, self._root))
                case messages.Fetch(what="map" | "alike"):
                    answered = self._overview.map if request.what == "map" else self._overview.alike
                    self._begin(f"{request.what} {request.request}", answered(request))
                case messages.Fetch():
                    self._fetch(request)
                case messages.End():
                    self._workshop.close()
                    self._readers.close()
                    return

    def _advance(self, name: str) -> None:
        try:
            next(self._tasks[name])
        except StopIteration:
            del self._tasks[name]
        except Broken as error:
            del self._tasks[name]
            self._send(messages.Unusable(load=None, problem=error.problem))

    def _send(self, message: messages.Answer, payload: bytes = b"") -> None:
        write_frame(self._answers, message, payload)

    def _list(self, request: messages.References) -> None:
        self._cache = Path(request.cache) if request.cache else None
        self._settings = Settings(seed=request.seed, align=request.align)
        self._targets = self._new_targets()
        try:
            listed = listing(request.origin)
        except CollectionError:  # the server lists the references too, and reports it to the author
            listed = Listing({}, {})
        self._gallery = Gallery(listed, self._cache, self._readers, self._gallery.facts, request.recorded)
        self._wanted = {}
        self._begin("axes", self._find_axes())
        self._begin("objects", self._split())
        self._tasks[_LOOKS] = self._overview.look(lambda: self._references, self._cache)

    def _split(self) -> Iterator[None]:
        for slug in self._gallery.listed.whole:
            with suppress(UnreadableError):
                names = self._gallery.objects(slug)
                if len(names) > 1:
                    self._gallery = self._gallery.parted(slug, names)
                    self._send(messages.Parted(slug=slug, names=names))
                    self._wanted.pop(slug, None)
                    self._want(self._gallery.listed.files)
            yield

    def _stand(self, facts: Facts, stances: Mapping[Slug, Stance]) -> None:
        """Have the references stand as a procedure with these facts builds, and as they were found to."""
        before = self._gallery
        self._gallery = Gallery(before.listed, self._cache, self._readers, facts, stances)
        self._targets = self._new_targets()
        changed = [slug for slug in before.listed.sources if stances.get(slug) != before.stances.get(slug)]
        self._tasks[_LOOKS] = self._overview.look(lambda: self._references, self._cache)
        self._want(before.listed.sources if facts.up != before.facts.up else changed)

    def _begin(self, name: str, task: Iterator[None]) -> None:
        """Before all else that is done between requests: that depends on it, or a page waits; in place of its like."""
        self._tasks = {name: task, **{other: one for other, one in self._tasks.items() if other != name}}

    def _find_axes(self) -> Iterator[None]:
        if self._gallery.unsettled:
            stances = yield from self._standing.find(self._gallery, self._workshop, self._settings.seed)
            self._stand(self._gallery.facts, stances)

    @property
    def _references(self) -> Gallery:
        """The references, once it is known what they are and how they stand."""
        while first := next((name for name in ("objects", "axes") if name in self._tasks), None):
            self._advance(first)
        return self._gallery

    def _want(self, slugs: Collection[Slug]) -> None:
        self._wanted |= dict.fromkeys(slug for slug in self._gallery.listed.sources if slug in slugs)
        self._tasks.setdefault("pictures", self._draw())

    def _draw(self) -> Iterator[None]:
        while self._wanted:
            slug = next((seen for seen in self._first if seen in self._wanted), None) or next(iter(self._wanted))
            del self._wanted[slug]
            try:
                picture, axes = self._gallery.picture(slug), self._gallery.axes(slug)
                self._send(messages.Drawn(slug=slug, axes=axes), picture)
                self._keep_shape(slug)
            except (UnreadableError, ValueError) as error:
                self._send(messages.Unreadable(slug=slug, reason=str(error)))
            yield

    def _keep_shape(self, slug: Slug) -> None:
        """A large mesh is ready sooner than it is asked for."""
        shape, path = self._gallery[slug].shape, self._gallery.kept_shape(slug)
        if isinstance(shape, Mesh) and path and 12 * len(shape.faces) > LARGE / 2 and not path.exists():
            keep_message(path, shape_messages.reference_message(shape, slug)[1])

    def _load(self, request: messages.Load) -> None:
        old = [name for name in self._tasks if name.startswith(("sweep", _EXPLORED))]
        for name in old:
            del self._tasks[name]
        path = Path(request.procedure)
        self._root = path.parent
        try:
            version = self._workshop.load(path, request.limits)
        except Broken as error:
            self._send(messages.Unusable(load=request.load, problem=error.problem))
        else:
            other = version.facts.up != self._gallery.facts.up
            if version.facts != self._gallery.facts:
                self._stand(version.facts, self._gallery.stances)
            if other or not self._standing.taught:
                self._begin("axes", self._find_axes())
            name, up = version.name, version.facts.up
            space, defaults = version.parameters, version.defaults
            self._send(messages.Loaded(load=request.load, up=up, name=name, parameters=space, defaults=defaults))

    def _new_targets(self) -> Targets:
        return Targets(lambda: self._references, self._settings, self._cache)

    def _measure(self, slug: Slug, shape: Shape) -> tuple[float, float] | None:
        return self._targets.measure(slug, shape)

    def _unlike(self, slug: Slug, replica: Shape) -> str | None:
        return self._gallery.unlike(slug, replica) if slug in self._gallery.listed.sources else None

    def _sweep(self, request: messages.SweepOrder) -> None:
        if self._workshop.open:
            looked_at = request.sweep, request.items, lambda: self._first
            self._tasks["sweep"] = Sweep(
                *looked_at, self._root, self._workshop, self._unlike, self._measure, self._send, request.least
            ).run()

    def _evaluate(self, client: int, request: Evaluate) -> None:
        """Answer in steps; the later ones are left out when something newer waits."""
        if not self._workshop.open:
            return
        number, slug = request.id, request.slug

        def answer(message: messages.LiveMessage | None, payload: bytes = b"") -> None:
            self._send(messages.Answered(client=client, message=message), payload)

        def fail(problem: Problem, active: list[str] | None = None) -> None:
            answer(FailedMessage(id=number, slug=slug, problem=problem, active=active))

        try:
            built = self._workshop.build(request.parameters or {}, request.beyond, slug)
        except Broken as error:
            fail(error.problem)
            return
        if built is None:
            return
        made = built.build
        if made.failure:
            fail(of_failure(made.failure, self._root, made.parameters), list(built.active) or None)
            return
        assert made.shape is not None
        replica = made.shape.normalised()
        head: dict[str, Any] = {"id": number, "slug": slug, "shape": "replica", **shape_messages.outcome(built)}
        target = self._targets.of(slug) if slug is not None else None
        if isinstance(replica, Mesh):
            answer(None, shape_messages.mesh_message(replica, **head))
        else:
            reference = target.shape if target and isinstance(target.shape, Drawing) else None
            answer(shape_messages.drawing_message(replica, reference, **head))
        if slug is None or self._inbox.outdated:
            return
        target = self._targets.suited(slug, replica)
        same = self._targets.same(slug, made.shape) if target else 1.0
        answer(shape_messages.verdict_message(target, replica, number, slug, same))
        if not request.residuals or self._inbox.outdated:
            return
        if target is None or not isinstance(target.shape, Mesh) or not isinstance(replica, Mesh):
            return
        if self._colours is None or self._colours.reference is not target.shape:
            self._colours = ResidualColours(target.shape)
        for side, residual in self._colours.of(replica).items():
            answer(None, shape_messages.residual_message(residual, id=number, slug=slug, shape=side))

    def _fetch(self, request: messages.Fetch) -> None:
        message: About | DrawingMessage | None = None
        payload, wrong = b"", None
        try:
            message, payload = fetched(request, self._references, self._workshop)
        except (KeyError, UnreadableError, ValueError, Broken) as error:
            wrong = str(error)
        self._send(messages.Reply(request=request.request, message=message, error=wrong), payload)


def main() -> None:
    """Serve on the process's own streams."""
    requests, answers = own_streams()
    workshop = Workshop()
    inbox = Inbox(workshop.interrupt)

    def listen() -> None:
        while frame := read_frame(requests, messages.Request):
            inbox.put(frame[0])
        inbox.put(messages.End())

    threading.Thread(target=listen, daemon=True).start()
    try:
        Bench(answers, inbox, workshop).run()
    finally:
        workshop.close()


if __name__ == "__main__":
    main()
