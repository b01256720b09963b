"""What the author tells of single references in the page: it goes where a manifest would have it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TypeVar, cast

from shapewright.procedures.facts import Unit
from shapewright.references.errors import CollectionError
from shapewright.references.manifests.folder_tables import TABLE, Tables, with_lines
from shapewright.references.orientation import Orientation
from shapewright.references.sources import MANIFEST, Source
from shapewright.storage import write_file
from shapewright.studio.project.workspace import Project, ProjectError
from shapewright.studio.wire.detail import Told
from shapewright.studio.wire.values import Axis

Key = TypeVar("Key")


def told(source: Source) -> Told:
    """What the table of its folder says of a reference. Raises CollectionError."""
    return _told(source, Tables())


def told_of(sources: Mapping[Key, Source]) -> dict[Key, Told]:
    """The same of several; each table is read once. Raises CollectionError."""
    tables = Tables()
    return {key: _told(source, tables) for key, source in sources.items()}


def _told(source: Source, tables: Tables) -> Told:
    row = tables.row(source.path)
    if row is None:
        return Told()
    up, front, unit = (row.cells.get(word, "").lower().removeprefix("+") or None for word in ("up", "front", "unit"))
    return Told(up=cast(Axis, up), front=cast(Axis, front), unit=cast(Unit, unit), split=row.switches.split)


def tell(project: Project, told: Iterable[tuple[Source, Told]]) -> None:
    """Write it into the tables of their folders, in place of what was told before.

    Raises ProjectError where that cannot be; then nothing is written.
    """
    lines: dict[Path, dict[str, dict[str, str]]] = {}
    for source, said in told:
        cells: dict[str, str] = {"up": said.up or "", "front": said.front or "", "split": said.split or ""}
        if said.unit or _told(source, Tables()).unit:
            cells["unit"] = said.unit or ""
        lines.setdefault(_table(project, source, said), {})[source.path.name] = cells
    texts = {table: with_lines(table.read_text("utf-8") if table.is_file() else "", of) for table, of in lines.items()}
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
