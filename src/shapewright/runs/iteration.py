"""The results of one turn of the loop; it is written to disk and read back."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.comparison.grouping import Group
from shapewright.judging.paper import Metric
from shapewright.judging.target import mean
from shapewright.judging.verdict import Grade
from shapewright.prediction.predictor import Predictor
from shapewright.rendering.thumbnails import seen_from, thumbnail
from shapewright.runs.folder import FORMAT, RECORD, new_folder, read_record
from shapewright.runs.helpers import read_helpers, text_in, write_source
from shapewright.runs.marks import worth_marking
from shapewright.runs.result import MEASURES, Result, from_record, read_replica, replica_path, to_record
from shapewright.settings import Settings
from shapewright.shapes import Mesh
from shapewright.shapes.files import encode
from shapewright.shapes.shelf import fresh
from shapewright.storage import cell, file_names
from shapewright.threads import in_threads

_AS_RECORDED = ("seconds", "procedure", "collection", "metrics", "versions", "created")
_AS_BEFORE = {"drop": "nothing", "duplicates": "each"}
"""Settings of runs of versions that did not have them."""
Pictures = Mapping[str, tuple[bytes, bytes | None]]


@dataclass(frozen=True, eq=False)
class Iteration:
    """The results of one turn of the loop: ``it["name"]``, ``it.replicated``, ``it.groups``, ``it.seconds``.

    Attributes:
        results: one of each reference, in the order of the collection.
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

    results: tuple[Result, ...]
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
    def _by_name(self) -> dict[str, Result]:
        return {result.name: result for result in self.results}

    def __getitem__(self, name: str) -> Result:
        if name not in self._by_name:
            raise KeyError(f"no reference {name!r} in this iteration")
        return self._by_name[name]

    def __iter__(self) -> Iterator[Result]:
        return iter(self.results)

    def __len__(self) -> int:
        return len(self.results)

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(self._by_name)

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

    @cached_property
    def record(self) -> dict[str, Any]:
        """Everything but meshes and pictures, as plain values for JSON; NaN becomes null."""
        slugs = file_names(self.names)
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
            "references": [to_record(result, slugs[result.name]) for result in self.results],
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
        return cls(
            results=tuple(from_record(entry, read_replica(folder, entry)) for entry in record["references"]),
            metric=Metric.of_record(record),
            groups=tuple(Group(g["representative"], tuple(g["members"])) for g in record["groups"]),
            settings=Settings.from_record({**_AS_BEFORE, **record["settings"]}),
            source=text_in(folder).read_text(encoding="utf-8"),
            pictures={entry["name"]: _read_pictures(folder, entry["slug"]) for entry in record["references"]},
            helpers=read_helpers(folder),
            predictor=Predictor.load(folder / "predictor.pt") if (folder / "predictor.pt").exists() else None,
            **{name: record[name] for name in _AS_RECORDED},
        )

    def _write(self, folder: Path) -> None:
        (folder / RECORD).write_text(json.dumps(self.record, indent=1, allow_nan=False), encoding="utf-8")
        write_source(folder, self.procedure.get("path"), self.source, self.helpers)
        parameters = {result.name: result.parameters for result in self.results}
        (folder / "parameters.json").write_text(json.dumps(parameters, indent=1), encoding="utf-8")
        self._write_csv(folder / "parameters.csv")
        if self.predictor:
            self.predictor.save(folder / "predictor.pt")
        (folder / "replicas").mkdir()
        (folder / "thumbnails").mkdir()
        pictures = self.pictures or draw_pictures(self.results)
        slugs = file_names(self.names)
        for result in self.results:
            slug = slugs[result.name]
            if result.replica is not None and (path := replica_path(result.replica, slug)):
                (folder / path).write_bytes(encode(result.replica, "glb", self._origin(result)))
            for kind, picture in zip(("reference", "replica"), pictures[result.name], strict=True):
                if picture is not None:
                    (folder / "thumbnails" / f"{slug}.{kind}.png").write_bytes(picture)

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


def draw_pictures(results: Sequence[Result], threads: int | None = None) -> Pictures:
    """Thumbnails (PNG) of every reference and replica, by name."""
    drawn = in_threads(_drawn, [result for result in results if result.reference is not None], threads)
    return dict(zip([result.name for result in results], drawn, strict=True))


def _drawn(result: Result) -> tuple[bytes, bytes | None]:
    assert result.reference is not None
    reference, replica = thumbnail(fresh(result.reference)), result.replica
    if isinstance(replica, Mesh) and result.places:
        return reference, seen_from(replica, [np.array(place) for place in result.places])
    return reference, None if replica is None else thumbnail(replica)


def _read_pictures(folder: Path, slug: str) -> tuple[bytes, bytes | None]:
    reference, replica = (folder / "thumbnails" / f"{slug}.{kind}.png" for kind in ("reference", "replica"))
    return reference.read_bytes(), replica.read_bytes() if replica.exists() else None
