"""Silhouettes of a collection of meshes, written as drawings."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from shapewright.references.collection import Collection
from shapewright.references.errors import CollectionError
from shapewright.rendering.ink import png
from shapewright.rendering.projection import View, silhouette
from shapewright.shapes import Mesh
from shapewright.shapes.files import svg
from shapewright.storage import file_names, whole_folder
from shapewright.threads import in_threads


def write_silhouettes(
    references: Collection,
    folder: Path,
    view: View = "front",
    format: Literal["svg", "png"] = "svg",
    threads: int | None = None,
) -> tuple[list[Path], dict[str, str]]:
    """Write a drawing of every mesh into a new folder; returns their paths, and why a reference has none.

    The folder is written whole or not at all. Raises CollectionError for a collection of drawings, FileExistsError for
    a folder that holds something already, OSError when the disk cannot be written.
    """
    if references.kind is not Mesh:
        raise CollectionError(f"{references.source}: these are drawings already; silhouettes are of meshes")
    slugs = file_names(references.names)
    unseen: dict[str, str] = {}

    def write(name: str) -> Path | None:
        shape = references[name].shape
        assert isinstance(shape, Mesh)
        try:
            drawing = silhouette(shape, view)
        except ValueError as error:
            unseen[name] = str(error)
            return None
        path = partial / f"{slugs[name]}.{format}"
        path.write_bytes(svg(drawing) if format == "svg" else png(drawing))
        return folder / path.name

    with whole_folder(folder) as partial:
        written = in_threads(write, references.names, threads)
    return [path for path in written if path], unseen
