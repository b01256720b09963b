"""A COLLADA file as a tree of elements: parsed without reading anything but the file, and searched by ids."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Any, TypeAlias
from urllib.parse import unquote

import numpy as np
from lxml import etree

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.text import numbers, utf8
from shapewright.references.readers.zips import opened, unpacked
from shapewright.shapes import Floats, Ints

Element: TypeAlias = Any
"""An element of lxml; its tag is the name without namespace."""

_UPS = {"X_UP": "x", "Y_UP": "y", "Z_UP": "z"}
_SHOWN = 60
_LARGEST = 2.0**53  # whole numbers beyond are no longer exact


@dataclass(frozen=True)
class Document:
    """The parsed file.

    Attributes:
        root: the outermost element.
        by_id: the first element of each id.
        unit: in metres.
        up: the axis that points up.
    """

    root: Element
    by_id: Mapping[str, Element]
    unit: float
    up: str

    def target(self, url: str | None, kind: str) -> Element | None:
        """The element that a URL names; None for one of another file.

        Raises UnreadableError where the file has no element of this id, or one that is not of the kind.
        """
        name = unquote((url or "").strip())
        bare = name.removeprefix("#")
        found = self.by_id.get(bare)
        if found is None and name and not name.startswith("#"):
            return None
        if found is None or found.tag != kind:
            raise UnreadableError(f"broken: it refers to the {kind} {bare[:_SHOWN]!r}, which is not there")
        return found


def parse(data: bytes) -> Document:
    """The document of a file, or of the archive that a .zae is. Raises UnreadableError, with the reason."""
    root = _tree(_of_archive(data) if data.startswith(b"PK") else data)
    if root.tag != "COLLADA":
        raise UnreadableError(f"its outermost element is <{str(root.tag)[:_SHOWN]}>, not <COLLADA>")
    by_id: dict[str, Element] = {}
    for element in root.iter("{*}*"):
        if "id" in element.attrib:
            by_id.setdefault(element.get("id"), element)
    asset = child(root, "asset")
    unit = None if asset is None else child(asset, "unit")
    up = "" if asset is None else words(child(asset, "up_axis")).strip().upper()
    if up and up not in _UPS:
        raise UnreadableError(f"broken: its up axis is {up[:_SHOWN]!r}")
    metres = _numbers("1" if unit is None else unit.get("meter", "1"))
    if len(metres) != 1 or not 0.0 < metres[0] < np.inf:
        raise UnreadableError("broken: its unit is no length")
    return Document(root, by_id, float(metres[0]), _UPS.get(up, "y"))


def child(element: Element, name: str) -> Element | None:
    """The first child of this name."""
    return next(iter(children(element, name)), None)


def children(element: Element, *names: str) -> list[Element]:
    """The children of these names."""
    return [each for each in element if each.tag in names]


def words(element: Element | None) -> str:
    """The text of an element, empty without one."""
    return "" if element is None else element.text or ""


def floats(element: Element | None) -> Floats:
    """The numbers in an element. Raises UnreadableError for a word that is none."""
    return _numbers(words(element))


def integers(element: Element | None) -> Ints:
    """The whole numbers in an element. Raises UnreadableError for any other word."""
    found = floats(element)
    if not (np.abs(found) < _LARGEST).all() or (found != np.floor(found)).any():
        raise UnreadableError("broken: an index that is no whole number")
    return found.astype(np.int64)


def _numbers(text: str) -> Floats:
    """The numbers between white space. Some programs write decimals with commas, where their language does."""
    return numbers((text if "." in text else text.replace(",", ".")).encode())


def _tree(data: bytes) -> Element:
    text = utf8(data).strip()
    if b"<!DOCTYPE" in text[:4096] or b"<!ENTITY" in text:
        raise UnreadableError(
            "it has a document type definition, which the format does not use and which can be an attack"
        )
    parser = etree.XMLParser(
        encoding="utf-8", resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True,
        huge_tree=True, recover=False,
    )  # fmt: skip
    try:
        root = etree.fromstring(text, parser)
    except etree.XMLSyntaxError as error:
        raise UnreadableError(f"broken: its XML is not well-formed ({error.msg})") from error
    for element in root.iter("{*}*"):
        if element.tag.startswith("{"):
            element.tag = element.tag.rpartition("}")[2]
    return root


def _of_archive(data: bytes) -> bytes:
    """The document that the manifest of a .zae names, else the first one in it."""
    archive = opened(data)
    entries = {entry.filename.lower(): entry for entry in archive.infolist()}
    names = [name for name in entries if name.endswith(".dae")]
    if "manifest.xml" in entries:
        named = words(_tree(unpacked(archive, entries["manifest.xml"], "manifest.xml"))).strip()
        names.insert(0, str(PurePosixPath(unquote(named).partition("#")[0].replace("\\", "/"))).lower())
    found = next((name for name in names if name in entries), None)
    if found is None:
        raise UnreadableError("a ZIP archive without a COLLADA document in it")
    return unpacked(archive, entries[found], found)
