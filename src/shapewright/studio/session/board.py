"""The collection as it is shown: the state of every reference, and groups of the misfits."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from msgspec import structs

from shapewright.building.outcomes import Failure
from shapewright.judging.paper import Metric, light_field_metric
from shapewright.parameters import Parameters
from shapewright.report.scale import colour
from shapewright.runs.folder import read_record
from shapewright.settings import Settings
from shapewright.studio.project.listing import Listing
from shapewright.studio.project.picture_store import Pictures
from shapewright.studio.wire.collection import Collection, Group, Skipped, Stage, Tile
from shapewright.studio.wire.problems import Problem, together
from shapewright.studio.wire.values import Address, Slug, message_of

Record = Mapping[str, Any]
_RECORDED = ("distance", "iou", "chamfer", "compatible", "group", "parameters", "active", "at_limit")
"""What the state of a reference takes from its entry in a run's record."""


@dataclass(frozen=True)
class ReferenceState:
    """One reference, and what is known of it; see ``wire.collection.Tile`` for the other fields."""

    slug: Slug
    name: str
    reference: Address | None = None
    replica: Address | None = None
    distance: float | None = None
    iou: float | None = None  # of the silhouettes
    chamfer: float | None = None  # distance of the surfaces or outlines
    compatible: bool = False
    group: int | None = None
    stage: Stage = "none"
    stale: bool = False
    previous: float | None = None
    parameters: Parameters | None = None  # of the replica that is shown
    active: list[str] = field(default_factory=list)  # names of those that matter
    at_limit: list[str] = field(default_factory=list)
    problem: Problem | None = None

    def tile(self, metric: Metric) -> Tile:
        """As the page gets it."""
        return message_of(Tile, self, colour=tint(self.distance, metric))


@dataclass(frozen=True)
class Board:
    """The collection as it is shown; a change makes another board."""

    references: Mapping[Slug, ReferenceState] = field(default_factory=dict)  # by slug, in the order of the listing
    groups: tuple[Group, ...] = ()  # of the misfits
    run: str | None = None  # name of the run that is shown
    metric: Metric = field(default_factory=lambda: light_field_metric(Settings.threshold))
    skipped: Mapping[str, str] = field(default_factory=dict)  # files that cannot be read, and why

    def collection(self) -> Collection:
        """As the page gets it."""
        tiles = [state.tile(self.metric) for state in self.references.values()]
        return Collection(
            run=self.run,
            threshold=self.metric.threshold,
            measure=self.metric.name,
            criterion=self.metric.criterion,
            count=len(tiles),
            compatible=sum(tile.compatible for tile in tiles),
            tiles=tiles,
            groups=list(self.groups),
            skipped=[Skipped(path=path, reason=reason) for path, reason in self.skipped.items()],
        )

    def with_reference(self, slug: Slug, **changes: Any) -> Board:
        """With a reference changed; compatible follows the distance."""
        if "distance" in changes:
            changes["compatible"] = self.metric.accepts(changes["distance"])
        changed = replace(self.references[slug], **changes)
        return replace(self, references={**self.references, slug: changed})

    def with_all(self, **changes: Any) -> Board:
        """With every reference changed."""
        changed = {slug: replace(state, **changes) for slug, state in self.references.items()}
        return replace(self, references=changed)

    def without(self, slug: Slug, path: str, reason: str) -> Board:
        """Without a reference that cannot be read."""
        others = {other: state for other, state in self.references.items() if other != slug}
        return replace(self, references=others, skipped={**self.skipped, path: reason})

    def problems(self) -> list[Problem]:
        """Of shapes that could not be built, alike ones together."""
        return together(
            structs.replace(state.problem.of(slug), parameters=state.problem.parameters or state.parameters)
            for slug, state in self.references.items()
            if state.problem
        )


def lay_out(
    listed: Listing,
    pictures: Pictures,
    kept: Mapping[str, str | None],
    run: Path | None,
    previous: Path | None,
    metric: Metric,
) -> Board:
    """The board of a listing, as far as a run knows its references. Raises RunError.

    kept: addresses of the references' pictures, None where there is none yet.
    run: its folder.
    previous: the folder of the run before.
    metric: of a board without a run.
    """
    earlier = read_record(previous)["references"] if previous else []
    before = {entry["name"]: entry["distance"] for entry in earlier}
    references = {
        slug: ReferenceState(slug, source.name, reference=kept.get(slug), previous=before.get(source.name))
        for slug, source in listed.sources.items()
    }
    skipped = {str(path): reason for path, reason in listed.skipped.items()}
    if run is None:
        return Board(references, metric=metric, skipped=skipped)
    record = read_record(run)
    slugs = {state.name: slug for slug, state in references.items()}
    for entry in record["references"]:
        if entry["name"] in slugs:
            slug = slugs[entry["name"]]
            references[slug] = _filled(references[slug], entry, pictures, run)
    groups = tuple(_groups(record["groups"], slugs))
    return Board(references, groups, run.name, Metric.of_record(record), skipped | record["collection"]["skipped"])


def tint(distance: float | None, metric: Metric) -> str | None:
    """The colour of a distance, None for none."""
    return None if distance is None else colour(distance, metric.threshold, metric.far / metric.threshold)


def _filled(state: ReferenceState, entry: Record, pictures: Pictures, folder: Path) -> ReferenceState:
    address = {side: folder / "thumbnails" / f"{entry['slug']}.{side}.png" for side in ("reference", "replica")}
    return replace(
        state,
        reference=state.reference or pictures.add_file(address["reference"]),
        replica=pictures.add_file(address["replica"]),
        stage="trained",
        problem=_problem(entry["error"], state.slug) if entry["error"] else None,
        **{field: entry[field] for field in _RECORDED},
    )


def _problem(error: str, slug: Slug) -> Problem:
    failure = Failure.parse(error)
    return Problem(failure.kind, failure.message).of(slug)


def _groups(groups: Sequence[Record], slugs: Mapping[str, Slug]) -> Iterable[Group]:
    """Groups by slug; an index into them stays what it was, so a group that lost all its members stays too."""
    for group in groups:
        members = [slugs[name] for name in group["members"] if name in slugs]
        chosen = slugs.get(group["representative"], members[0] if members else None)
        yield Group(representative=chosen, members=members)
