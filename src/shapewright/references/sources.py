"""Where references come from: a folder, a glob, a manifest or a file; each stands for a list of files."""

from __future__ import annotations

import difflib
import glob
import os
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeAlias

from shapewright.references.archives import is_archive, stem, unpacked
from shapewright.references.errors import CollectionError, UnreadableError
from shapewright.references.manifests.folder_tables import Tables
from shapewright.references.manifests.rows import Row, Switches, rows_of
from shapewright.references.orientation import Orientation
from shapewright.references.origins.lists import places_of
from shapewright.references.other_kinds import refusal
from shapewright.references.readers.formats import CLOUDS, EXTENSIONS, MESHES
from shapewright.references.readers.pictures import KINDS as PICTURES
from shapewright.references.readers.views.masks import masks_of
from shapewright.references.scans.steps import Kept, kept
from shapewright.storage import printable

Origin: TypeAlias = str | os.PathLike[str]
_SHAPENET = ("models", "model_normalized.obj")
MANIFEST = ".csv"
"""The extension of a table that lists files."""
_LOOKED_FOR = " ".join(sorted((*MESHES, ".svg", ".png"))) + ", other pictures, and points such as .las .pcd .xyz"
_SHOWN = 5
_OURS = frozenset(["iteration.json", "manifest.samples.json", "samples.json"])
"""Files of which one is in each run and in each folder of samples: their shapes are replicas, and no references."""
_IS_UNPACKED = "an archive beside a folder of its name, which is read in its place"
_AMONG_MESHES = "a drawing below a folder of meshes; load drawings for themselves, with a pattern such as '*.svg'"


@dataclass(frozen=True)
class Source:
    """A file to read.

    Attributes:
        name: of its reference, unique among all sources.
        path: the file.
        orientation: the axes that point up and to the front in it.
        archive: the archive that it was unpacked from; None for a file that lies where it was found.
        inside: its path in the archive.
        refusal: why it is not read, where that is known by its name or place; else None.
        by_author: whether the author says which axes these are. Else a format that says so itself knows better.
        keep: what is left in points, see ``scans.steps``.
        view: whether a picture is one of an object; else it is a drawing.
        mask: a picture of which part of it is the object, white where that is; None where nobody says.
        object: the object that it shows, which other pictures may show as well; None where it is alone.
        switches: what a manifest says of it alone.
    """

    name: str
    path: Path
    orientation: Orientation
    archive: Path | None = None
    inside: Path = Path()
    refusal: str | None = None
    by_author: bool = False
    keep: tuple[Kept, ...] = ()
    view: bool = False
    mask: Path | None = None
    object: str | None = None
    switches: Switches = field(default_factory=Switches)

    @property
    def place(self) -> Path:
        """Where the file is, for a person: for one of an archive the paths of the archive and inside of it."""
        return self.archive / self.inside if self.archive else self.path


def find(origins: Sequence[Origin], up: str = "y", front: str | None = None, keep: Iterable[str] = ()) -> list[Source]:
    """The files of a collection, in natural order of their names (chair2 before chair10).

    ``@list.txt`` stands for the sources that a file lists, an address such as ``s3://bucket/chairs`` for what is
    fetched from there, see ``origins``. A folder gives the files in it and in all folders below, but those that
    this program wrote there: runs and samples. Beside meshes pictures are textures and previews, and are left out.
    A ``.zip`` or ``.tar`` file, packed or not, is read as a folder. A pattern is a glob, ``**`` included. A
    ``.csv`` file is a manifest with a column ``path``, relative to the manifest, and if wanted the columns
    ``name``, ``up``, ``front``, ``object`` and those of ``Switches``; for an empty cell the argument holds. A
    ``shapewright.csv`` in a folder, with the same columns, says this of files of that folder, and lists no others.
    Hidden files are left out. Shapes of a kind that is not read have their refusal; other files are left out. A
    name is the file's stem, or the shape's id in ``<id>/models/model_normalized.obj`` (ShapeNet). Where names clash
    the path takes its place. Raises CollectionError where there is nothing to read.
    """
    default, by_author = Orientation.of(up, front), is_authors(up, front)
    if not origins:
        raise CollectionError("the list of references is empty; give it folders, patterns or files")
    sources, tables = list[Source](), Tables()
    try:
        for path in (paths := list(places_of(origins))):
            if path.suffix.lower() == MANIFEST and path.is_file():
                sources += _in_manifest(path, up, front)
            else:
                for source in _expand(path, default, alone=len(paths) == 1):
                    row, source = tables.row(source.path), replace(source, by_author=by_author)
                    sources.append(_told(source, row, up, front) if row else source)
    except OSError as error:
        raise CollectionError(f"cannot look into {error.filename}: {error.strerror}") from error
    masks = masks_of([source.path for source in sources])
    sources = [replace(one, mask=masks.get(one.path)) for one in sources if one.path not in masks.values()]
    places = [Path(printable(one.place)) for one in sources]
    names = _unique([printable(one.name) for one in sources], places)
    steps = kept(keep)
    named = (
        replace(one, name=name, keep=steps if one.switches.keep is None else one.switches.keep)
        for one, name in zip(sources, names, strict=True)
    )
    return sorted(named, key=lambda source: natural_key(source.name))


def is_authors(up: str | None, front: str | None) -> bool:
    """Whether these axes, the arguments of ``find``, are the word of an author: Y up is what nobody says."""
    return front is not None or (up or "y").strip().lower().removeprefix("+") != "y"


def natural_key(name: str) -> tuple[list[int | str], str]:
    """Sorts numbers inside names by their value, and letters without regard to case."""
    pieces = re.split(r"(\d+)", name.casefold())
    return [int(piece) if i % 2 else piece for i, piece in enumerate(pieces)], name


def _expand(path: Path, default: Orientation, alone: bool) -> list[Source]:
    """The files that one origin stands for; a missing or strange file in a list is left for its reader to report."""
    if path.is_dir():
        return _in_folder(path, default)
    if not path.exists() and glob.has_magic(str(path)):
        return _in_pattern(path, default)
    if alone and not path.exists():
        raise CollectionError(f"no such file or folder: {path}{_alternatives(path)}")
    if is_archive(path):
        found = _in_archive(path, default)
        if alone and all(one.refusal for one in found):
            raise CollectionError(f"{path}: {found[0].refusal}")
        return found
    if alone and not _is_shape(path):
        why = refusal(path)
        also = f"\n{path.name}: {why}" if why else ""
        raise CollectionError(f"{path} is not a kind of file that is read; {_LOOKED_FOR} and {MANIFEST} are{also}")
    return [Source(_stem(path), path, default)]


def _in_folder(folder: Path, default: Orientation) -> list[Source]:
    files = sorted(_walk(folder))
    found = _chosen(files, default)
    if all(source.refusal for source in found):
        reasons = "".join(f"\n{one.path.name}: {one.refusal}" for one in found[:_SHOWN])
        raise CollectionError(f"{folder} holds no shapes: looked for {_LOOKED_FOR}, found {_kinds(files)}{reasons}")
    return found


def _chosen(files: Sequence[Path], default: Orientation) -> list[Source]:
    """The shapes among files, those in archives, and with its refusal each file of shapes that is not read.

    Where there are meshes pictures are none; drawings below a folder of meshes are not read.
    """
    shapes = [path for path in files if _is_shape(path)]
    archived = [source for path in files if is_archive(path) for source in _in_archive(path, default)]
    meshes = [path for path in shapes if _is_mesh(path)]
    meshes += [source.path for source in archived if not source.refusal and _is_mesh(source.path)]
    above = min((len(path.parts) for path in meshes), default=0)
    sources: list[Source] = []
    for path in shapes:
        if not (meshes and path.suffix.lower() in PICTURES):
            drawn = bool(meshes) and not _is_mesh(path) and len(path.parts) > above
            sources.append(Source(_stem(path), path, default, refusal=_AMONG_MESHES if drawn else None))
    refused = [(path, refusal(path)) for path in files if not (_is_shape(path) or is_archive(path))]
    return sources + archived + [Source(path.name, path, default, refusal=why) for path, why in refused if why]


def _in_archive(path: Path, default: Orientation) -> list[Source]:
    """The shapes of an archive, or the archive with its refusal."""
    if (path.parent / stem(path)).is_dir():
        return [Source(path.name, path, default, refusal=_IS_UNPACKED)]
    try:
        folder = unpacked(path)
    except UnreadableError as error:
        return [Source(path.name, path, default, refusal=str(error))]
    files = sorted(_walk(folder))
    meshes = any(_is_mesh(file) for file in files)
    sources: list[Source] = []
    for file in files:
        inside = file.relative_to(folder)
        if _is_shape(file) and not (meshes and file.suffix.lower() in PICTURES):
            sources.append(Source(_stem(path / inside), file, default, path, inside))
        elif why := refusal(file):
            sources.append(Source(file.name, file, default, path, inside, why))
    return sources or [Source(path.name, path, default, refusal=f"an archive that holds no shapes: {_LOOKED_FOR}")]


def _walk(folder: Path) -> Iterator[Path]:
    """Every file below a folder; links to folders are followed, each folder is entered once."""
    entered: set[str] = set()
    for root, folders, files in os.walk(folder, onerror=_raise, followlinks=True):
        folders[:] = sorted(name for name in folders if not _is_hidden(name))
        if os.path.realpath(root) in entered:
            folders.clear()
            continue
        entered.add(os.path.realpath(root))
        if root != os.fspath(folder) and _OURS.intersection(files):
            folders.clear()
            continue
        paths = (Path(root, name) for name in files if not _is_hidden(name))
        yield from (path for path in paths if path.is_file() or (path.is_symlink() and not path.exists()))


def _raise(error: OSError) -> None:
    raise error


def _in_pattern(pattern: Path, default: Orientation) -> list[Source]:
    # Path.glob takes no absolute pattern.
    matches = [Path(match) for match in sorted(glob.glob(str(pattern), recursive=True))]  # noqa: PTH207
    files = [path for path in matches if path.is_file() and not _is_hidden(path.name)]
    found = _chosen(files, default)
    if all(source.refusal for source in found):
        kinds = _kinds(files) + ("; it matches folders: add /* to it" if len(matches) > len(files) else "")
        raise CollectionError(f"{pattern} matches no shapes: looked for {_LOOKED_FOR}, found {kinds}")
    return found


def _in_manifest(manifest: Path, up: str, front: str | None) -> list[Source]:
    sources: list[Source] = []
    for row in rows_of(manifest):
        path = manifest.parent / row.path
        sources.append(_told(Source(_stem(path), path, Orientation()), row, up, front))
    if not sources:
        raise CollectionError(f"{manifest} lists no files; give each a line with its path")
    return sources


def _told(source: Source, row: Row, up: str, front: str | None) -> Source:
    cells, said = row.cells, row.cells.get("up") or row.cells.get("front")
    try:
        orientation = Orientation.of(cells.get("up") or up, cells.get("front") or front)
    except CollectionError as error:
        raise CollectionError(f"{source.path}, as the manifest lists it: {error}") from error
    named = replace(source, name=cells.get("name") or source.name, object=cells.get("object") or None)
    return replace(named, orientation=orientation, by_author=is_authors(up, front) or bool(said), switches=row.switches)


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
    return path.suffix.lower() in (*MESHES, *CLOUDS)


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
