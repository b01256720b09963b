"""What is wrong with a project."""

from __future__ import annotations

from typing import Literal, TypeAlias, get_args

from shapewright.studio.session.pages import Pages
from shapewright.studio.wire.changes import ProblemsChanged
from shapewright.studio.wire.problems import Problem

Origin: TypeAlias = Literal[
    "bench", "project", "notes", "procedure", "references", "fit", "explain", "export", "shapes"
]
"""Where problems come from, the worst first."""


class ProblemList:
    """The problems of a project; pages are sent every change."""

    def __init__(self, pages: Pages) -> None:
        self._pages = pages
        self._problems: dict[Origin, list[Problem]] = {}

    @property
    def all(self) -> list[Problem]:
        """The worst first."""
        return [problem for origin in get_args(Origin) for problem in self._problems.get(origin, [])]

    def report(self, origin: Origin, problems: list[Problem]) -> None:
        """Replace the problems of one origin."""
        before, self._problems[origin] = self._problems.get(origin, []), problems
        if before != problems:
            self._pages.publish(ProblemsChanged(problems=self.all))
