"""What the pages see of the collection: references listed, runs opened, sweeps applied."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from msgspec import convert

from shapewright.references.orientation import Orientation
from shapewright.references.standing import found_axes
from shapewright.runs.folder import EXPLANATION, RunError, read_json, read_record
from shapewright.runs.helpers import unchanged_beside
from shapewright.settings import Settings
from shapewright.storage import printable
from shapewright.studio.bench.messages import Drawn, Measured, Parted, SweepEnded, Swept, Unreadable
from shapewright.studio.project.listing import Listing, listing, version_of
from shapewright.studio.project.stores.picture_store import Pictures
from shapewright.studio.project.workspace import Project
from shapewright.studio.session.board import Board, lay_out
from shapewright.studio.session.pages import Pages
from shapewright.studio.session.standard import CUTS, Standard
from shapewright.studio.wire.changes import CollectionChanged, TilesChanged
from shapewright.studio.wire.collection import Axes, Stage
from shapewright.studio.wire.problems import Problem
from shapewright.studio.wire.values import Slug

_SETTLE = 0.04
"""Seconds for which changed tiles are gathered into one message."""


class Display:
    """What the pages see of the collection, and where it comes from.

    board: what they see; a change puts another in its place.
    listed: the references that there are.
    run: folder of the run that is shown; None before the first.
    pictures: all that the board names.
    swept: set while no sweep has still to show a replica.
    """

    def __init__(
        self, project: Project, pages: Pages, cache: Path | None, on_problems: Callable[[list[Problem]], object]
    ) -> None:
        """Show nothing yet.

        on_problems: called with the problems of all shapes whenever these change.
        """
        self._on_problems = on_problems
        self.project, self.pages, self.cache = project, pages, cache
        self.pictures = Pictures(project.folder, *([cache] if cache else []))
        self.board = Board()
        self.listed = Listing({}, {})
        self.run: Path | None = None
        self._chosen: Mapping[str, Any] | None = None
        self.swept = asyncio.Event()
        self._sweep = 0
        self._stage: Stage = "carried"
        self._sweep_version: str | None = None
        self._digest = ""
        self._left: set[Slug] = set()
        self._dirty: set[Slug] = set()
        self._reported: list[Problem] = []
        self._parts: dict[str, list[str]] = {}  # names of the objects in files, by version
        self._found: dict[Slug, Axes] = {}  # axes that the bench told of last
        self._unreadable: dict[str, tuple[str, str]] = {}
        self._left_out: frozenset[str] = frozenset()

    def relist(self) -> None:
        """Look for references again, to be shown by ``show``. Raises CollectionError when there are none."""
        self._unreadable.clear()
        self.listed = Listing({}, {})
        self.listed = listing(self.project.origin)
        for slug in self.listed.whole:
            if names := self._parts.get(version_of(self.listed.sources[slug]) or ""):
                self.listed = self.listed.parted(slug, names)

    def newest(self, of_version: bool = False) -> Path | None:
        """The newest run that knows some reference. of_version: of those that the procedure on disk made."""
        names = {source.name for source in self.listed.sources.values()}
        for folder in reversed(self.project.runs):
            try:
                record = read_record(folder)
            except RunError:
                continue
            known = names & {entry["name"] for entry in record["references"]}
            if known and (not of_version or self._is_of_version(folder, record)):
                return folder
        return None

    def of_version(self, digest: str, version: str | None) -> None:
        """The procedure on disk is another one: all that earlier ones made is stale.

        digest: of its text. version: see ``Authored.version``.
        """
        self._digest = digest
        if version != self.board.version:
            self._put_up(replace(self.board, version=version))

    def _is_of_version(self, run: Path, record: Mapping[str, Any]) -> bool:
        return record["procedure"]["digest"] == self._digest and unchanged_beside(run, self.project.procedure)

    @property
    def outdated(self) -> bool:
        """Whether another version made the run that is shown, whatever its replicas are by now."""
        try:
            return self.run is not None and not self._is_of_version(self.run, read_record(self.run))
        except RunError:
            return True

    def show(self, run: Path | None, standard: Standard) -> None:
        """Show a run, or references alone, to the pages. standard: of references without a run."""
        self.stop_sweep()
        self.run, version = run, self.board.version
        board = self.laid_out(run, standard, self._chosen).explained_by(self.explanation)
        self._put_up(replace(board, version=version))
        self._forget_pictures()
        self._report_problems()

    def judge_by(self, settings: Settings) -> None:
        """Take the judge and its cuts from settings from now on, and not from the run that is shown."""
        self._chosen = {name: getattr(settings, name) for name in CUTS}
        if self.run:
            self._put_up(self.board.judged_by(Standard.of_run(read_record(self.run), self._chosen)))
        else:
            self._put_up(self.board.judged_by(replace(self.board.standard, settings=settings)))

    def explain(self) -> None:
        """The run that is shown has an explanation now."""
        self._put_up(self.board.explained_by(self.explanation))

    @property
    def explanation(self) -> Mapping[str, Any]:
        """Of the run that is shown, as the run's folder has it; empty where there is none that can be read."""
        try:
            content: Any = read_json(self.run / EXPLANATION) if self.run else {}
        except (OSError, ValueError):
            return {}
        return content if isinstance(content, dict) else {}

    def laid_out(self, run: Path | None, standard: Standard, chosen: Mapping[str, Any] | None = None) -> Board:
        """The board of a run, which is not stale itself. Raises RunError.

        standard: of references without a run.
        chosen: cuts that the run is judged by in place of its own.
        """
        runs = self.project.runs
        before = runs[runs.index(run) - 1] if run in runs[1:] else None
        axes = self._axes(run)
        kept = {slug: self._kept(slug, axes.get(slug)) for slug in self.listed.sources}
        made_by = self._made_by(run) if run else None
        board = lay_out(self.listed, self.pictures, kept, run, before, standard, chosen, made_by, axes)
        board = replace(board, version=made_by)
        for slug, (path, reason) in self._unreadable.items():
            board = board.without(slug, path, reason)
        return board

    def recorded(self, run: Path | None) -> dict[Slug, dict[str, Any]]:
        """The axes that a run found, of those references whose author tells none."""
        try:
            found = found_axes(read_record(run)["collection"]) if run else {}
        except RunError:
            return {}
        names = {slug: self.listed.sources[slug].name for slug in self.listed.free}
        return {slug: dict(found[name]) for slug, name in names.items() if name in found}

    def _axes(self, run: Path | None) -> dict[Slug, Axes]:
        """What is known of the axes of references beside a run, where these are to be found."""
        recorded = {slug: convert(each, Axes) for slug, each in self.recorded(run).items()}
        found = {slug: axes for slug, axes in {**self._found, **recorded}.items() if slug in self.listed.free}
        return found | {slug: Axes.of(one, "author") for slug, one in self.listed.told.items()}

    @property
    def missing(self) -> list[Slug]:
        """Slugs of the references of which no picture is kept; that of a run may be older than the author's word."""
        axes = self._axes(self.run)
        states = self.board.references.items()
        return [slug for slug, one in states if one.reference is None or self._kept(slug, axes.get(slug)) is None]

    def _made_by(self, run: Path) -> str | None:
        """The version that made a run."""
        record = read_record(run)
        return self.board.version if self._is_of_version(run, record) else f"run of {record['procedure']['digest']}"

    def leave_out(self, names: frozenset[str]) -> None:
        """These references do not count from now on, and all others do."""
        self._left_out, before = names, self._left_out
        if names != before:
            self._put_up(self.board)

    def _put_up(self, board: Board) -> None:
        board = self.board = replace(board, left_out=self._left_out)
        self.pages.publish(CollectionChanged(collection=board.collection()))

    def begin_sweep(self, stage: Stage, slugs: list[Slug]) -> int:
        """The number of a sweep that is about to begin; what earlier ones still send is passed over."""
        self._forget_pictures()
        self._sweep += 1
        self._stage, self._sweep_version = stage, self.board.version
        self._left = set(slugs)
        self.swept.clear()
        return self._sweep

    def stop_sweep(self) -> None:
        self._sweep += 1
        self.swept.set()

    def take(self, message: Drawn | Parted | Unreadable | Swept | Measured | SweepEnded, payload: bytes) -> None:
        """Apply what the bench says of references and replicas."""
        if isinstance(message, Swept | Measured | SweepEnded) and message.sweep != self._sweep:
            return
        match message:
            case Drawn():
                if message.axes:
                    self._found[message.slug] = message.axes
                self._change(message.slug, reference=self.pictures.add(payload), axes=message.axes)
            case Unreadable() if message.slug in self.board.references:
                path = printable(self.listed.sources[message.slug].place)
                self._unreadable[message.slug] = path, message.reason
                self._put_up(self.board.without(message.slug, path, message.reason))
            case Parted() if message.slug in self.listed.sources:
                self._split(message.slug, message.names)
            case SweepEnded():
                self._left.clear()
            case Measured():
                self._change(message.slug, fidelity=message.fidelity, distance=message.distance)
            case Swept():
                self._take_replica(message, payload)
                self._left.discard(message.slug)
        if not self._left:
            self.swept.set()

    def _split(self, slug: Slug, names: list[str]) -> None:
        """Show the objects in a file in its place; the others stay as they are."""
        if version := version_of(self.listed.sources[slug]):
            self._parts[version] = names
        self.listed = self.listed.parted(slug, names)
        self.run = self.run or self.newest()
        board = self.laid_out(self.run, self.board.standard, self._chosen).explained_by(self.explanation)
        kept = {one: self.board.references.get(one) or state for one, state in board.references.items()}
        self._put_up(replace(board, references=kept))

    def _take_replica(self, message: Swept, payload: bytes) -> None:
        if message.problem:
            problem = message.problem.of(message.slug)
            self._change(message.slug, problem=problem, fidelity=None, distance=None)
            return
        self._change(
            message.slug,
            parameters=message.parameters,
            active=message.active,
            at_limit=message.at_limit,
            longer=[],
            replica=self.pictures.add(payload),
            fidelity=None,
            distance=None,
            measures={},
            missing=[],
            surplus=[],
            stage=self._stage,
            made_by=self._sweep_version,
            problem=None,
        )

    def _change(self, slug: Slug, **changes: Any) -> None:
        if slug not in self.board.references:
            return
        self.board = self.board.with_reference(slug, **changes)
        if not self._dirty:
            asyncio.get_running_loop().call_later(_SETTLE, self._flush)
        self._dirty.add(slug)

    def _flush(self) -> None:
        board = self.board
        states = [board.references[slug] for slug in sorted(self._dirty) if slug in board.references]
        self._dirty.clear()
        self.pages.publish(TilesChanged(tiles=[state.tile(board.standard, board.version) for state in states]))
        self._report_problems()

    def _report_problems(self) -> None:
        problems = self.board.problems()
        if problems != self._reported:
            self._reported = problems
            self._on_problems(problems)

    def _kept(self, slug: Slug, axes: Axes | None) -> str | None:
        """None where it is not known how the reference stands."""
        if self.cache is None or (axes is None and slug in self.listed.free):
            return None
        found = Orientation(axes.up, axes.front) if axes and slug in self.listed.free else None
        path = self.listed.kept_picture(self.cache, slug, found)
        return self.pictures.add_file(path) if path else None

    def _forget_pictures(self) -> None:
        states = self.board.references.values()
        shown = (address for state in states for address in (state.reference, state.replica))
        self.pictures.keep({address for address in shown if address})
