"""What follows from what: a save, a wish of the page, an answer of the bench, the end of a fit."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Coroutine, Mapping
from importlib.metadata import version
from typing import Any

from shapewright.judging.paper import Metric, fidelity_metric, light_field_metric
from shapewright.progress import AnswerKind
from shapewright.references.errors import CollectionError
from shapewright.runs.folder import EXPLANATION, RunError
from shapewright.runs.marks import pairs, replace_pairs
from shapewright.storage import cache_folder
from shapewright.studio.bench.client import BenchError, BenchProcess
from shapewright.studio.jobs.runner import Job, Kind
from shapewright.studio.project.authored import Authored
from shapewright.studio.project.preferences import Preferences
from shapewright.studio.project.watch import watch
from shapewright.studio.project.workspace import Project, ProjectError
from shapewright.studio.session.board import Stage, tint
from shapewright.studio.session.history import summaries
from shapewright.studio.session.pages import Page, Pages
from shapewright.studio.session.showing import Showing
from shapewright.studio.wire.problems import Problem

_STAGES: Mapping[AnswerKind, Stage] = {"most similar samples": "early", "predicted": "predicted"}
_PATIENCE = 2.0
"""Seconds for which a fit after a save waits until the replicas of the new version are shown."""
_SOURCES = ("bench", "project", "procedure", "references", "fit", "explain", "export", "shapes")
Message = dict[str, Any]


class Refused(Exception):
    """A request cannot be served now; the message says why."""


class Session:
    """One studio: a project, a bench, jobs, and the pages that look at them. All methods run in one event loop."""

    def __init__(self, project: Project, preferences: Preferences) -> None:
        self.project, self.preferences = project, preferences
        self.pages = Pages()
        self.authored = Authored(project)
        self.showing = Showing(project, self.pages, cache_folder(), lambda found: self._report("shapes", found))
        self.bench = BenchProcess(self._heard, self._answered, self._bench_started, self._bench_lost)
        kinds: tuple[Kind, ...] = ("fit", "explain", "export")
        self.jobs = {kind: Job(kind, project.folder, self._job_changed, self._job_told) for kind in kinds}
        self._bench_state = "starting"
        self._problems: dict[str, list[Problem]] = {}
        self._waiting: dict[int, Message] = {}
        self._first: list[str] = []
        self._tasks: set[asyncio.Task[Any]] = set()

    async def run(self) -> None:
        """Open the project, then serve until cancelled; ends all processes at the end."""
        self._list_references()
        self.showing.show(self.showing.newest(), self.metric)
        self._read_source(saved=False)
        try:
            async with asyncio.TaskGroup() as group:
                group.create_task(self._keep_bench())
                group.create_task(watch(self.project, self.source_saved, self.references_changed))
        finally:
            for job in self.jobs.values():
                await asyncio.shield(job.cancel())

    async def _keep_bench(self) -> None:
        try:
            await self.bench.run()
        except BenchError as error:
            self._report("bench", [Problem("project", str(error))])

    # What pages see

    def snapshot(self) -> Message:
        """The page's ``State``."""
        project = self.project
        return {
            "version": version("shapewright"),
            "project": {
                "name": project.folder.name,
                "folder": str(project.folder),
                "procedure": project.procedure.name,
                "references": project.origin.source,
            },
            "dimension": self.showing.listed.dimension,
            "bench": self._bench_state,
            "procedure": self._procedure(),
            "collection": self.showing.board.record(),
            "jobs": {kind: job.record() for kind, job in self.jobs.items()},
            "runs": self.runs(),
            "settings": self.preferences.record(),
            "marks": self.marks(),
            "explanation": self.explained,
            "problems": self._all_problems(),
        }

    def runs(self) -> list[Message]:
        """The page's ``Run`` of every run, oldest first."""
        return summaries(self.project.runs, self.showing.board.run)

    @property
    def explained(self) -> bool:
        """Whether the run shown has an explanation."""
        return self.showing.run is not None and (self.showing.run / EXPLANATION).is_file()

    def marks(self) -> list[Message]:
        """The pairs that were marked, by slug, of references that are there."""
        slugs = self.showing.slugs()
        try:
            judged = pairs(self.project.folder)
        except RunError as error:
            self._problems["project"] = [Problem("project", str(error))]
            return []
        self._problems.pop("project", None)
        return [{"a": slugs[a], "b": slugs[b], "same": same} for a, b, same in judged if a in slugs and b in slugs]

    def _procedure(self) -> Message:
        stale = any(tile.stale for tile in self.showing.board.tiles.values())
        runs = self.runs()
        return self.authored.record(stale, runs[-1]["digest"] if runs else None)

    def _report(self, source: str, problems: list[Problem]) -> None:
        """Replace the problems that one source told."""
        if self._problems.get(source, []) != problems:
            self._problems[source] = problems
            self.pages.publish("problems", problems=self._all_problems())

    def _all_problems(self) -> list[Message]:
        return [problem.record() for source in _SOURCES for problem in self._problems.get(source, [])]

    # What pages ask for

    def open_page(self) -> Page:
        """A new page; the whole state is the first thing it is sent."""
        page = self.pages.open()
        page.send({"type": "state", **self.snapshot()})
        return page

    def close_page(self, page: Page) -> None:
        self.pages.close(page)
        self._waiting.pop(page.number, None)

    def evaluate(self, client: int, message: Message) -> None:
        """Live evaluation, see PROTOCOL.md; what a page asks while the bench starts waits, the newest alone."""
        if self._bench_state != "ready" or self.authored.state == "loading":
            self._waiting[client] = message
            return
        tile = self.showing.board.tiles.get(message["slug"])
        values = self.authored.values(tile.parameters if tile else None, message["parameters"])
        self.bench.ask({**message, "do": "evaluate", "client": client, "parameters": values})

    def put_first(self, slugs: list[str]) -> None:
        """Say which references the author is looking at."""
        self._first = slugs
        self.bench.ask({"do": "first", "slugs": slugs})

    def change_preferences(self, given: Message) -> Message:
        """Raises ValueError for an entry that cannot be."""
        before, self.preferences = self.preferences, self.preferences.changed(given)
        if self.preferences.settings.seed != before.settings.seed:
            self._tell_references()
        self.pages.publish("settings", settings=self.preferences.record())
        return self.preferences.record()

    def set_marks(self, marks: list[Message]) -> None:
        """Replace the marks of the references that are there, all of whose slugs are known. Raises RunError."""
        names = {slug: tile.name for slug, tile in self.showing.board.tiles.items()}
        wanted = [(names[mark["a"]], names[mark["b"]], mark["same"]) for mark in marks]
        replace_pairs(self.project.folder, wanted, set(names.values()), self.showing.run)
        self.pages.publish("marks", marks=self.marks())

    async def fit(self, fresh: bool = False) -> None:
        """Start a fit; one that runs is ended first. Raises Refused."""
        if self.authored.state == "broken":
            raise Refused("the procedure cannot be used; mend it first")
        if not self.showing.listed.sources:
            raise Refused(f"there are no references in {self.project.origin.source}")
        await self.jobs["fit"].cancel()
        newest = None if fresh or self.preferences.fresh else self.showing.newest()
        request = {
            "procedure": str(self.project.procedure),
            "origin": vars(self.project.origin),
            "settings": self.preferences.settings.record(),
            "runs": str(self.project.folder / "runs"),
            "previous": str(newest) if newest and (newest / "predictor.pt").is_file() else None,
        }
        self.jobs["fit"].start("shapewright.studio.jobs.fit_job", request)

    def explain(self) -> None:
        """Explain the run that is shown. Raises Refused."""
        if self.showing.run is None:
            raise Refused("there is no run to explain yet; fit first")
        request = {"run": str(self.showing.run), "origin": vars(self.project.origin)}
        self._start("explain", "shapewright.studio.jobs.explain_job", request)

    def export(self, request: Message) -> None:
        """Pack what the request names. Raises Refused."""
        run = self.showing.run
        if run is None and set(request["what"]) != {"samples"}:
            raise Refused("there is no run to export yet; fit first, or export samples alone")
        place = {"run": str(run) if run else None, "procedure": str(self.project.procedure)}
        folder = self.project.scratch() / "exports"
        self._start("export", "shapewright.studio.jobs.export_job", {**request, **place, "folder": str(folder)})

    def cancel(self, kind: Kind) -> None:
        """End a job, if it runs."""
        self._spawn(self.jobs[kind].cancel())

    def _start(self, kind: Kind, module: str, request: Message) -> None:
        if self.jobs[kind].running:
            raise Refused(f"{kind} is running already; cancel it first")
        self.jobs[kind].start(module, request)

    # What happens on disk

    def source_saved(self) -> None:
        """The author saved a Python file of the project; a fit of the version before is of no use any more."""
        if self.authored.changed():
            self.cancel("fit")
            self._read_source(saved=True)

    def references_changed(self) -> None:
        """Files came, went or changed among the references."""
        self._list_references()
        self.showing.show(self.showing.run or self.showing.newest(), self.metric)
        self._tell_references()

    def _list_references(self) -> None:
        try:
            self.showing.relist()
            self._report("references", [])
        except CollectionError as error:
            self._report("references", [Problem("references", str(error))])

    def _read_source(self, saved: bool) -> None:
        try:
            self.authored.read(saved)
        except ProjectError as error:
            self._break(Problem("project", str(error), self.project.procedure.name))
            return
        self.pages.publish("procedure", procedure=self._procedure())
        self._ask_load()

    def _break(self, problem: Problem) -> None:
        self.authored.reject()
        self.showing.stale()
        self._report("procedure", [problem])
        self.pages.publish("procedure", procedure=self._procedure())

    # What the bench says

    def _bench_started(self) -> None:
        self._bench_state = "ready"
        self.pages.publish("state", **self.snapshot())
        self._tell_references()
        self._ask_load()

    def _bench_lost(self) -> None:
        self._bench_state = "restarting"
        self.pages.publish("state", **self.snapshot())

    def _tell_references(self) -> None:
        cache = str(self.showing.cache) if self.showing.cache else None
        origin, settings = vars(self.project.origin), self.preferences.settings
        judged = {"align": settings.align, "seed": settings.seed}
        self.bench.ask({"do": "references", "origin": origin, "cache": cache, **judged})
        self.bench.ask({"do": "first", "slugs": self._first})
        self.bench.ask({"do": "pictures", "slugs": self.showing.missing})

    def _ask_load(self) -> None:
        settings = self.preferences.settings
        limits = {"seconds": settings.shape_seconds, "memory_mb": settings.shape_memory_mb}
        request = {"do": "load", "load": self.authored.load, "procedure": str(self.project.procedure)}
        self.bench.ask({**request, **limits})

    def _heard(self, message: Message, payload: bytes) -> None:
        kind = message["type"]
        if kind == "picture":
            self.showing.drawn(message["slug"], payload)
        elif kind == "unreadable":
            self.showing.unreadable(message["slug"], message["reason"])
        elif kind in ("swept", "measured", "swept all"):
            self.showing.take(message, payload)
        elif message.get("load", self.authored.load) != self.authored.load:
            return
        elif kind == "loaded":
            self._take_version(message["version"])
        elif kind == "broken":
            self._break(Problem.from_record(message["problem"]))

    def _take_version(self, version: Message) -> None:
        """Show the new version: a run of it where there is one, else what was found before, carried over."""
        saved, self.authored.saved = self.authored.saved, False
        self.authored.accept(version)
        self._report("procedure", [])
        fitted = None if self.authored.helper else self.showing.newest(self.authored.digest)
        if fitted:
            if fitted != self.showing.run or any(tile.stale for tile in self.showing.board.tiles.values()):
                self.showing.show(fitted, self.metric)
        else:
            self._sweep("carried", self.showing.found)
        self.pages.publish("procedure", procedure=self._procedure())
        waiting, self._waiting = self._waiting, {}
        for client, request in waiting.items():
            self.evaluate(client, request)
        if saved and not fitted and self.preferences.auto_fit and self.showing.listed.sources:
            self._spawn(self._fit_soon(self.authored.load))

    async def _fit_soon(self, load: int) -> None:
        """Fit once the replicas of the new version are shown, unless a newer version came."""
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self.showing.swept.wait(), _PATIENCE)
        if load == self.authored.load and self.authored.state == "good":
            await self.fit()

    def _sweep(self, stage: Stage, items: Mapping[str, Any]) -> None:
        number = self.showing.begin_sweep(stage, list(items))
        self.bench.ask({"do": "sweep", "sweep": number, "items": items})

    def _answered(self, client: int, message: Message | None, payload: bytes) -> None:
        if message is None:
            self.pages.send(client, payload)
            return
        if message["type"] == "distance":
            metric, distance = self.showing.board.metric, message["distance"]
            within = distance is not None and distance <= metric.threshold
            message = {**message, "colour": tint(distance, metric), "compatible": within}
        self.pages.send(client, message)

    # What jobs say

    def _job_told(self, event: Message) -> None:
        if event["event"] == "answer" and event["kind"] in _STAGES:
            slugs = self.showing.slugs()
            items = {slugs[name]: values for name, values in event["answer"].items() if name in slugs}
            self._sweep(_STAGES[event["kind"]], items)

    def _job_changed(self, job: Job) -> None:
        self.pages.publish("job", job=job.record())
        if job.running:
            return
        self._report(job.kind, [job.problem] if job.problem else [])
        if job.kind == "fit" and job.state == "done":
            self.showing.show(self.showing.newest(), self.metric)
            self._sweep("carried", {})
            self.pages.publish("procedure", procedure=self._procedure())
        if job.kind in ("fit", "explain"):
            self.pages.publish("runs", runs=self.runs())
            self.pages.publish("explanation", explanation=self.explained)

    @property
    def metric(self) -> Metric:
        """What the next fit measures by."""
        settings = self.preferences.settings
        solid = self.showing.listed.dimension == 3
        return light_field_metric(settings.threshold) if solid else fidelity_metric(settings.fidelity)

    def _spawn(self, work: Coroutine[Any, Any, Any]) -> None:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
