"""What the author chose: settings, and marks, which move a cut. Both last over a restart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from shapewright.runs.folder import RunError
from shapewright.runs.marks import mark_pair
from shapewright.settings import Settings
from shapewright.studio.project.preferences import Preferences
from shapewright.studio.project.workspace import Project
from shapewright.studio.session.display import Display
from shapewright.studio.session.marking import cuts, learned, marking
from shapewright.studio.session.pages import Pages
from shapewright.studio.session.problem_list import ProblemList
from shapewright.studio.session.standard import CUTS
from shapewright.studio.wire import changes
from shapewright.studio.wire.judgement import Learned, Marking
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.requests import MarkOrder


class Choices:
    """The settings and the marks of a session."""

    def __init__(
        self,
        project: Project,
        preferences: Preferences,
        display: Display,
        pages: Pages,
        problems: ProblemList,
        reseeded: Callable[[], object],
    ) -> None:
        """Take up what was chosen before.

        reseeded: called when measuring takes another seed.
        """
        self._project, self._display, self._pages, self._problems = project, display, pages, problems
        self._reseeded = reseeded
        self.preferences = preferences

    @property
    def settings(self) -> Settings:
        """Of the next fit."""
        return self.preferences.settings

    def open(self) -> None:
        """Follow the marks of before, where no other cut was chosen."""
        usual = (self.settings.replicated, self.settings.close) == (Settings.replicated, Settings.close)
        if self._learned() and usual:
            self._follow_marks()

    def marking(self) -> Marking:
        """The pairs that were marked, of references that are there; what they say, and what to mark next."""
        shown = self._display.board.standard.settings
        return marking(self._project.folder, self._display.run, self._display.board.slugs, self.settings, shown)

    def change(self, given: dict[str, Any]) -> changes.ChosenSettings:
        """Raises ValueError for an entry that cannot be, ProjectError where they cannot be kept."""
        before, preferences = self.settings, self.preferences.changed(given)
        self._project.keep_settings(preferences.chosen)
        self.preferences = preferences
        if self.settings.seed != before.seed:
            self._reseeded()
        self._settings_changed(before)
        return self.preferences.message()

    def mark(self, order: MarkOrder) -> None:
        """Set or take away the mark of a pair whose slugs are known; the cut follows. Raises RunError."""
        references = self._display.board.references
        said = self._learned()
        pair = references[order.a].name, references[order.b].name
        mark_pair(self._project.folder, pair, order.same, self._display.run)
        self.publish_marks()
        if said != self._learned():
            self._follow_marks()

    def publish_marks(self) -> None:
        """Tell the pages which marks there are."""
        self._pages.publish(changes.MarksChanged(marking=self.marking()))

    def _settings_changed(self, before: Settings) -> None:
        """Tell the pages; with another judge or other cuts the collection has other grades at once."""
        self._pages.publish(changes.SettingsChanged(settings=self.preferences.message()))
        if any(getattr(self.settings, name) != getattr(before, name) for name in CUTS):
            self._display.judge_by(self.settings)
            self.publish_marks()

    def _follow_marks(self) -> None:
        """Move the cut to where the marks ask for it; one that was typed holds no longer."""
        before = self.settings
        cut = cuts(self._learned(), before.judge)
        chosen = {name: value for name, value in self.preferences.chosen.items() if name not in cut}
        self._project.keep_settings(chosen)
        self.preferences = replace(self.preferences, settings=replace(before, **cut), chosen=chosen)
        self._settings_changed(before)

    def _learned(self) -> Learned | None:
        """What the marks say. A file of marks that cannot be read is a problem of the project."""
        try:
            found = learned(self._project.folder, self._display.run, self.settings.judge)
        except RunError as error:
            self._problems.report("project", [Problem("project", str(error))])
            return None
        self._problems.report("project", [])
        return found
