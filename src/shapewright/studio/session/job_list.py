"""The jobs of a session: what they are asked to do, and what follows when they end."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine, Mapping
from typing import Any, get_args

from msgspec.structs import asdict

from shapewright.progress import AnswerKind
from shapewright.settings import Settings
from shapewright.studio.jobs.events import Guessed
from shapewright.studio.jobs.runner import Runner
from shapewright.studio.project.timings import Timings
from shapewright.studio.project.workspace import Project
from shapewright.studio.session.bench_link import BenchLink
from shapewright.studio.session.display import Display
from shapewright.studio.session.pages import Pages
from shapewright.studio.wire.changes import JobChanged
from shapewright.studio.wire.collection import Stage
from shapewright.studio.wire.requests import ExportOrder
from shapewright.studio.wire.work import Job, JobKind

_STAGES: Mapping[AnswerKind, Stage] = {"most similar samples": "early", "predicted": "predicted"}
_PROGRAM = "shapewright.studio.jobs.{}_job"
KINDS: tuple[JobKind, ...] = get_args(get_args(JobKind)[0])


class Refused(Exception):
    """A request cannot be served now; the message says why."""


class JobList:
    """One runner for each kind of job."""

    def __init__(
        self,
        project: Project,
        display: Display,
        bench: BenchLink,
        pages: Pages,
        timings: Timings,
        ended: Callable[[Job], object],
        printed: Callable[[JobKind, str], object],
    ) -> None:
        """Prepare all runners.

        ended: called with every job that has ended. printed: called with what a job prints.
        """
        self._timings = timings
        self._project, self._display, self._bench, self._pages, self._ended = project, display, bench, pages, ended
        self._runners = {kind: Runner(kind, project.folder, self._changed, self._guessed, printed) for kind in KINDS}
        self._tasks: set[asyncio.Task[Any]] = set()

    def jobs(self) -> dict[JobKind, Job]:
        """As the page gets them."""
        return {kind: runner.job() for kind, runner in self._runners.items()}

    @property
    def fitting(self) -> bool:
        return self._runners["fit"].running

    async def fit(self, settings: Settings, fresh: bool) -> None:
        """Start a fit; one that runs is ended first. Raises Refused, ProjectError.

        fresh: learn anew.
        """
        if not self._display.listed.sources:
            raise Refused(f"there are no references in {self._project.origin.source}")
        runs = self._project.home_of_runs()
        await self._runners["fit"].cancel()
        newest = None if fresh else self._display.newest()
        request = {
            "procedure": str(self._project.procedure),
            "origin": vars(self._project.origin),
            "settings": settings.record(),
            "runs": str(runs),
            "previous": str(newest) if newest and (newest / "predictor.pt").is_file() else None,
        }
        self._start("fit", request)

    def explain(self) -> None:
        """Explain the run that is shown. Raises Refused."""
        if self._display.run is None:
            raise Refused("there is no run to explain yet; fit first")
        self._start("explain", {"run": str(self._display.run), "origin": vars(self._project.origin)})

    def export(self, order: ExportOrder) -> None:
        """Pack what the order names. Raises Refused."""
        run = self._display.run
        if run is None and set(order.what) != {"samples"}:
            raise Refused("there is no run to export yet; fit first, or export samples alone")
        place: dict[str, Any] = {"run": str(run) if run else None, "procedure": str(self._project.procedure)}
        place |= {"origin": vars(self._project.origin)}
        folder = self._project.scratch("exports")
        self._start("export", {**asdict(order), **place, "folder": str(folder)})

    def cancel(self, kind: JobKind) -> None:
        """End a job, if it runs."""
        self.spawn(self._runners[kind].cancel())

    async def end(self) -> None:
        """End all."""
        for runner in self._runners.values():
            await asyncio.shield(runner.cancel())

    def spawn(self, work: Coroutine[Any, Any, Any]) -> None:
        """Do something while other things go on."""
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def _start(self, kind: JobKind, request: dict[str, Any]) -> None:
        if self._runners[kind].running:
            raise Refused(f"{kind} is running already; cancel it first")
        self._runners[kind].start(_PROGRAM.format(kind), request, self._timings.of(kind))

    def _changed(self, runner: Runner) -> None:
        job = runner.job()
        self._pages.publish(JobChanged(job=job))
        if not runner.running:
            if job.state == "done":
                self._timings.note(job.kind, job.stages)
            self._ended(job)

    def _guessed(self, event: Guessed) -> None:
        if event.kind in _STAGES:
            slugs = self._display.board.slugs
            known = {slugs[name]: values for name, values in event.answer.items() if name in slugs}
            self._bench.guess(_STAGES[event.kind], known)
