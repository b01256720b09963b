"""What the author tells of single references in the page: it goes where a manifest would have it."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import cast

from shapewright.references.errors import CollectionError
from shapewright.references.manifests.folder_tables import TABLE, Tables, with_cells
from shapewright.references.orientation import Orientation
from shapewright.references.sources import MANIFEST, Source
from shapewright.storage import write_file
from shapewright.studio.project.workspace import Project, ProjectError
from shapewright.studio.wire.detail import Told
from shapewright.studio.wire.values import Axis


def told(source: Source) -> Told:
    """What the table of its folder says of a reference. Raises CollectionError."""
    row = Tables().row(source.path)
    if row is None:
        return Told()
    up, front = (row.cells.get(axis, "").lower().removeprefix("+") for axis in ("up", "front"))
    return Told(up=cast(Axis, up or None), front=cast(Axis, front or None), split=row.switches.split)


def tell(project: Project, sources: Iterable[Source], told: Told) -> None:
    """Write it into the tables of their folders, in place of what was told before.

    Raises ProjectError where that cannot be; then nothing is written.
    """
    texts: dict[Path, str] = {}
    for source in sources:
        table = _table(project, source, told)
        before = texts[table] if table in texts else table.read_text("utf-8") if table.is_file() else ""
        cells = {"up": told.up or "", "front": told.front or "", "split": told.split or ""}
        texts[table] = with_cells(before, source.path.name, cells)
    for table, text in texts.items():
        try:
            write_file(table, text) if text else table.unlink(missing_ok=True)
        except OSError as error:
            raise ProjectError(f"{table}: cannot be written: {error.strerror or error}") from error


def _table(project: Project, source: Source, told: Told) -> Path:
    if Path(project.origin.source).suffix.lower() == MANIFEST:
        raise ProjectError(f"{Path(project.origin.source).name} lists these references: write it there")
    if source.archive:
        raise ProjectError(f"{source.name} lies in {source.archive.name}: unpack it, and tell it then")
    table = source.path.parent / TABLE
    if not source.path.parent.resolve().is_relative_to(project.folder) or table.is_symlink():
        raise ProjectError(
            f"{source.name} lies outside the project, where the studio writes nothing: write it into {table}"
        )
    try:
        others = (None, None) if project.origin.auto else (project.origin.up, project.origin.front)
        Orientation.of(told.up or others[0] or "y", told.front or others[1])
    except CollectionError as error:
        raise ProjectError(f"{source.name}: {error}") from error
    return table
