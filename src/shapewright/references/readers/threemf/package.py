"""A 3MF file as a ZIP archive of parts, and which of them is the model."""

from __future__ import annotations

import posixpath
import zipfile
from dataclasses import dataclass
from urllib.parse import unquote

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.text import utf8
from shapewright.references.readers.threemf.markup import outline
from shapewright.references.readers.zips import opened, unpacked

_MODEL = "/3dmodel"
"""How the types of the relationships to models end, in the format and in its draft."""
_USUAL = "/3D/3dmodel.model"


@dataclass(frozen=True, eq=False)
class Package:
    """The parts of a package.

    Attributes:
        archive: the open archive.
        entries: its entries by the names of the parts, which begin with a slash, in small letters.
        root: the name of the part with the build section.
        notes: what of the package was left out.
    """

    archive: zipfile.ZipFile
    entries: dict[str, zipfile.ZipInfo]
    root: str
    notes: tuple[str, ...] = ()

    def read(self, name: str) -> bytes:
        """The bytes of a part; names may be in any case and percent-encoded. Raises UnreadableError without one."""
        entry = self.entries.get(part_key(name)) or self.entries.get(part_key(unquote(name)))
        if entry is None:
            raise UnreadableError(f"it needs its part {name[:200]}, which is missing")
        return unpacked(self.archive, entry, name)


def unpack(data: bytes) -> Package:
    """The package in a file's bytes. Raises UnreadableError for what is no 3MF, and for a ZIP bomb."""
    archive = opened(data)
    entries = {part_key(entry.filename): entry for entry in archive.infolist()}
    models = [name for name in entries if name.endswith(".model")]
    package = Package(archive, entries, _USUAL)
    targets = _targets(package.read("/_rels/.rels")) if "/_rels/.rels" in entries else []
    root = next(iter([*targets, *(models if part_key(_USUAL) not in models else ())]), _USUAL)
    if not targets and not models:
        raise UnreadableError("a ZIP archive without a 3D model in it, so no 3MF")
    more = len(set(map(part_key, targets))) - 1
    notes = (f"{more} x model beside the first left out",) if more > 0 else ()
    return Package(archive, entries, root, notes)


def _targets(relations: bytes) -> list[str]:
    """The parts that the package names as its models."""
    found = [element.attributes for element in outline(utf8(relations)) if element.name == "Relationship"]
    return [
        posixpath.join("/", relation["Target"])
        for relation in found
        if relation.get("Type", "").lower().endswith(_MODEL)
        and relation.get("Target")
        and relation.get("TargetMode", "").lower() != "external"
    ]


def part_key(name: str) -> str:
    """The name of a part with a slash before it and in small letters, since names may be in either case."""
    return posixpath.normpath("/" + name.replace("\\", "/").lstrip("/")).lower()
