"""What the page shows of the collection: a tile for every reference, and groups of the misfits."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

from shapewright.building.outcomes import Failure
from shapewright.judging.paper import Metric, light_field_metric
from shapewright.parameters import Parameters
from shapewright.report.page import colour
from shapewright.settings import Settings
from shapewright.studio.project.listing import Listing
from shapewright.studio.project.picture_store import Pictures
from shapewright.studio.wire.problems import Problem, together

Stage = Literal["none", "carried", "early", "predicted", "trained"]
Record = Mapping[str, Any]


@dataclass(frozen=True)
class Tile:
    """One reference and what was found for it; see PROTOCOL.md. parameters, active: of the replica shown."""

    slug: str
    name: str
    reference: str | None = None
    replica: str | None = None
    distance: float | None = None
    iou: float | None = None
    chamfer: float | None = None
    compatible: bool = False
    group: int | None = None
    stage: Stage = "none"
    stale: bool = False
    previous: float | None = None
    parameters: Parameters | None = None
    active: tuple[str, ...] = ()
    at_limit: tuple[str, ...] = ()
    problem: Problem | None = None

    def record(self, metric: Metric) -> dict[str, Any]:
        """As the page gets it."""
        shown = (
            "slug",
            "name",
            "reference",
            "replica",
            "distance",
            "compatible",
            "group",
            "stage",
            "stale",
            "previous",
        )
        return {
            **{name: getattr(self, name) for name in shown},
            "colour": tint(self.distance, metric),
            "at_limit": list(self.at_limit),
            "problem": self.problem.record() if self.problem else None,
        }


@dataclass(frozen=True)
class Board:
    """All tiles by slug, in the order of the listing. run: name of the run they are from. skipped: path to reason."""

    tiles: dict[str, Tile] = field(default_factory=dict)
    groups: tuple[Record, ...] = ()
    run: str | None = None
    metric: Metric = field(default_factory=lambda: light_field_metric(Settings.threshold))
    skipped: Mapping[str, str] = field(default_factory=dict)

    def record(self) -> dict[str, Any]:
        """The page's ``Collection``."""
        return {
            "run": self.run,
            "threshold": self.metric.threshold,
            "measure": self.metric.name,
            "criterion": self.metric.criterion,
            "count": len(self.tiles),
            "compatible": sum(tile.compatible for tile in self.tiles.values()),
            "tiles": [tile.record(self.metric) for tile in self.tiles.values()],
            "groups": list(self.groups),
            "skipped": [{"path": path, "reason": reason} for path, reason in self.skipped.items()],
        }

    def with_tile(self, slug: str, **changes: Any) -> Board:
        """A tile changed; compatible follows the distance."""
        if "distance" in changes:
            distance = changes["distance"]
            changes["compatible"] = distance is not None and distance <= self.metric.threshold
        self.tiles[slug] = replace(self.tiles[slug], **changes)
        return self

    def with_all(self, **changes: Any) -> Board:
        """Every tile changed."""
        return replace(self, tiles={slug: replace(tile, **changes) for slug, tile in self.tiles.items()})

    def without(self, slug: str, path: str, reason: str) -> Board:
        """Without a reference that cannot be read."""
        tiles = {each: tile for each, tile in self.tiles.items() if each != slug}
        return replace(self, tiles=tiles, skipped={**self.skipped, path: reason})

    def problems(self) -> list[Problem]:
        """Of shapes that could not be built, alike ones together."""
        return together(
            replace(tile.problem, slugs=(tile.slug,), parameters=tile.problem.parameters or tile.parameters)
            for tile in self.tiles.values()
            if tile.problem
        )


def lay_out(
    listed: Listing,
    pictures: Pictures,
    kept: Mapping[str, str | None],
    record: Record | None = None,
    folder: Path | None = None,
    previous: Record | None = None,
    metric: Metric | None = None,
) -> Board:
    """The board of a listing, as far as a run knows its references.

    kept: addresses of the references' pictures, None where there is none yet. record, folder: of the run. previous:
    record of the run before. metric: of a board without a run.
    """
    known = {entry["name"]: entry for entry in record["references"]} if record else {}
    before = {entry["name"]: entry["distance"] for entry in previous["references"]} if previous else {}
    tiles = {}
    for slug, source in listed.sources.items():
        tile = Tile(slug, source.name, reference=kept.get(slug), previous=before.get(source.name))
        entry = known.get(source.name)
        tiles[slug] = _filled(tile, entry, pictures, folder) if entry and folder else tile
    slugs = {tile.name: slug for slug, tile in tiles.items()}
    skipped = {_shown(path): reason for path, reason in listed.skipped.items()}
    skipped |= record["collection"]["skipped"] if record else {}
    return Board(
        tiles,
        tuple(_groups(record["groups"], slugs)) if record else (),
        folder.name if folder else None,
        Metric.of_record(record) if record else metric or light_field_metric(Settings.threshold),
        skipped,
    )


def tint(distance: float | None, metric: Metric) -> str | None:
    """The colour of a distance, None for none."""
    return None if distance is None else colour(distance, metric.threshold, metric.far / metric.threshold)


def _filled(tile: Tile, entry: Record, pictures: Pictures, folder: Path) -> Tile:
    address = {side: folder / "thumbnails" / f"{entry['slug']}.{side}.png" for side in ("reference", "replica")}
    return replace(
        tile,
        reference=tile.reference or pictures.add_file(address["reference"]),
        replica=pictures.add_file(address["replica"]),
        distance=entry["distance"],
        iou=entry["iou"],
        chamfer=entry["chamfer"],
        compatible=entry["compatible"],
        group=entry["group"],
        stage="trained",
        parameters=entry["parameters"],
        active=tuple(entry["active"]),
        at_limit=tuple(entry["at_limit"]),
        problem=_problem(entry["error"], tile.slug) if entry["error"] else None,
    )


def _problem(error: str, slug: str) -> Problem:
    failure = Failure.parse(error)
    return Problem(failure.kind, failure.message, slugs=(slug,))


def _groups(groups: Sequence[Record], slugs: Mapping[str, str]) -> Iterable[Record]:
    """Groups by slug; an index into them stays what it was, so a group that lost all its members stays too."""
    for group in groups:
        members = [slugs[name] for name in group["members"] if name in slugs]
        yield {
            "representative": slugs.get(group["representative"], members[0] if members else None),
            "members": members,
        }


def _shown(path: Path) -> str:
    return str(path)
