"""The board, kept up to date: references listed, runs opened, sweeps applied, pages told what changed."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from shapewright.judging.paper import Metric
from shapewright.parameters import Parameters
from shapewright.runs.folder import RunError, read_record
from shapewright.studio.project.listing import Listing, kept_picture, listing
from shapewright.studio.project.picture_store import Pictures
from shapewright.studio.project.workspace import Project
from shapewright.studio.session.board import Board, Stage, lay_out
from shapewright.studio.session.pages import Pages
from shapewright.studio.wire.problems import Problem

_SETTLE = 0.04
"""Seconds for which changed tiles are gathered into one message."""


class Showing:
    """board: what the pages see. listed: the references there are. run: folder of the run shown, None before any.

    swept: set while no sweep is under way that has still to show a replica. on_problems: called with the problems of
    all shapes whenever these change.
    """

    def __init__(
        self, project: Project, pages: Pages, cache: Path | None, on_problems: Callable[[list[Problem]], object]
    ) -> None:
        self._on_problems = on_problems
        self.project, self.pages, self.cache = project, pages, cache
        self.pictures = Pictures(project.folder, *([cache] if cache else []))
        self.board = Board()
        self.listed = Listing({}, {})
        self.run: Path | None = None
        self.swept = asyncio.Event()
        self._sweep = 0
        self._stage: Stage = "carried"
        self._left: set[str] = set()
        self._dirty: set[str] = set()
        self._told: list[Problem] = []
        self._unreadable: dict[str, tuple[str, str]] = {}

    def relist(self) -> None:
        """Look for references anew, to be shown by ``show``. Raises CollectionError when there are none."""
        self._unreadable.clear()
        self.listed = Listing({}, {})
        self.listed = listing(self.project.origin)

    def newest(self, digest: str | None = None) -> Path | None:
        """The newest run that knows some reference, of the version with this digest if one is given."""
        names = {source.name for source in self.listed.sources.values()}
        for folder in reversed(self.project.runs):
            try:
                record = read_record(folder)
            except RunError:
                continue
            of_version = digest is None or record["procedure"]["digest"] == digest
            if of_version and names & {entry["name"] for entry in record["references"]}:
                return folder
        return None

    def show(self, run: Path | None, metric: Metric) -> None:
        """Put up a run, or bare references, and tell the pages."""
        self.stop_sweep()
        self.run = run
        self.board = self.laid_out(run, metric)
        self._forget_pictures()
        self.pages.publish("collection", collection=self.board.record())
        self._tell_problems()

    def laid_out(self, run: Path | None, metric: Metric) -> Board:
        """The board that ``show`` puts up, without putting it up. Raises RunError."""
        runs = self.project.runs
        before = runs[runs.index(run) - 1] if run in runs[1:] else None
        board = lay_out(
            self.listed,
            self.pictures,
            {slug: self._kept(slug) for slug in self.listed.sources},
            read_record(run) if run else None,
            run,
            read_record(before) if before else None,
            metric,
        )
        for slug, (path, reason) in self._unreadable.items():
            board = board.without(slug, path, reason)
        return board

    @property
    def missing(self) -> list[str]:
        """Slugs of the references whose picture is not known yet."""
        return [slug for slug, tile in self.board.tiles.items() if tile.reference is None]

    @property
    def found(self) -> dict[str, Parameters]:
        """Parameters by slug, as far as there are any."""
        return {slug: tile.parameters for slug, tile in self.board.tiles.items() if tile.parameters is not None}

    def slugs(self) -> dict[str, str]:
        """By name."""
        return {tile.name: slug for slug, tile in self.board.tiles.items()}

    def drawn(self, slug: str, png: bytes) -> None:
        """Take up the picture of a reference."""
        self._change(slug, reference=self.pictures.add(png))

    def unreadable(self, slug: str, reason: str) -> None:
        """Leave a reference out that cannot be read."""
        if slug in self.board.tiles:
            path = str(self.listed.sources[slug].path)
            self._unreadable[slug] = path, reason
            self.board = self.board.without(slug, path, reason)
            self.pages.publish("collection", collection=self.board.record())

    def stale(self) -> None:
        """Everything shown is of an older version."""
        self.board = self.board.with_all(stale=True)
        self.pages.publish("collection", collection=self.board.record())

    def begin_sweep(self, stage: Stage, slugs: list[str]) -> int:
        """The number of a sweep that is about to begin; what earlier ones still tell is passed over."""
        self._forget_pictures()
        self._sweep += 1
        self._stage = stage
        self._left = set(slugs)
        self.swept.clear()
        return self._sweep

    def stop_sweep(self) -> None:
        self._sweep += 1
        self.swept.set()

    def take(self, message: Mapping[str, Any], payload: bytes) -> None:
        """Apply what the bench tells of a sweep."""
        if message["sweep"] != self._sweep:
            return
        if message["type"] == "swept all":
            self._left.clear()
        elif message["slug"] in self.board.tiles and message["type"] == "measured":
            self._change(message["slug"], distance=message["distance"])
        elif message["slug"] in self.board.tiles:
            self._take_built(message, payload)
            self._left.discard(message["slug"])
        if not self._left:
            self.swept.set()

    def _take_built(self, message: Mapping[str, Any], payload: bytes) -> None:
        slug = message["slug"]
        if message["problem"]:
            found = replace(Problem.from_record(message["problem"]), slugs=(slug,))
            self._change(slug, problem=found, stale=True, distance=None)
            return
        changes = {name: message[name] for name in ("parameters", "active", "at_limit")}
        replica = self.pictures.add(payload)
        self._change(slug, **changes, replica=replica, distance=None, stage=self._stage, stale=False, problem=None)

    def _change(self, slug: str, **changes: Any) -> None:
        if slug not in self.board.tiles:
            return
        self.board.with_tile(slug, **changes)
        if not self._dirty:
            asyncio.get_running_loop().call_later(_SETTLE, self._flush)
        self._dirty.add(slug)

    def _flush(self) -> None:
        tiles = [self.board.tiles[slug] for slug in sorted(self._dirty) if slug in self.board.tiles]
        self._dirty.clear()
        self.pages.publish("tiles", tiles=[tile.record(self.board.metric) for tile in tiles])
        self._tell_problems()

    def _tell_problems(self) -> None:
        found = self.board.problems()
        if found != self._told:
            self._told = found
            self._on_problems(found)

    def _kept(self, slug: str) -> str | None:
        path = kept_picture(self.cache, self.listed.sources[slug]) if self.cache else None
        return self.pictures.add_file(path) if path else None

    def _forget_pictures(self) -> None:
        shown = (address for tile in self.board.tiles.values() for address in (tile.reference, tile.replica))
        self.pictures.keep({address for address in shown if address})
