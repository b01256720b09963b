"""The program of an export: replicas, random samples, the report and the parameters of a run, in one ZIP."""

from __future__ import annotations

import re
import time
import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from shapewright.runs.folder import read_record
from shapewright.shapes import Mesh
from shapewright.storage import remove_leftovers, scratch_folder, whole_file
from shapewright.studio.jobs import events
from shapewright.studio.wire.work import JobResult

if TYPE_CHECKING:
    from shapewright.references import Reference
    from shapewright.shapes.files import Format

_KEPT = 5
"""Exports that are left in the project's scratch folder; older ones are deleted."""


def pack(request: Mapping[str, Any], reporter: events.Reporter) -> Path:
    """Write the ZIP that a request describes; returns its path."""
    folder = Path(request["folder"])
    folder.mkdir(parents=True, exist_ok=True)
    run = Path(request["run"]) if request["run"] else None
    names = [Path(request["procedure"]).resolve().parent.name, *([run.name] if run else [])]
    stem = re.sub(r"[^A-Za-z0-9_-]+", "-", "-".join(names))
    file = folder / f"{stem.strip('-')}-{time.strftime('%Y%m%d-%H%M%S')}.zip"
    remove_leftovers(folder)
    with whole_file(file) as unfinished, zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as archive:
        for part, name in (("report", "report.html"), ("parameters", "parameters.csv")):
            if run and part in request["what"]:
                archive.write(run / name, name)
        if run and "replicas" in request["what"]:
            references = _references(request) if request.get("frame") == "reference" else None
            for name, data in _replicas(run, request["format"], references, reporter):
                archive.writestr(f"replicas/{name}", data)
        if "samples" in request["what"]:
            _add_samples(request, archive, reporter)
    for old in sorted(folder.glob("*.zip"), key=lambda path: path.stat().st_mtime)[:-_KEPT]:
        old.unlink()
    return file


def _references(request: Mapping[str, Any]) -> dict[str, Reference]:
    from shapewright.studio.jobs.fit_job import collection
    from shapewright.studio.project.listing import Origin

    return {reference.name: reference for reference in collection(Origin(**request["origin"]))}


def _replicas(
    run: Path, format: Format, references: Mapping[str, Reference] | None, reporter: events.Reporter
) -> Iterator[tuple[str, bytes]]:
    """Names and contents of the replicas' files; each says in its extras which reference it replicates.

    references: by name, to lay the replicas over; None: they stay as the procedure builds them.
    """
    from shapewright.procedures import Facts
    from shapewright.runs import packed
    from shapewright.runs.result import read_replica
    from shapewright.shapes.files import encode

    record = read_record(run)
    facts = Facts.of(record["procedure"])
    entries = [entry for entry in record["references"] if entry["replica"]]
    for done, entry in enumerate(entries):
        file = run / entry["replica"]
        as_built = references is None or entry["name"] not in references
        if file.suffix != ".glb" or (as_built and format == "glb"):
            yield file.name, packed.read(run, entry["replica"]) or b""
        else:
            extras = {"procedure": record["procedure"]["name"], "reference": entry["name"]}
            extras |= {"parameters": entry["parameters"], **(facts.stated if as_built else {})}
            shape = read_replica(run, entry)
            assert isinstance(shape, Mesh)
            laid = facts.laid(shape) if references is None or as_built else _over(shape, references[entry["name"]])
            yield f"{entry['slug']}.{format}", encode(laid, format, extras)
        reporter.stage("replicas", done + 1, len(entries))


def _over(replica: Mesh, reference: Reference) -> Mesh:
    """A replica in the axes and units of its reference's file, where that stands."""
    return replace(replica, vertices=reference.to_original(replica.normalised().vertices))


def _add_samples(request: Mapping[str, Any], archive: zipfile.ZipFile, reporter: events.Reporter) -> None:
    from shapewright.fitting.samples import write_samples
    from shapewright.procedures import load_procedure

    with scratch_folder(Path(request["folder"]) / "samples") as place:
        home = place / "samples"
        write_samples(
            load_procedure(request["procedure"]),
            request["count"],
            home,
            request["format"],
            request["seed"],
            progress=partial(reporter.stage, "samples"),
        )
        for path in sorted(home.iterdir()):
            archive.write(path, f"samples/{path.name}")


def export(request: Mapping[str, Any], reporter: events.Reporter) -> JobResult:
    """Pack what a request describes."""
    file = pack(request, reporter)
    return JobResult(url=f"/api/exports/{quote(file.name)}", bytes=file.stat().st_size)


if __name__ == "__main__":
    events.run("export", export)
