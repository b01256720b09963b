"""Where references come from: a folder, a glob, a manifest or a file; each stands for a list of files."""

from __future__ import annotations

import csv
import difflib
import glob
import io
import os
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeAlias

from shapewright.references.errors import CollectionError
from shapewright.references.orientation import Orientation
from shapewright.references.readers.formats import EXTENSIONS, MESHES

Origin: TypeAlias = str | os.PathLike[str]
_SHAPENET = ("models", "model_normalized.obj")
MANIFEST = ".csv"
"""The extension of a table that lists files."""
_LOOKED_FOR = " ".join(EXTENSIONS)
_SHOWN = 5
_TEXTURE = ".png"


@dataclass(frozen=True)
class Source:
    """A file to read.

    Attributes:
        name: of its reference, unique among all sources.
        path: the file.
        orientation: the axes that point up and to the front in it.
    """

    name: str
    path: Path
    orientation: Orientation


def find(origins: Sequence[Origin], up: str = "y", front: str | None = None) -> list[Source]:
    """The files of a collection, in natural order of their names (chair2 before chair10).

    A folder gives the files directly in it. When none of them is a shape, it gives those of all folders below. Beside
    meshes and above them PNG files are textures and previews, and are left out. A pattern is a glob, ``**`` included.
    A ``.csv`` file is a manifest with a column ``path``, relative to the manifest, and if wanted the columns ``name``,
    ``up`` and ``front``; for an empty cell the argument holds. Hidden files and files of other kinds are left out.
    A name is the file's stem, or the shape's id in ``<id>/models/model_normalized.obj`` (ShapeNet). Where names clash
    the path takes its place. Raises CollectionError where there is nothing to read.
    """
    default = Orientation.of(up, front)
    if not origins:
        raise CollectionError("the list of references is empty; give it folders, patterns or files")
    sources: list[Source] = []
    try:
        for path in (Path(origin).expanduser() for origin in origins):
            if path.suffix.lower() == MANIFEST and path.is_file():
                sources += _in_manifest(path, up, front)
            else:
                sources += [Source(_stem(file), file, default) for file in _expand(path, alone=len(origins) == 1)]
    except OSError as error:
        raise CollectionError(f"cannot look into {error.filename}: {error.strerror}") from error
    names = _unique([source.name for source in sources], [source.path for source in sources])
    named = (replace(source, name=name) for source, name in zip(sources, names, strict=True))
    return sorted(named, key=lambda source: natural_key(source.name))


def natural_key(name: str) -> tuple[list[int | str], str]:
    """Sorts numbers inside names by their value, and letters without regard to case."""
    pieces = re.split(r"(\d+)", name.casefold())
    return [int(piece) if i % 2 else piece for i, piece in enumerate(pieces)], name


def _expand(path: Path, alone: bool) -> list[Path]:
    """The files that one origin stands for; a missing or strange file in a list is left for its reader to report."""
    if path.is_dir():
        return _in_folder(path)
    if not path.exists() and glob.has_magic(str(path)):
        return _in_pattern(path)
    if alone and not path.exists():
        raise CollectionError(f"no such file or folder: {path}{_alternatives(path)}")
    if alone and not _is_shape(path):
        raise CollectionError(f"{path} is not a kind of file that is read; {_LOOKED_FOR} and {MANIFEST} are")
    return [path]


def _in_folder(folder: Path) -> list[Path]:
    direct = _without_textures([path for path in folder.iterdir() if path.is_file() and _is_shape(path)])
    if any(path.suffix.lower() != _TEXTURE for path in direct):
        return sorted(direct)
    below = sorted(_walk(folder))
    shapes = _without_textures([path for path in below if _is_shape(path)])
    if direct and not any(_is_mesh(path) for path in shapes):
        return sorted(direct)
    if not shapes:
        raise CollectionError(f"{folder} holds no shapes: looked for {_LOOKED_FOR}, found {_kinds(below)}")
    return shapes


def _walk(folder: Path) -> Iterator[Path]:
    """Every file below a folder; links to folders are followed, each folder is entered once."""
    entered: set[str] = set()
    for root, folders, files in os.walk(folder, onerror=_raise, followlinks=True):
        folders[:] = sorted(name for name in folders if not _is_hidden(name))
        if os.path.realpath(root) in entered:
            folders.clear()
            continue
        entered.add(os.path.realpath(root))
        yield from (Path(root, name) for name in files if not _is_hidden(name))


def _raise(error: OSError) -> None:
    raise error


def _in_pattern(pattern: Path) -> list[Path]:
    # Path.glob takes no absolute pattern.
    matches = [Path(match) for match in sorted(glob.glob(str(pattern), recursive=True))]  # noqa: PTH207
    files = [path for path in matches if path.is_file()]
    shapes = _without_textures([path for path in files if _is_shape(path)])
    if not shapes:
        found = _kinds(files) + ("; it matches folders: add /* to it" if len(matches) > len(files) else "")
        raise CollectionError(f"{pattern} matches no shapes: looked for {_LOOKED_FOR}, found {found}")
    return shapes


def _in_manifest(manifest: Path, up: str, front: str | None) -> list[Source]:
    text = manifest.read_text(encoding="utf-8-sig", errors="replace")
    header, _, _ = text.partition("\n")
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=max(",;\t", key=header.count))
    columns = [cell.strip().lower() for cell in next(rows, [])]
    if "path" not in columns:
        raise CollectionError(f"{manifest} has no column 'path'; its first line has {', '.join(columns) or 'none'}")
    sources: list[Source] = []
    for row in rows:
        cells = {column: cell.strip() for column, cell in zip(columns, row, strict=False)}
        if not any(cells.values()):
            continue
        if not cells.get("path"):
            raise CollectionError(f"{manifest}, line {rows.line_num}: no path")
        path = manifest.parent / cells["path"]
        try:
            orientation = Orientation.of(cells.get("up") or up, cells.get("front") or front)
        except CollectionError as error:
            raise CollectionError(f"{path}, as the manifest lists it: {error}") from error
        sources.append(Source(cells.get("name") or _stem(path), path, orientation))
    if not sources:
        raise CollectionError(f"{manifest} lists no files; give each a line with its path")
    return sources


def _stem(path: Path) -> str:
    return path.parent.parent.name if path.parts[-2:] == _SHAPENET and path.parent.parent.name else path.stem


def _unique(names: Sequence[str], paths: Sequence[Path]) -> list[str]:
    """Names that clash give way to the path, from the deepest folder that holds all files: without its extension,
    else whole; a file that is listed twice gets a number."""
    if len(set(names)) == len(names):
        return list(names)
    absolute = [path.absolute() for path in paths]
    common = os.path.commonpath([path.parent for path in absolute])
    relative = [path.relative_to(common) for path in absolute]
    without = [path.with_suffix("").as_posix() for path in relative]
    whole = [path.as_posix() for path in relative]
    result = list(names)
    for wider in (without, whole, whole):
        count = Counter(result)
        result = [wide if count[name] > 1 else name for name, wide in zip(result, wider, strict=True)]
    taken: set[str] = set()
    for i, name in enumerate(result):
        copies = (f"{name} ({n})" for n in range(2, len(result) + 2))
        result[i] = name if name not in taken else next(copy for copy in copies if copy not in taken)
        taken.add(result[i])
    return result


def _is_shape(path: Path) -> bool:
    return path.suffix.lower() in EXTENSIONS and not _is_hidden(path.name)


def _is_mesh(path: Path) -> bool:
    return path.suffix.lower() in MESHES


def _without_textures(paths: Sequence[Path]) -> list[Path]:
    """The shapes among files; where there are meshes among them, PNG files are none."""
    meshes = any(_is_mesh(path) for path in paths)
    return [path for path in paths if not (meshes and path.suffix.lower() == _TEXTURE)]


def _is_hidden(name: str) -> bool:
    """Hidden files, among them the resource forks that macOS puts beside every file of an archive."""
    return name.startswith(".") or name == "__MACOSX"


def _kinds(paths: Sequence[Path]) -> str:
    counts = Counter(path.suffix.lower() or "without extension" for path in paths)
    return ", ".join(f"{count} {kind}" for kind, count in counts.most_common(_SHOWN)) or "no files at all"


def _alternatives(path: Path) -> str:
    """What there is where a path ends that does not exist: similar names, or else some."""
    while not path.parent.exists() and path.parent != path:
        path = path.parent
    there = sorted(entry.name for entry in path.parent.iterdir()) if path.parent.is_dir() else []
    similar = difflib.get_close_matches(path.name, there, n=3)
    if similar:
        return f"; did you mean {' or '.join(str(path.parent / name) for name in similar)}?"
    return f"; {path.parent} holds {', '.join(there[:_SHOWN]) or 'nothing'}{', ...' if len(there) > _SHOWN else ''}"
