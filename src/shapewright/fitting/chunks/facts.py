"""What decides the result of a fit: where all of it is the same, what another process has done of it holds."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from typing import Any

from shapewright.building import Build
from shapewright.fitting.pacing.stock import text_digest
from shapewright.parameters import Parameters
from shapewright.procedures import Procedure
from shapewright.references import Collection
from shapewright.runs.iteration import Iteration
from shapewright.settings import Settings
from shapewright.shapes import shape_digest
from shapewright.shapes.shelf import fresh
from shapewright.versions import versions

_FORMAT = 1
"""Of the pieces that are kept; raise it whenever another version would take them for something else."""


def deciding(
    procedure: Procedure,
    references: Collection,
    settings: Settings,
    previous: Iteration | None,
    known: Mapping[str, Sequence[Parameters]] | None,
) -> dict[str, Any]:
    """As plain values. references: those that are fitted, as they are compared."""
    return {
        "format": _FORMAT,
        "versions": versions(),
        "procedure": [str(procedure.path), procedure.name, text_digest(procedure)],
        "settings": settings.record(),
        "references": _digest_of(references),
        "previous": previous and _digest_of_run(previous),
        "known": {name: list(some) for name, some in (known or {}).items()},
    }


def looks(builds: Sequence[Build]) -> list[str]:
    """What some builds are, to the bit: another list means that the procedure builds something else."""
    return [shape_digest(build.shape) if build.shape else str(build.failure) for build in builds]


def _digest_of_run(iteration: Iteration) -> str:
    found = hashlib.sha256(json.dumps(iteration.head).encode())
    for entry in iteration.entries():
        found.update(json.dumps([entry["name"], entry["parameters"]]).encode())
    return found.hexdigest()


def _digest_of(references: Collection) -> str:
    found = hashlib.sha256()
    for each in references:
        found.update(repr((each.name, shape_digest(fresh(each.shape)), each.extent)).encode())
    return found.hexdigest()
