"""Builds in one file: parameters, seconds, and the shapes to the bit."""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.building import Build, Failure
from shapewright.shapes import Drawing, Mesh
from shapewright.shapes.packed import pack, unpack
from shapewright.storage import remove_leftovers, whole_file

LEAST_SECONDS = 0.02
"""Of building one shape, for a file: 3,000 samples take a minute of one core then, and a second to read."""
MOST_BYTES = 2 * 10**9
"""Of all files together; those that were not used for the longest time go. Some forty procedures of 1,000 triangles."""
_MOST_OF_ONE = 5 * 10**8
_FORMAT = 2
_DAMAGED = (OSError, EOFError, ValueError, KeyError, TypeError, zipfile.BadZipFile)


def write(path: Path, digest: str, builds: Sequence[Build]) -> None:
    """Write shapes and infeasible ones; the newest as far as they fit. What cannot be written is built another time."""
    rows: list[dict[str, Any]] = []
    parts: list[bytes] = []
    size = 0
    for build in reversed(builds):
        row, content = _packed(build)
        size += len(content)
        if row and size <= _MOST_OF_ONE:
            rows.append(row)
            parts.append(content)
    head = json.dumps({"format": _FORMAT, "digest": digest, "builds": rows}).encode()
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        remove_leftovers(path.parent)
        with whole_file(path) as partial, partial.open("wb") as file:
            np.savez(file, head=np.frombuffer(head, np.uint8), shapes=np.frombuffer(b"".join(parts), np.uint8))


def read(path: Path) -> tuple[str, list[Build]]:
    """The digest and the builds of a file; none of one that is damaged, of another version, or not there."""
    try:
        with np.load(path, allow_pickle=False) as file:
            head, shapes = json.loads(file["head"].tobytes()), file["shapes"].tobytes()
        if head["format"] != _FORMAT:
            return "", []
        builds, start = [], 0
        for row in head["builds"]:
            builds.append(_unpacked(row, shapes[start : start + row["bytes"]]))
            start += row["bytes"]
        os.utime(path)
        return str(head["digest"]), builds[::-1]
    except _DAMAGED:
        return "", []


def tidy(folder: Path) -> None:
    """Remove files that were not used for the longest time until all others are small enough."""
    with suppress(OSError):
        files = sorted(folder.glob("*.npz"), key=lambda file: file.stat().st_mtime, reverse=True)
        total = 0
        for file in files:
            total += file.stat().st_size
            if total > MOST_BYTES:
                file.unlink(missing_ok=True)


def _packed(build: Build) -> tuple[dict[str, Any] | None, bytes]:
    """A row of the head, and the bytes of the shape; no row of a failure that may be another one next time."""
    row: dict[str, Any] = {"parameters": dict(build.parameters), "seconds": build.seconds, "bytes": 0}
    if build.shape is None:
        infeasible = build.failure is not None and build.failure.kind == "infeasible"
        return (row | {"infeasible": build.failure.message} if infeasible and build.failure else None), b""
    head, content = pack(build.shape)
    return row | {"shape": head, "bytes": len(content)}, content


def _unpacked(row: dict[str, Any], content: bytes) -> Build:
    if "infeasible" in row:
        return Build(row["parameters"], None, Failure("infeasible", row["infeasible"]), row["seconds"])
    shape = unpack(row["shape"], content)
    assert isinstance(shape, Mesh | Drawing)
    return Build(row["parameters"], shape, None, row["seconds"])
