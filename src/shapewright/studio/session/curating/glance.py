"""What is known of many shapes together: the parameters of all references, and one reference through all runs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from shapewright.runs.folder import RunError, read_record
from shapewright.runs.result import grade_in
from shapewright.studio.session.display import Display
from shapewright.studio.session.standard import Standard
from shapewright.studio.wire.detail import ParameterRow, ParameterTable, Step


def parameter_table(display: Display) -> ParameterTable:
    """The parameters of all replicas that are shown, and how well the network predicts each."""
    rows = [
        ParameterRow(slug=slug, parameters=state.parameters, active=state.active)
        for slug, state in display.board.references.items()
        if state.parameters is not None and state.name not in display.board.left_out
    ]
    try:
        record: Mapping[str, Any] = read_record(display.run) if display.run else {}
    except RunError:
        record = {}
    metrics = record.get("metrics", {})
    return ParameterTable(
        run=display.board.run, rows=rows, validation=metrics.get("validation", {}), samples=metrics.get("samples")
    )


def steps(display: Display, runs: list[Path], name: str) -> list[Step]:
    """One reference in all runs that know it, the oldest first."""
    found = []
    for run in runs:
        try:
            record = read_record(run)
        except RunError:
            continue
        entry = next((one for one in record["references"] if one["name"] == name), None)
        if entry:
            found.append(_step(display, run, record, entry))
    return found


def _step(display: Display, run: Path, record: Mapping[str, Any], entry: Mapping[str, Any]) -> Step:
    standard, grade = Standard.of_run(record), grade_in(entry)
    return Step(
        run=run.name,
        created=record["created"],
        procedure=record["procedure"]["digest"],
        replica=display.pictures.add_file(run / "thumbnails" / f"{entry['slug']}.replica.png"),
        fidelity=entry.get("fidelity"),
        distance=entry["distance"],
        grade=grade,
        colour=standard.colour(grade, entry.get("fidelity"), entry["distance"]),
        parameters=entry["parameters"],
        active=entry["active"],
        error=entry["error"],
    )
