"""The results of one turn of the loop; it is written to disk and read back."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any

from shapewright.comparison.grouping import Group
from shapewright.judging.paper import Metric
from shapewright.judging.target import mean
from shapewright.judging.verdict import Grade
from shapewright.prediction.predictor import Predictor
from shapewright.runs import table
from shapewright.runs.folder import FORMAT, LARGE_FORMAT, RECORD, new_folder, read_record
from shapewright.runs.helpers import read_helpers, text_in, write_source
from shapewright.runs.lazy import Lazy, later
from shapewright.runs.marks import worth_marking
from shapewright.runs.packed import packing
from shapewright.runs.pictures import KeptPictures, Pictures, draw_pictures, pictures_of
from shapewright.runs.result import MEASURES, Result, from_record, read_replica, replica_path, to_record
from shapewright.settings import Settings
from shapewright.shapes.files import encode
from shapewright.storage import cell, file_names

_AS_RECORDED = ("seconds", "procedure", "collection", "metrics", "versions", "created")
_AFTER = ("groups", "worth_marking", "metrics", "seconds")
"""Entries of a record that come after the references."""
_AS_BEFORE = {"drop": "nothing", "duplicates": "each"}
"""Settings of runs of versions that did not have them."""


@dataclass(frozen=True, eq=False)
class Iteration:
    """The results of one turn of the loop: ``it["name"]``, ``it.replicated``, ``it.groups``, ``it.seconds``.

    Attributes:
        results: one of each reference, in the order of the collection. Of a large run that was loaded each is read
            when it is asked for.
        metric: the paper's measure, which decides which references are compatible.
        groups: references that are not replicated and look alike.
        settings: what the iteration was run with.
        seconds: wall time by stage.
        procedure: its name, path, digest and parameters, as the record has them.
        source: text of the procedure.
        helpers: contents of the files that it uses from its own folder, by their path in it.
        collection: where the references come from, as the record has it.
        metrics: what training and validation measured, as the record has it.
        versions: of Python and of the libraries that results depend on.
        created: date and time in ISO 8601, UTC.
        pictures: thumbnails (PNG) of reference and replica by name; drawn when the run is saved if there are none.
        predictor: the trained network, None where it was not kept.
    """

    results: Sequence[Result]
    metric: Metric
    groups: tuple[Group, ...]
    settings: Settings
    seconds: Mapping[str, float]
    procedure: Mapping[str, Any]
    source: str
    collection: Mapping[str, Any]
    metrics: Mapping[str, Any]
    versions: Mapping[str, str]
    created: str
    pictures: Pictures = field(default_factory=dict, repr=False)
    predictor: Predictor | None = field(default=None, repr=False)
    helpers: Mapping[str, bytes] = field(default_factory=dict, repr=False)

    @cached_property
    def _places(self) -> dict[str, int]:
        return {result.name: place for place, result in enumerate(self.results)}

    def __getitem__(self, name: str) -> Result:
        if name not in self._places:
            raise KeyError(f"no reference {name!r} in this iteration")
        return self.results[self._places[name]]

    def __iter__(self) -> Iterator[Result]:
        return iter(self.results)

    def __len__(self) -> int:
        return len(self.results)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self._places)

    @property
    def replicated(self) -> tuple[str, ...]:
        """Names of the references that the procedure replicates, by the judge of the settings."""
        return self._of_grade("replicated")

    @property
    def close(self) -> tuple[str, ...]:
        """Names of the references that their replicas resemble, but are not the same as."""
        return self._of_grade("close")

    @property
    def different(self) -> tuple[str, ...]:
        """Names of the references that have no replica, or one that is something else."""
        return self._of_grade("different")

    @property
    def misfits(self) -> tuple[str, ...]:
        """Names of the references that are not replicated: close and different ones."""
        return self._of_grade("close", "different")

    @property
    def compatible(self) -> tuple[str, ...]:
        """Names of the references that are replicated by the paper's measure."""
        return tuple(result.name for result in self.results if result.compatible)

    @property
    def means(self) -> dict[str, float]:
        """The mean of each measure over the references where it can be taken, by name; NaN where it never can."""
        return mean([result.measured for result in self.results]).by_name()

    @property
    def remarks(self) -> list[str]:
        """What of the references was left out, and which of them follow others, in words."""
        lines = [f"{name}: {reason}" for name, reason in self.collection.get("left_out", {}).items()]
        lines += [f"{result.name}: {'; '.join(result.notes)}" for result in self if result.notes]
        return lines + [
            f"{result.name}: follows {result.follows}, which it is like" for result in self if result.follows
        ]

    @property
    def fitted(self) -> Iteration:
        """The same iteration without references that follow others."""
        own = {result.name: result for result in self.results if result.follows is None}
        if len(own) == len(self.results):
            return self
        groups = (Group(g.representative, tuple(name for name in g.members if name in own)) for g in self.groups)
        return replace(self, results=tuple(own.values()), groups=tuple(groups))

    def _of_grade(self, *grades: Grade) -> tuple[str, ...]:
        return tuple(result.name for result in self.results if result.grade in grades)

    @property
    def record(self) -> dict[str, Any]:
        """Everything but meshes and pictures, as plain values for JSON; NaN becomes null."""
        head = self.head
        after = {name: head.pop(name) for name in _AFTER}
        return {**head, "references": list(self.entries()), **after}

    def entries(self) -> Iterator[dict[str, Any]]:
        """Those of the references in the record."""
        slugs = file_names(self.names)
        return (to_record(result, slugs[result.name]) for result in self.results)

    @property
    def head(self) -> dict[str, Any]:
        """The record without the references."""
        return {
            "format": FORMAT,
            "created": self.created,
            "version": self.versions["shapewright"],
            "versions": dict(self.versions),
            "seed": self.settings.seed,
            "settings": self.settings.record(),
            "procedure": dict(self.procedure),
            "collection": dict(self.collection),
            "judge": self.settings.judge,
            "threshold": self.metric.threshold,
            "metric": asdict(self.metric),
            "groups": [{"representative": g.representative, "members": list(g.members)} for g in self.groups],
            "worth_marking": list(worth_marking(self)),
            "metrics": dict(self.metrics),
            "seconds": dict(self.seconds),
        }

    def save(self, folder: str | Path, also: Callable[[Path], object] | None = None) -> Path:
        """Write the run to a folder that does not exist yet, whole or not at all, and return it.

        also: writes more files into the folder before it takes its place, such as an explanation or the report.
        Raises RunError when the folder holds something already or cannot be written. Then nothing stays behind.
        """
        folder = Path(folder).expanduser().absolute()
        with new_folder(folder) as partial:
            self._write(partial)
            if also:
                also(partial)
        return folder

    @classmethod
    def load(cls, folder: str | Path) -> Iteration:
        """Read a run back, without the references' meshes. Raises RunError when the folder holds no whole run."""
        folder = Path(folder).expanduser()
        record = read_record(folder)
        entries = record["references"]
        is_large = record["format"] == LARGE_FORMAT
        return cls(
            results=_lazy_results(folder, entries) if is_large else tuple(_result(folder, each) for each in entries),
            metric=Metric.of_record(record),
            groups=tuple(Group(g["representative"], tuple(g["members"])) for g in record["groups"]),
            settings=Settings.from_record({**_AS_BEFORE, **record["settings"]}),
            source=text_in(folder).read_text(encoding="utf-8"),
            pictures=KeptPictures(folder, entries) if is_large else dict(pictures_of(folder, entries)),
            helpers=read_helpers(folder),
            predictor=Predictor.load(folder / "predictor.pt") if (folder / "predictor.pt").exists() else None,
            **{name: record[name] for name in _AS_RECORDED},
        )

    def _write(self, folder: Path) -> None:
        write_source(folder, self.procedure.get("path"), self.source, self.helpers)
        self._write_csv(folder / "parameters.csv")
        if self.predictor:
            self.predictor.save(folder / "predictor.pt")
        if table.is_large(len(self)):
            self._write_large(folder)
            return
        (folder / RECORD).write_text(json.dumps(self.record, indent=1, allow_nan=False), encoding="utf-8")
        parameters = {result.name: result.parameters for result in self.results}
        (folder / "parameters.json").write_text(json.dumps(parameters, indent=1), encoding="utf-8")
        for name in ("replicas", "thumbnails"):
            (folder / name).mkdir()
        for path, content in self._files():
            (folder / path).write_bytes(content)

    def _write_large(self, folder: Path) -> None:
        """As a table and tars."""
        record = {**self.head, "format": LARGE_FORMAT}
        (folder / RECORD).write_text(json.dumps(record, indent=1, allow_nan=False), encoding="utf-8")
        table.write(folder, self.entries(), self.procedure["parameters"])
        with packing(folder) as packer:
            for path, content in self._files():
                packer.add(path, content)

    def _files(self) -> Iterator[tuple[str, bytes]]:
        """Replicas and thumbnails, by their path in the run."""
        pictures = self.pictures or draw_pictures(self.results)
        slugs = file_names(self.names)
        for result in self.results:
            slug, replica = slugs[result.name], result.replica
            if replica is not None and (path := replica_path(replica, slug)):
                yield path, encode(replica, "glb", self._origin(result))
            for kind, picture in zip(("reference", "replica"), pictures[result.name], strict=True):
                if picture is not None:
                    yield f"thumbnails/{slug}.{kind}.png", picture

    def _origin(self, result: Result) -> dict[str, Any]:
        """Where a replica comes from, for the extras of its file."""
        return {
            "procedure": self.procedure.get("name", "shape"),
            "parameters": result.parameters,
            "reference": result.name,
            "seed": self.settings.seed,
            "shapewright": self.versions.get("shapewright", ""),
        }

    def _write_csv(self, path: Path) -> None:
        names = [parameter["name"] for parameter in self.procedure["parameters"]]
        with path.open("w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow(["reference", "grade", "compatible", *MEASURES, "group", *names])
            for result in self.results:
                measures = ("" if math.isnan(value) else f"{value:.6f}" for value in result.measures.values())
                values = (result.parameters or {}).get
                group = "" if result.group is None else result.group
                known = (result.name, result.grade, result.compatible)
                row = [*known, *measures, group, *(values(n, "") for n in names)]
                table.writerow([cell(value) if isinstance(value, str) else value for value in row])


def _result(folder: Path, entry: Mapping[str, Any]) -> Result:
    return from_record(entry, read_replica(folder, entry))


def _lazy_results(folder: Path, entries: Sequence[Mapping[str, Any]]) -> Sequence[Result]:
    def result(place: int) -> Result:
        entry = entries[place]
        return from_record(entry, later(partial(read_replica, folder, entry)))

    return Lazy(len(entries), result)
