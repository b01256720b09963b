"""The table in a folder that says something of single files of it, in the columns of a manifest."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from pathlib import Path

from shapewright.references.manifests.rows import Row, rows_of

TABLE = "shapewright.csv"
"""Its name. Files that it does not list are read as ever."""


class Tables:
    """Those of all folders, each read once."""

    def __init__(self) -> None:
        self._rows: dict[Path, dict[Path, Row]] = {}

    def row(self, file: Path) -> Row | None:
        """What the table of its folder says of a file. Raises CollectionError, with the line, as ``rows_of`` does."""
        folder = file.parent
        if folder not in self._rows:
            table = folder / TABLE
            self._rows[folder] = {folder / row.path: row for row in rows_of(table)} if table.is_file() else {}
        return self._rows[folder].get(file)


def with_cells(text: str, file: str, cells: Mapping[str, str]) -> str:
    """The text of a table with these cells in the line of a file, see ``with_lines``."""
    return with_lines(text, {file: cells})


def with_lines(text: str, told: Mapping[str, Mapping[str, str]]) -> str:
    """The text of a table with cells in the lines of files; an empty cell says nothing.

    told: cells by column, by the file's name. Columns and lines are added where they are missing. A line that says
    nothing any more goes; without lines the text is empty.
    """
    separator = max(",;\t", key=text.partition("\n")[0].count) if text else ","
    lines = [line for line in csv.reader(io.StringIO(text.lstrip("\ufeff"), newline=""), delimiter=separator) if line]
    columns = [cell.strip().lower() for cell in lines[0]] if lines else ["path"]
    columns += [
        name for name in dict.fromkeys(name for cells in told.values() for name in cells) if name not in columns
    ]
    rows = [dict(zip(columns, line, strict=False)) for line in lines[1:]]
    listed = {row.get("path", "").strip() for row in rows}
    rows += [{"path": file} for file in told if file not in listed]
    for row in rows:
        row.update(told.get(row.get("path", "").strip(), {}))
    kept = [row for row in rows if any(value.strip() for name, value in row.items() if name != "path")]
    written = io.StringIO()
    out = csv.DictWriter(written, columns, restval="", delimiter=separator, lineterminator="\n")
    out.writeheader()
    out.writerows(kept)
    return written.getvalue() if kept else ""
