"""The collection as it is shown: the state of every reference, and groups of the misfits."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import convert, structs

from shapewright.building.outcomes import Failure
from shapewright.judging.verdict import Grade
from shapewright.parameters import Parameters
from shapewright.runs.folder import read_record
from shapewright.runs.result import MEASURES, grade_in
from shapewright.settings import Settings
from shapewright.storage import printable
from shapewright.studio.project.listing import Listing
from shapewright.studio.project.stores.picture_store import Pictures
from shapewright.studio.session.standard import Standard
from shapewright.studio.wire.collection import Axes, Collection, Group, Skipped, Stage, Tile
from shapewright.studio.wire.judgement import Counts, Measures, Piece, Pose
from shapewright.studio.wire.problems import Problem, together
from shapewright.studio.wire.values import Address, Slug, message_of

if TYPE_CHECKING:
    from shapewright.feedback.case import CauseKind

Record = Mapping[str, Any]
_POSE: CauseKind = "another pose"
_TOO_SHORT: CauseKind = "out of range"
_POSED = ("turned", "on_its_head", "mirrored")
_RECORDED = ("distance", "compatible", "group", "parameters", "active", "at_limit")
"""What the state of a reference takes from its entry in a run's record as it is."""


@dataclass(frozen=True)
class ReferenceState:
    """One reference, and what is known of it; see ``wire.collection.Tile`` for the other fields."""

    slug: Slug
    name: str
    reference: Address | None = None
    replica: Address | None = None
    fidelity: float | None = None
    distance: float | None = None
    grade: Grade = "different"
    compatible: bool = False
    measures: Measures = field(default_factory=dict)
    missing: list[Piece] = field(default_factory=list)
    surplus: list[Piece] = field(default_factory=list)
    pose: Pose | None = None
    axes: Axes | None = None
    group: int | None = None
    stage: Stage = "none"
    made_by: str | None = None  # version of the procedure that made the replica
    previous: float | None = None
    parameters: Parameters | None = None  # of the replica that is shown
    active: list[str] = field(default_factory=list)  # names of those that matter
    at_limit: list[str] = field(default_factory=list)
    longer: list[str] = field(default_factory=list)
    problem: Problem | None = None

    def colour(self, standard: Standard) -> str | None:
        return standard.colour(self.grade, self.fidelity, self.distance)

    def stale(self, version: str | None) -> bool:
        """Whether there is a replica that another version made than this one."""
        return self.replica is not None and (version is None or self.made_by != version)

    def tile(self, standard: Standard, version: str | None) -> Tile:
        """As the page gets it. version: of the procedure on disk."""
        return message_of(Tile, self, colour=self.colour(standard), stale=self.stale(version))


@dataclass(frozen=True)
class Board:
    """The collection as it is shown; a change makes another board."""

    references: Mapping[Slug, ReferenceState] = field(default_factory=dict)  # by slug, in the order of the listing
    groups: tuple[Group, ...] = ()  # of the misfits
    run: str | None = None  # name of the run that is shown
    standard: Standard = field(default_factory=lambda: Standard.of(Settings(), 3))
    skipped: Mapping[str, str] = field(default_factory=dict)  # files that cannot be read, and why
    version: str | None = None  # of the procedure on disk; None for one that cannot be used
    left_out: frozenset[str] = frozenset()  # names of the references that do not count

    @property
    def stale(self) -> bool:
        """Whether a replica is of another version."""
        return any(state.stale(self.version) for state in self.references.values())

    @property
    def parameters(self) -> dict[Slug, Parameters]:
        """Those of all replicas that are known."""
        states = self.references.items()
        return {slug: state.parameters for slug, state in states if state.parameters is not None}

    @property
    def slugs(self) -> dict[str, Slug]:
        """By name."""
        return {state.name: slug for slug, state in self.references.items()}

    def collection(self) -> Collection:
        """As the page gets it."""
        tiles = [state.tile(self.standard, self.version) for state in self.references.values()]
        settings, metric = self.standard.settings, self.standard.metric
        counting = [tile for tile in tiles if tile.name not in self.left_out]
        return Collection(
            run=self.run,
            judge=settings.judge,
            replicated=settings.replicated,
            close=settings.close,
            threshold=metric.threshold,
            measure=metric.name,
            criterion=metric.criterion,
            count=len(counting),
            counts=counted((tile.grade, tile.compatible) for tile in counting),
            left_out=[tile.slug for tile in tiles if tile.name in self.left_out],
            tiles=tiles,
            groups=list(self.groups),
            skipped=[Skipped(path=path, reason=reason) for path, reason in self.skipped.items()],
        )

    def with_reference(self, slug: Slug, **changes: Any) -> Board:
        """With a reference changed; its grade follows what was measured, fidelity and distance together."""
        if "distance" in changes:
            changes |= self.standard.judged(changes["fidelity"], changes["distance"])
        changed = replace(self.references[slug], **changes)
        return replace(self, references={**self.references, slug: changed})

    def judged_by(self, standard: Standard) -> Board:
        """With other cuts, or another judge, and so with other grades."""
        states = self.references.items()
        graded = {slug: replace(one, grade=standard.grade(one.fidelity, one.compatible)) for slug, one in states}
        return replace(self, references=graded, standard=standard)

    def explained_by(self, explanation: Record) -> Board:
        """With what an explanation finds of how the references stand, and of Ranges that end too soon."""
        poses, longer = _poses(explanation), _longer_ranges(explanation)
        told = {
            slug: replace(one, pose=poses.get(one.name), longer=longer.get(one.name, []))
            for slug, one in self.references.items()
        }
        return replace(self, references=told)

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
    standard: Standard,
    chosen: Mapping[str, Any] | None = None,
    made_by: str | None = None,
    axes: Mapping[str, Axes] | None = None,
) -> Board:
    """The board of a listing, as far as a run knows its references. Raises RunError.

    kept: addresses of the references' pictures, None where there is none yet.
    run: its folder.
    previous: the folder of the run before.
    standard: of a board without a run.
    chosen: cuts that the run is judged by in place of its own.
    made_by: the version of the procedure that made the run's replicas.
    axes: of those references of which they are known, where they are to be found.
    """
    record = read_record(run) if run else None
    stand = axes or {}
    if record:
        standard = Standard.of_run(record, chosen)
    earlier = read_record(previous)["references"] if previous else []
    before = {entry["name"]: standard.value(entry) for entry in earlier}
    references = {
        slug: ReferenceState(
            slug, source.name, reference=kept.get(slug), previous=before.get(source.name), axes=stand.get(slug)
        )
        for slug, source in listed.sources.items()
    }
    skipped = {printable(path): printable(reason) for path, reason in listed.skipped.items()}
    known = [printable(source.place) for source in listed.sources.values()]
    if run is None or record is None:
        return Board(references, standard=standard, skipped=skipped)
    slugs = {state.name: slug for slug, state in references.items()}
    for entry in record["references"]:
        if entry["name"] in slugs:
            slug = slugs[entry["name"]]
            references[slug] = replace(_filled(references[slug], entry, pictures, run), made_by=made_by)
            if listed.sources[slug].by_author:  # who may have said it since
                references[slug] = replace(references[slug], reference=kept.get(slug))
    groups = tuple(_groups(record["groups"], slugs))
    of_run = _still_there(record["collection"]["skipped"], (*known, *skipped))
    board = Board(references, groups, run.name, standard, {**of_run, **skipped})
    return board.judged_by(standard) if chosen else board


def _still_there(skipped: Mapping[str, str], paths: Iterable[str]) -> dict[str, str]:
    """What a run could not read, by the path that the file has now.

    skipped: by the path that it had for the run: relative to another folder perhaps, or on another machine. paths: of
    all files that there are.
    """
    by_name: dict[str, list[str]] = {}
    for path in paths:
        by_name.setdefault(Path(path).name, []).append(path)

    def shared(path: str, old: str) -> int:
        pairs = zip(reversed(Path(path).parts), reversed(Path(old).parts), strict=False)
        return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))

    return {
        max(by_name[Path(old).name], key=partial(shared, old=old)): reason
        for old, reason in skipped.items()
        if Path(old).name in by_name
    }


def counted(grades: Iterable[tuple[Grade, bool]]) -> Counts:
    """How many there are of each. grades: of references, with whether they are compatible."""
    pairs = list(grades)
    found = Counter(grade for grade, _ in pairs)
    return Counts(
        replicated=found["replicated"],
        close=found["close"],
        different=found["different"],
        compatible=sum(compatible for _, compatible in pairs),
    )


def _filled(state: ReferenceState, entry: Record, pictures: Pictures, folder: Path) -> ReferenceState:
    address = {side: folder / "thumbnails" / f"{entry['slug']}.{side}.png" for side in ("reference", "replica")}
    return replace(
        state,
        reference=state.reference or pictures.add_file(address["reference"]),
        replica=pictures.add_file(address["replica"]),
        stage="trained",
        problem=_problem(entry["error"], state.slug) if entry["error"] else None,
        fidelity=entry.get("fidelity"),
        grade=grade_in(entry),
        measures={name: entry.get(name) for name in MEASURES},
        missing=convert(entry.get("missing", []), list[Piece]),
        surplus=convert(entry.get("surplus", []), list[Piece]),
        **{field: entry[field] for field in _RECORDED},
    )


def _poses(explanation: Record) -> dict[str, Pose]:
    """By name of the reference, of those that stand another way than their replicas."""
    told = {}
    for name, found in explanation.get("references", {}).items():
        evidence = next((cause["evidence"] for cause in found.get("causes", ()) if cause["kind"] == _POSE), None)
        if evidence:
            told[name] = Pose(text=evidence["words"], **{key: evidence[key] for key in _POSED})
    return told


def _longer_ranges(explanation: Record) -> dict[str, list[str]]:
    """By name of the reference, parameters whose longer Range would bring something."""
    told = {}
    for name, found in explanation.get("references", {}).items():
        causes = [cause["evidence"] for cause in found.get("causes", ()) if cause["kind"] == _TOO_SHORT]
        if causes:
            told[name] = [wish["parameter"] for cause in causes for wish in cause.get("wishes", ())]
    return told


def _problem(error: str, slug: Slug) -> Problem:
    failure = Failure.parse(error)
    return Problem(failure.kind, failure.message).of(slug)


def _groups(groups: Sequence[Record], slugs: Mapping[str, Slug]) -> Iterable[Group]:
    """Groups by slug; an index into them stays what it was, so a group that lost all its members stays too."""
    for group in groups:
        members = [slugs[name] for name in group["members"] if name in slugs]
        chosen = slugs.get(group["representative"], members[0] if members else None)
        yield Group(representative=chosen, members=members)
