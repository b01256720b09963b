"""The program of the bench: the process that draws and measures for the server, beside any fit.

Requests and answers are frames (see wire/child). What the author waits for at this moment, live evaluation, comes
first; pictures and sweeps over the whole collection are done in between, shape by shape.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO

from shapewright.building.outcomes import Limits
from shapewright.judging.judge import target_of
from shapewright.judging.target import Measures, Target
from shapewright.references.errors import CollectionError, UnreadableError
from shapewright.rendering.cameras import THUMBNAIL
from shapewright.rendering.thumbnails import thumbnail
from shapewright.settings import Settings
from shapewright.shapes import Drawing, Mesh, Shape
from shapewright.studio.bench.gallery import Gallery, Shelf, shape_bytes
from shapewright.studio.bench.inbox import Inbox, Request
from shapewright.studio.bench.residual_colours import ResidualColours
from shapewright.studio.bench.sweep import Sweep
from shapewright.studio.bench.telling import (
    about,
    distance_message,
    drawing_message,
    mesh_message,
    replica_header,
    residual_message,
)
from shapewright.studio.bench.workshop import Broken, Workshop
from shapewright.studio.project.listing import Listing, Origin, listing
from shapewright.studio.wire.child import own_streams, read_frame, write_frame
from shapewright.studio.wire.problems import of_failure

_MEMORY = 24 * 2**20


class Bench:
    """Answers the requests of an inbox until one of them is to end."""

    def __init__(self, answers: BinaryIO, inbox: Inbox, workshop: Workshop) -> None:
        self._answers, self._inbox, self._workshop = answers, inbox, workshop
        self._gallery = Gallery(Listing({}, {}), None)
        self._targets: Shelf[Target] = Shelf(_MEMORY, _bytes)
        self._colours: ResidualColours | None = None
        self._cache: Path | None = None
        self._settings = Settings()
        self._root = Path()
        self._first: list[str] = []
        self._tasks: dict[str, Iterator[None]] = {}

    def run(self) -> None:
        """Serve; tasks are moved on while no request waits."""
        handlers: Mapping[str, Callable[[Request], None]] = {
            "references": self._references,
            "pictures": self._pictures,
            "first": self._put_first,
            "load": self._load,
            "sweep": self._sweep,
            "evaluate": self._evaluate,
            "fetch": self._fetch,
        }
        self._tell({"type": "ready"})
        while True:
            request = self._inbox.take(wait=not self._tasks)
            if request is None:
                self._advance(next(iter(self._tasks)))
            elif request["do"] == "end":
                self._workshop.close()
                return
            else:
                handlers[request["do"]](request)

    def _advance(self, name: str) -> None:
        try:
            next(self._tasks[name])
        except StopIteration:
            del self._tasks[name]
        except Broken as error:
            del self._tasks[name]
            self._tell({"type": "broken", "problem": error.problem.record()})

    def _tell(self, message: Mapping[str, Any], payload: bytes = b"") -> None:
        write_frame(self._answers, {"to": "session", "message": message}, payload)

    def _references(self, request: Request) -> None:
        self._cache = Path(request["cache"]) if request["cache"] else None
        self._settings = Settings(seed=request["seed"], align=request["align"])
        self._targets = Shelf(_MEMORY, _bytes)
        try:
            self._gallery = Gallery(listing(Origin(**request["origin"])), self._cache)
        except CollectionError:  # the server lists the references too, and tells the author
            self._gallery = Gallery(Listing({}, {}), None)

    def _put_first(self, request: Request) -> None:
        self._first = request["slugs"]

    def _pictures(self, request: Request) -> None:
        def draw() -> Iterator[None]:
            remaining = dict.fromkeys(slug for slug in request["slugs"] if slug in self._gallery.listed.sources)
            while remaining:
                slug = next((each for each in self._first if each in remaining), None) or next(iter(remaining))
                del remaining[slug]
                try:
                    self._tell({"type": "picture", "slug": slug}, self._gallery.picture(slug))
                except (UnreadableError, ValueError) as error:
                    self._tell({"type": "unreadable", "slug": slug, "reason": str(error)})
                yield

        self._tasks["pictures"] = draw()

    def _load(self, request: Request) -> None:
        self._tasks.pop("sweep", None)
        path = Path(request["procedure"])
        self._root = path.parent
        try:
            version = self._workshop.load(path, Limits(request["seconds"], request["memory_mb"]))
        except Broken as error:
            self._tell({"type": "broken", "load": request["load"], "problem": error.problem.record()})
        else:
            self._tell({"type": "loaded", "load": request["load"], "version": vars(version)})

    def _sweep(self, request: Request) -> None:
        if self._workshop.open:
            self._tasks["sweep"] = Sweep(
                request["sweep"],
                request["items"],
                lambda: self._first,
                self._root,
                self._workshop,
                self._target,
                self._tell,
            ).run()

    def _target(self, slug: str) -> Target | None:
        """None for a reference that is not there or cannot be read."""
        try:
            return self._targets.get(slug) or self._targets.put(slug, self._new_target(slug))
        except (KeyError, UnreadableError):
            return None

    def _new_target(self, slug: str) -> Target:
        return target_of(self._gallery[slug].shape, self._settings, self._cache)

    def _evaluate(self, request: Request) -> None:
        """Answer in steps; the later ones are left out when something newer waits."""
        if not self._workshop.open:
            return
        case = {"id": request["id"], "slug": request["slug"]}

        def answer(message: Mapping[str, Any] | None, payload: bytes = b"") -> None:
            envelope = {"to": "live", "client": request["client"], "message": message}
            write_frame(self._answers, envelope, payload)

        try:
            built = self._workshop.build(request["parameters"])
        except Broken as error:
            answer({"type": "failed", **case, "problem": error.problem.record(), "active": None})
            return
        if built is None:
            return
        made = built.build
        if made.failure:
            found = of_failure(made.failure, self._root, made.parameters)
            active = list(built.active) or None
            answer({"type": "failed", **case, "problem": found.record(), "active": active})
            return
        assert made.shape is not None
        replica, header = made.shape.normalised(), {**case, **replica_header(built)}
        target = self._target(request["slug"]) if request["slug"] is not None else None
        if isinstance(replica, Mesh):
            answer(None, mesh_message(replica, header))
        else:
            reference = target.shape if target and isinstance(target.shape, Drawing) else None
            answer(drawing_message(replica, reference, header))
        if request["slug"] is None or self._inbox.outdated:
            return
        answer(distance_message(target.measures(replica) if target else Measures(), case))
        if not request["residuals"] or self._inbox.outdated:
            return
        if target is None or not isinstance(target.shape, Mesh) or not isinstance(replica, Mesh):
            return
        if self._colours is None or self._colours.reference is not target.shape:
            self._colours = ResidualColours(target.shape)
        for side, residual in self._colours.of(replica).items():
            answer(None, residual_message(residual, {**case, "shape": side}))

    def _fetch(self, request: Request) -> None:
        message: dict[str, Any] = {}
        payload = b""
        try:
            reference = self._gallery[request["slug"]]
            if request["what"] == "about":
                message = about(reference)
            elif request["what"] == "shape":
                header = {"id": 0, "slug": request["slug"], "shape": "reference"}
                if isinstance(reference.shape, Mesh):
                    payload = mesh_message(reference.shape, header)
                else:
                    message = drawing_message(reference.shape, None, header)
            else:
                shape = self._replica(request) if request["parameters"] is not None else reference.shape
                camera = replace(THUMBNAIL, azimuth=request["azimuth"], elevation=request["elevation"])
                payload = thumbnail(shape, request["size"], camera)
        except (KeyError, UnreadableError, ValueError, Broken) as error:
            message = {"error": str(error)}
        write_frame(self._answers, {"to": "reply", "request": request["request"], "message": message}, payload)

    def _replica(self, request: Request) -> Shape:
        built = self._workshop.build(request["parameters"]) if self._workshop.open else None
        if built is None or built.build.shape is None:
            raise ValueError("there is no replica")
        return built.build.shape


def _bytes(target: Target) -> int:
    return 3 * shape_bytes(target.shape)


def main() -> None:
    """Serve on the process's own streams."""
    requests, answers = own_streams()
    workshop = Workshop()
    inbox = Inbox(workshop.interrupt)

    def listen() -> None:
        while frame := read_frame(requests):
            inbox.put(frame[0])
        inbox.put({"do": "end"})

    threading.Thread(target=listen, daemon=True).start()
    try:
        Bench(answers, inbox, workshop).run()
    finally:
        workshop.close()


if __name__ == "__main__":
    main()
