"""The bench as the session uses it: what it has to know, and what waits while it starts."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from msgspec.structs import replace

from shapewright.processes import Limits
from shapewright.settings import Settings
from shapewright.studio.bench.client import BenchProcess
from shapewright.studio.bench.messages import (
    Exploring,
    First,
    Live,
    LiveMessage,
    Load,
    News,
    Pictures,
    References,
    SweepOrder,
)
from shapewright.studio.jobs.sweeps import Sweeps
from shapewright.studio.project.authored import Authored
from shapewright.studio.project.workspace import Project
from shapewright.studio.session.display import Display
from shapewright.studio.session.pages import Pages
from shapewright.studio.wire.answers import ExploredMessage, VerdictMessage
from shapewright.studio.wire.collection import Stage
from shapewright.studio.wire.requests import Evaluate, Explore
from shapewright.studio.wire.values import Slug, Values


class BenchLink:
    """The bench of a session."""

    def __init__(
        self,
        project: Project,
        authored: Authored,
        display: Display,
        pages: Pages,
        sweeps: Sweeps,
        heard: Callable[[News, bytes], object],
        changed: Callable[[], object],
    ) -> None:
        """Link a session and its bench.

        heard: called with every message of the bench for the session.
        changed: called whenever the state of the process does.
        """
        self._project, self._authored, self._display, self._pages = project, authored, display, pages
        self._sweeps = sweeps
        self.process = BenchProcess(heard, self._answered, changed)
        self._waiting: dict[int, Evaluate] = {}
        self._first: list[Slug] = []
        self._recorded: dict[Slug, dict[str, Any]] = {}

    def evaluate(self, page: int, request: Evaluate) -> None:
        """Live evaluation; what a page asks while the bench starts waits, the newest alone."""
        if self.process.state != "ready" or self._authored.state == "loading":
            self._waiting[page] = request
            return
        shown = self._display.board.references.get(request.slug) if request.slug is not None else None
        values = self._authored.values(shown.parameters if shown else None, request.parameters)
        self.process.ask(Live(client=page, evaluate=replace(request, parameters=values)))

    def explore(self, page: int, request: Explore) -> None:
        """Show a page shapes without references; it asks again where the bench or the procedure is not ready."""
        if self.process.state == "ready" and self._authored.state == "good":
            self.process.ask(Exploring(client=page, order=request))

    def evaluate_waiting(self) -> None:
        """Ask what had to wait."""
        waiting, self._waiting = self._waiting, {}
        for page, request in waiting.items():
            self.evaluate(page, request)

    def forget(self, page: int) -> None:
        """Drop what waits for a page that is closed."""
        self._waiting.pop(page, None)

    def put_first(self, slugs: list[Slug]) -> None:
        """Say which references the author looks at."""
        self._first = slugs
        self.process.ask(First(slugs=slugs))

    def list_references(self, settings: Settings) -> None:
        """Say where the references are, and how they are measured."""
        cache = str(self._display.cache) if self._display.cache else None
        origin, align, seed = self._project.origin, settings.align, settings.seed
        self._recorded = self._display.recorded(self._display.run)
        self.process.ask(References(origin=origin, cache=cache, align=align, seed=seed, recorded=self._recorded))
        self.process.ask(First(slugs=self._first))
        self.process.ask(Pictures(slugs=self._display.missing))

    def run_shown(self, settings: Settings) -> None:
        """Another run is shown, which may have found other axes."""
        if self._recorded != self._display.recorded(self._display.run):
            self.list_references(settings)

    def load(self, settings: Settings) -> None:
        """Have the procedure read again."""
        limits = Limits(settings.shape_seconds, settings.shape_memory_mb)
        self.process.ask(Load(load=self._authored.load, procedure=str(self._project.procedure), limits=limits))

    def sweep(self, stage: Stage, items: Mapping[Slug, Values]) -> None:
        """Show replicas with these parameters."""
        number = self._display.begin_sweep(stage, list(items))
        self._sweeps.begin(number, len(items))
        self.process.ask(SweepOrder(sweep=number, items=dict(items)))

    def guess(self, stage: Stage, items: Mapping[Slug, Values]) -> None:
        """Show replicas with these parameters, where they are better than what is shown, or than the defaults."""
        number, shown = self._display.begin_sweep(stage, list(items)), self._display.board.parameters
        self._sweeps.stop()  # what a fit guesses belongs to the fit
        least = {slug: self._authored.values(shown.get(slug)) for slug in items}
        self.process.ask(SweepOrder(sweep=number, items=dict(items), least=least))

    def _answered(self, page: int, message: LiveMessage | None, payload: bytes) -> None:
        if isinstance(message, VerdictMessage):
            standard, fidelity, distance = self._display.board.standard, message.fidelity, message.distance
            message = replace(message, **standard.judged(fidelity, distance))
            message = replace(message, colour=standard.colour(message.grade, fidelity, distance))
        if isinstance(message, ExploredMessage) and payload:
            message = replace(message, picture=self._display.pictures.add(payload))
        self._pages.send(page, payload if message is None else message)
