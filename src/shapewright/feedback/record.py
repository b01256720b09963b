"""An explanation in a run's folder: ``explanation.json``, pictures of suggestions, and the report written anew."""

from __future__ import annotations

import base64
import json
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from shapewright.report import write_report
from shapewright.report.explained import EXPLANATION, PICTURES
from shapewright.runs.folder import RunError
from shapewright.storage import scratch_folder


def write_into(folder: Path, record: Mapping[str, Any]) -> dict[str, Any]:
    """Write an explanation's record into a folder that is still being made; return it as it was written.

    Pictures of suggestions are given in base64 and become files, whose paths in the folder replace them.
    """
    told = {**record, "suggestions": [dict(suggestion) for suggestion in record["suggestions"]]}
    for number, suggestion in enumerate(told["suggestions"], start=1):
        picture = suggestion.get("picture")
        if picture:
            (folder / PICTURES).mkdir(exist_ok=True)
            path = f"{PICTURES}/{number}.png"
            (folder / path).write_bytes(base64.b64decode(picture))
            suggestion["picture"] = path
    (folder / EXPLANATION).write_text(json.dumps(told, indent=1, allow_nan=False), encoding="utf-8")
    return told


def write(run: Path, record: Mapping[str, Any], previous: Path | None = None) -> dict[str, Any]:
    """Put an explanation into the folder of a finished run, in the place of an earlier one, and renew its report.

    Everything is written beside its place first and moved there at the end. previous: the run that the report compares
    with. Returns the record as it was written. Raises RunError when the folder cannot be written; then all stays as it
    was.
    """
    try:
        with scratch_folder(run / EXPLANATION) as partial:
            told = write_into(partial, record)
            write_report(run, previous, partial)
            shutil.rmtree(run / PICTURES, ignore_errors=True)
            for path in partial.iterdir():
                path.replace(run / path.name)
    except OSError as error:
        raise RunError(f"{run}: the explanation cannot be written: {error.strerror or error}") from error
    return told
