"""What the author notes of references: tags, a text, and which are no part of the collection.

They are in ``notes.json``, beside the marks: a JSON list of objects ``{"name", "tags", "note", "not_mine"}``, of those
references that have something. Other entries of an object stay unchanged.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from msgspec import ValidationError, convert

from shapewright.storage import write_file
from shapewright.studio.project.workspace import ProjectError
from shapewright.studio.wire.revisions import Noted

NOTES = "notes.json"
NOTHING = Noted()


def read_notes(project: Path) -> dict[str, Noted]:
    """By name of the reference. Raises ProjectError for a file that cannot be read."""
    return {entry["name"]: _noted(entry, project) for entry in _read(project / NOTES)}


def write_notes(project: Path, changed: Mapping[str, Noted]) -> None:
    """Replace what is noted of these references, by name; all others stay. Raises ProjectError."""
    entries = {entry["name"]: entry for entry in _read(project / NOTES)}
    for name, noted in changed.items():
        told = {"tags": noted.tags, "note": noted.note, "not_mine": noted.not_mine}
        entries[name] = {**entries.get(name, {}), "name": name, **{key: value for key, value in told.items() if value}}
        for key in [key for key, value in told.items() if not value]:
            entries[name].pop(key, None)
    kept = [entry for entry in entries.values() if len(entry) > 1]
    try:
        write_file(project / NOTES, json.dumps(kept, indent=1, ensure_ascii=False) + "\n")
    except (OSError, UnicodeEncodeError) as error:
        raise ProjectError(f"{project / NOTES}: cannot be written: {error}") from error


def _read(path: Path) -> list[dict[str, Any]]:
    try:
        entries: Any = json.loads(path.read_text(encoding="utf-8")) if path.exists() else []
    except (OSError, ValueError, RecursionError) as error:
        raise ProjectError(f"{path}: cannot be read: {error}; mend it, or move it away") from error
    if not isinstance(entries, list) or not all(
        isinstance(e, dict) and isinstance(e.get("name"), str) for e in entries
    ):
        raise ProjectError(f"{path}: holds no list of notes, each with a name; mend it, or move it away")
    return entries


def _noted(entry: Mapping[str, Any], project: Path) -> Noted:
    try:
        return convert({key: entry[key] for key in Noted.__struct_fields__ if key in entry}, Noted)
    except ValidationError as error:
        raise ProjectError(f"{project / NOTES}: {entry['name']}: {error}; mend it, or move the file away") from error
