"""What follows from what: a save, a request of the page, an answer of the bench, the end of a fit."""

from __future__ import annotations

import asyncio
import contextlib
from dataclasses import replace
from functools import partial
from pathlib import Path

from shapewright.references.errors import CollectionError
from shapewright.runs.folder import EXPLANATION
from shapewright.storage import cache_folder
from shapewright.studio.bench import messages
from shapewright.studio.bench.client import BenchError
from shapewright.studio.jobs.sweeps import Sweeps
from shapewright.studio.project.authored import Authored
from shapewright.studio.project.console import Console
from shapewright.studio.project.preferences import Preferences
from shapewright.studio.project.timings import Timings
from shapewright.studio.project.watch import watch
from shapewright.studio.project.workspace import Missing, Project, ProjectError
from shapewright.studio.session.bench_link import BenchLink
from shapewright.studio.session.choices import Choices
from shapewright.studio.session.curating.curation import Curation
from shapewright.studio.session.display import Display
from shapewright.studio.session.history import summaries
from shapewright.studio.session.job_list import JobList, Refused
from shapewright.studio.session.pages import Page, Pages
from shapewright.studio.session.problem_list import ProblemList
from shapewright.studio.session.standard import Standard
from shapewright.studio.wire import changes
from shapewright.studio.wire.collection import Duplicate, Procedure
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.values import Slug
from shapewright.studio.wire.work import Job, Run
from shapewright.versions import version_of

_PATIENCE = 2.0
"""Seconds for which a fit after a save waits until the replicas of the new version are shown."""


class Session:
    """One studio: a project, a bench, jobs, and the pages that look at them. All methods run in one event loop."""

    def __init__(self, project: Project, preferences: Preferences) -> None:
        self.project = project
        self.pages = Pages()
        self.problems = ProblemList(self.pages)
        self.duplicates: list[Duplicate] = []
        self.console = Console(lambda lines: self.pages.publish(changes.LinesPrinted(lines=lines)))
        self.authored = Authored(project)
        self.display = Display(project, self.pages, cache_folder(), partial(self.problems.report, "shapes"))
        timings = Timings(project)
        self.sweeps = Sweeps(timings, lambda sweep: self.pages.publish(changes.SweepChanged(sweep=sweep)))
        self.bench = BenchLink(
            project, self.authored, self.display, self.pages, self.sweeps, self._heard, self._bench_changed
        )
        self.choices = Choices(project, preferences, self.display, self.pages, self.problems, self._measure_anew)
        self.curation = Curation(project, self.display, self.bench, self.pages, self.problems, self.references_changed)
        self.jobs = JobList(project, self.display, self.bench, self.pages, timings, self._job_ended, self.console.say)

    async def run(self) -> None:
        """Open the project, then serve until cancelled; ends all processes at the end."""
        self._list_references()
        self._read_source(saved=False)
        self.display.show(self.display.newest(of_version=True) or self.display.newest(), self.standard)
        self.choices.open()
        self.curation.open()
        try:
            async with asyncio.TaskGroup() as group:
                group.create_task(self._keep_bench())
                group.create_task(watch(self.project, self.source_saved, self.references_changed, self.runs_changed))
        finally:
            await self.jobs.end()

    async def _keep_bench(self) -> None:
        try:
            await self.bench.process.run()
        except BenchError as error:
            self.problems.report("bench", [Problem("project", str(error))])

    # What pages see

    def state(self) -> changes.State:
        """All that a page shows."""
        project = self.project
        return changes.State(
            version=version_of("shapewright"),
            project=changes.ProjectNames(
                name=project.folder.name,
                folder=str(project.folder),
                procedure=project.procedure.name,
                references=project.origin.source,
                takes_files=project.origin.confine is not None,
            ),
            dimension=self.display.listed.dimension,
            bench=self.bench.process.state,
            procedure=self._procedure(),
            collection=self.display.board.collection(),
            jobs=self.jobs.jobs(),
            sweep=self.sweeps.sweep(),
            runs=self.runs(),
            settings=self.choices.preferences.message(),
            marking=self.choices.marking(),
            noted=self.curation.noted(),
            duplicates=self.duplicates,
            explanation=self.explained,
            console=self.console.lines,
            problems=self.problems.all,
        )

    def runs(self) -> list[Run]:
        """All runs, oldest first."""
        return summaries(self.project.runs, self.display.board.run)

    @property
    def explained(self) -> bool:
        """Whether the run that is shown has an explanation."""
        return self.display.run is not None and (self.display.run / EXPLANATION).is_file()

    def _procedure(self) -> Procedure:
        runs = self.runs()
        return self.authored.procedure(self.display.outdated, runs[-1].digest if runs else None)

    # What pages ask for

    def open_page(self) -> Page:
        """A new page; the whole state is the first thing it is sent."""
        page = self.pages.open()
        self.pages.send(page.number, self.state())
        return page

    def close_page(self, page: Page) -> None:
        self.pages.close(page)
        self.bench.forget(page.number)

    def known(self, slug: str) -> Slug:
        """Raises Missing for a reference that is not there."""
        if slug not in self.display.board.references:
            raise Missing(f"there is no reference {slug!r}")
        return slug

    async def fit(self, fresh: bool = False) -> None:
        """Start a fit; one that runs is ended first. Raises Refused."""
        if self.authored.state == "broken":
            raise Refused("the procedure cannot be used; mend it first")
        settings = self.choices.settings
        patterns = [*settings.patterns, *self.curation.patterns]
        await self.jobs.fit(replace(settings, leave_out=", ".join(patterns)), fresh or self.choices.preferences.fresh)

    # What happens on disk

    def source_saved(self) -> None:
        """The author saved a Python file of the project; a fit of the version before is of no use any more."""
        if self.authored.changed():
            self.jobs.cancel("fit")
            self._read_source(saved=True)

    def references_changed(self) -> None:
        """Files came, went or changed among the references."""
        self._list_references()
        self._show(self.display.run or self.display.newest())
        self._measure_anew()
        if self.authored.state == "good" and self.display.board.stale:
            self.bench.sweep("carried", self.display.board.parameters)

    def runs_changed(self) -> None:
        """Runs or explanations came or went; one that the command line makes of this procedure is shown."""
        if self.jobs.fitting:
            return  # its own run is shown when it has ended
        fitted = self.display.newest(of_version=True)
        gone = self.display.run is not None and self.display.run not in self.project.runs
        if (fitted and fitted != self.display.run) or gone:
            self._show(fitted or self.display.newest())
        else:
            self.display.explain()
        self.pages.publish(changes.RunsChanged(runs=self.runs()))
        self.pages.publish(changes.ExplanationChanged(explanation=self.explained))
        self.pages.publish(changes.ProcedureChanged(procedure=self._procedure()))

    def _measure_anew(self) -> None:
        self.bench.list_references(self.choices.settings)

    def _show(self, run: Path | None) -> None:
        """Show a run, and ask for its marks."""
        self.sweeps.stop()
        self.display.show(run, self.standard)
        self.bench.run_shown(self.choices.settings)
        self.choices.publish_marks()

    def _list_references(self) -> None:
        try:
            self.display.relist()
            self.problems.report("references", [])
        except CollectionError as error:
            alarm = not self.project.is_new  # the page says what to do first
            self.problems.report("references", [Problem("references", str(error))] if alarm else [])

    def _read_source(self, saved: bool) -> None:
        self.sweeps.stop()  # the bench gives up what it does for the version before
        try:
            self.authored.read(saved)
        except ProjectError as error:
            self._break(Problem("project", str(error), self.project.procedure.name))
            return
        self.display.of_version(self.authored.digest, self.authored.version)
        self.pages.publish(changes.ProcedureChanged(procedure=self._procedure()))
        self.bench.load(self.choices.settings)

    def _break(self, problem: Problem) -> None:
        self.authored.reject()
        self.display.of_version(self.authored.digest, self.authored.version)
        self.problems.report("procedure", [problem])
        self.pages.publish(changes.ProcedureChanged(procedure=self._procedure()))

    # What the bench says

    def _bench_changed(self) -> None:
        self.sweeps.stop()
        self.pages.publish(self.state())
        if self.bench.process.state == "ready":
            self._measure_anew()
            self.bench.load(self.choices.settings)

    def _heard(self, message: messages.News, payload: bytes) -> None:
        match message:
            case messages.Loaded():
                if message.load == self.authored.load:
                    self._take_version(message)
            case messages.Alike():
                self.duplicates = message.duplicates
                self.pages.publish(changes.DuplicatesChanged(duplicates=self.duplicates))
            case messages.Unusable():
                if message.load in (None, self.authored.load):
                    self._break(message.problem)
            case messages.Printed():
                self.console.say("procedure", message.text, message.slug)
            case _:
                self.display.take(message, payload)
                self._count(message)

    def _count(self, message: messages.News) -> None:
        match message:
            case messages.Swept() | messages.Measured():
                self.sweeps.step(message.sweep, isinstance(message, messages.Measured))
            case messages.SweepEnded():
                self.sweeps.end(message.sweep)

    def _take_version(self, loaded: messages.Loaded) -> None:
        """Show the new version: a run of it where there is one, else the replicas of before, carried over."""
        saved, self.authored.saved = self.authored.saved, False
        self.authored.accept(loaded.name, loaded.parameters, loaded.defaults, loaded.up)
        self.problems.report("procedure", [])
        self.display.of_version(self.authored.digest, self.authored.version)
        fitted = self.display.newest(of_version=True)
        if fitted:
            self._show(fitted)  # even where it is shown: an edit since may have put its own replicas there
        else:
            self.bench.sweep("carried", self.display.board.parameters)
        self.pages.publish(changes.ProcedureChanged(procedure=self._procedure()))
        self.bench.evaluate_waiting()
        if saved and not fitted and self.choices.preferences.auto_fit and self.display.listed.sources:
            self.jobs.spawn(self._fit_soon(self.authored.load))

    async def _fit_soon(self, load: int) -> None:
        """Fit once the replicas of the new version are shown, unless a newer version came."""
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self.display.swept.wait(), _PATIENCE)
        if load == self.authored.load and self.authored.state == "good":
            await self.fit()

    # What jobs do

    def _job_ended(self, job: Job) -> None:
        self.problems.report(job.kind, [job.problem] if job.problem else [])
        if job.kind == "fit" and job.state == "done":
            self._show(self.display.newest())
            self.bench.sweep("carried", {})
            self.pages.publish(changes.ProcedureChanged(procedure=self._procedure()))
        if job.kind == "explain" and job.state == "done":
            self.display.explain()
        if job.kind in ("fit", "explain"):
            self.pages.publish(changes.RunsChanged(runs=self.runs()))
            self.pages.publish(changes.ExplanationChanged(explanation=self.explained))

    @property
    def standard(self) -> Standard:
        """What the next fit judges by."""
        return Standard.of(self.choices.settings, self.display.listed.dimension)
