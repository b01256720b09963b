"""What the author says of references: tags, notes, what is not his, how files stand. All of it can be undone."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from glob import escape

import numpy as np
from msgspec import convert
from msgspec.structs import asdict, replace

from shapewright.procedures.facts import Unit
from shapewright.references.orientation import QUARTER_TURNS, Orientation
from shapewright.shapes import Floats
from shapewright.studio.project.journal import Journal, Said
from shapewright.studio.project.listing import Listing
from shapewright.studio.project.notes import NOTHING, read_notes, write_notes
from shapewright.studio.project.telling import tell, told_of
from shapewright.studio.project.workspace import Missing, Project, ProjectError
from shapewright.studio.session.bench_link import BenchLink
from shapewright.studio.session.display import Display
from shapewright.studio.session.job_list import Refused
from shapewright.studio.session.pages import Pages
from shapewright.studio.session.problem_list import ProblemList
from shapewright.studio.wire import changes
from shapewright.studio.wire.detail import About, Told
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.requests import NoteOrder, Turn
from shapewright.studio.wire.revisions import Noted, ToldChange, ToldKind
from shapewright.studio.wire.values import Slug

_TOLD = "told"
TURNS: Mapping[Turn, Floats] = {
    "around": QUARTER_TURNS[1],
    "tip": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
    "over": np.diag([-1.0, -1.0, 1.0]),
}
"""Rotations (3, 3): a quarter turn about the up axis, a quarter turn towards the front, and upside down."""


class Curation:
    """Of one session.

    turned: called when files stand in another way.
    """

    def __init__(
        self,
        project: Project,
        display: Display,
        bench: BenchLink,
        pages: Pages,
        problems: ProblemList,
        turned: Callable[[], object],
    ) -> None:
        self._project, self._display, self._bench, self._pages = project, display, bench, pages
        self._problems, self._turned = problems, turned
        self._journal = Journal(project.folder / ".shapewright" / _TOLD, lambda: project.scratch(_TOLD))
        self._notes: Mapping[str, Noted] = {}

    def open(self) -> None:
        """Read what was noted before. A file that cannot be read is a problem of the project."""
        try:
            self._notes = read_notes(self._project.folder)
            self._problems.report("notes", [])
        except ProjectError as error:
            self._problems.report("notes", [Problem("project", str(error))])
        self._display.leave_out(self.not_mine)

    @property
    def not_mine(self) -> frozenset[str]:
        """Names of the references that are no part of the collection."""
        return frozenset(name for name, noted in self._notes.items() if noted.not_mine)

    @property
    def patterns(self) -> list[str]:
        """Of these names, as settings leave references out: such that one that is gone is no mistake."""
        return [_pattern(name) for name in sorted(self.not_mine)]

    def noted(self) -> dict[Slug, Noted]:
        """Of the references that are there."""
        slugs = self._display.board.slugs
        return {slugs[name]: noted for name, noted in self._notes.items() if name in slugs}

    def changes(self) -> list[ToldChange]:
        """All that was told, the newest first."""
        return self._journal.all()

    def note(self, order: NoteOrder) -> int | None:
        """Note something of references whose slugs are known; the number of the change. Raises ProjectError."""
        names = [self._display.board.references[slug].name for slug in order.slugs]
        before = read_notes(self._project.folder)
        changed = {name: _changed(before.get(name, NOTHING), order) for name in dict.fromkeys(names)}
        kind: ToldKind = "not mine" if order.not_mine is not None else "note" if order.note is not None else "tags"
        return self._write(kind, changed)

    def tell(self, told: Mapping[Slug, Told], undoes: int | None = None) -> int | None:
        """Say how files stand; the number of the change. Raises ProjectError; then nothing is written."""
        sources = {slug: self._display.listed.sources[slug] for slug in told}
        before = told_of(sources)
        changed = {slug: said for slug, said in told.items() if said != before[slug]}
        if not changed:
            return None
        names = {slug: sources[slug].name for slug in changed}
        tell(self._project, [(sources[slug], said) for slug, said in changed.items()])
        number = self._noted_down(
            "file",
            {names[slug]: Said(told=before[slug]) for slug in changed},
            {names[slug]: Said(told=said) for slug, said in changed.items()},
            undoes,
        )
        self._turned()
        return number

    async def turn(self, slugs: Sequence[Slug], turn: Turn) -> int | None:
        """Turn references by a right angle, from how they stand now. Raises Refused, ProjectError, BenchError."""
        listed, told = self._display.listed, {}
        before = told_of({slug: listed.sources[slug] for slug in slugs})
        for slug in dict.fromkeys(slugs):
            turned = (await self._stands(slug, listed)).then(TURNS[turn])
            told[slug] = replace(before[slug], **{word: getattr(turned, word) for word in ("up", "front")})
        return self.tell(told)

    def measure_in(self, slugs: Sequence[Slug], unit: Unit | None) -> int | None:
        """Say the unit of the lengths in files; all else that is told of them stays. Raises ProjectError."""
        before = told_of({slug: self._display.listed.sources[slug] for slug in slugs})
        return self.tell({slug: replace(told, unit=unit) for slug, told in before.items()})

    def undo(self, number: int) -> int | None:
        """Take a change back; what was told of other things since stays. Raises Missing, ProjectError."""
        try:
            entry = self._journal.entry(number)
        except KeyError as error:
            raise Missing("there is no such change any more") from error
        notes = read_notes(self._project.folder)
        noted, files = {}, {}
        slugs, listed = self._display.board.slugs, self._display.listed.sources
        now = told_of({name: listed[slugs[name]] for name in entry.before if name in slugs})
        for name, said in entry.before.items():
            after = entry.after.get(name, said)
            if said.noted and after.noted:
                noted[name] = _undone(notes.get(name, NOTHING), said.noted, after.noted)
            if said.told and after.told and name in slugs:
                files[slugs[name]] = _untold(now[name], said.told, after.told)
        if noted:
            return self._write(entry.kind, noted, number)
        return self.tell(files, number)

    def _write(self, kind: ToldKind, changed: Mapping[str, Noted], undoes: int | None = None) -> int | None:
        before = read_notes(self._project.folder)
        news = {name: noted for name, noted in changed.items() if noted != before.get(name, NOTHING)}
        if not news:
            return None
        write_notes(self._project.folder, news)
        said = {name: Said(noted=before.get(name, NOTHING)) for name in news}
        number = self._noted_down(kind, said, {name: Said(noted=noted) for name, noted in news.items()}, undoes)
        self.open()
        self._pages.publish(changes.NotedChanged(noted=self.noted()))
        return number

    def _noted_down(
        self, kind: ToldKind, before: Mapping[str, Said], after: Mapping[str, Said], undoes: int | None = None
    ) -> int | None:
        try:
            return self._journal.add(kind, before, after, undoes)
        except (OSError, ProjectError):
            return None  # the list is a help; what the author said holds without it

    async def _stands(self, slug: Slug, listed: Listing) -> Orientation:
        """Which axes of its file point up and to the front now."""
        source = listed.sources[slug]
        if source.by_author:
            return source.orientation
        message, _ = await self._bench.process.fetch(slug, "about")
        axes = convert(message, About).units.axes
        if len(axes) < 3:
            raise Refused(f"{source.name} is a drawing, which has no axes to turn about")
        return Orientation().then(np.asarray(axes))


def _changed(before: Noted, order: NoteOrder) -> Noted:
    tags = [tag for tag in before.tags if tag not in order.remove]
    return Noted(
        tags=[*tags, *(tag for tag in dict.fromkeys(order.add) if tag not in tags)],
        note=before.note if order.note is None else order.note.strip(),
        not_mine=before.not_mine if order.not_mine is None else order.not_mine,
    )


def _undone(now: Noted, before: Noted, after: Noted) -> Noted:
    """What holds now, without what led from ``before`` to ``after``."""
    came, went = _without(after.tags, before.tags), _without(before.tags, after.tags)
    return Noted(
        tags=[*_without(now.tags, came), *_without(went, now.tags)],
        note=before.note if before.note != after.note else now.note,
        not_mine=before.not_mine if before.not_mine != after.not_mine else now.not_mine,
    )


def _untold(now: Told, before: Told, after: Told) -> Told:
    """The same of a file."""
    fields = asdict(before)
    return replace(now, **{word: value for word, value in fields.items() if value != getattr(after, word)})


def _without(some: Iterable[str], others: Sequence[str]) -> list[str]:
    return [one for one in some if one not in others]


def _pattern(name: str) -> str:
    """A pattern of this name: no comma and no space at an end, which end words of the setting."""
    first, rest = name[:1], name[1:]
    return (f"[{first}]" if first.isalnum() else "?") + re.sub(r"[,\s]", "?", escape(rest))
