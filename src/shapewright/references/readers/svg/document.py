"""An SVG file as a tree of elements: parsed without reading anything but the file, and searched by ids."""

from __future__ import annotations

import re
import zlib
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from lxml import etree

from shapewright.references.errors import UnreadableError

Element: TypeAlias = Any
"""An element of lxml."""
_SVG = "{http://www.w3.org/2000/svg}"
_LINK = "{http://www.w3.org/1999/xlink}href"
_MOST = 256 * 2**20
"""Bytes of a compressed file, unpacked: a file of SVG of more is larger than any in use."""
_MOVING = {"animate", "animateTransform", "animateMotion", "animateColor", "set"}


@dataclass(frozen=True)
class Document:
    """The parsed file.

    Attributes:
        root: the outermost element, an ``svg``.
        by_id: the first element of each id.
        styles: its ``style`` elements, in order.
        count: of its elements.
        has_context: whether it speaks of ``context-fill`` or ``context-stroke``.
        notes: how often each thing that is not followed is in it, by name.
    """

    root: Element
    by_id: Mapping[str, Element]
    styles: tuple[Element, ...]
    count: int
    has_context: bool
    notes: Mapping[str, int]


def parse(data: bytes) -> Document:
    """The document of a file, which may be compressed with gzip. Raises UnreadableError, with the reason.

    Entities of the file itself are put in their place, within the limits of libxml2. Nothing outside it is read.
    """
    data = _unpacked(data)
    root = _tree(data)
    if name(root) != "svg":
        raise UnreadableError(f"its outermost element is <{etree.QName(root).localname}>, not <svg>")
    by_id: dict[str, Element] = {}
    styles: list[Element] = []
    notes: Counter[str] = Counter()
    for element in root.iter():
        if not isinstance(element.tag, str):
            notes["external entity"] += 1
            continue
        by_id.setdefault(element.get("id", ""), element)
        kind = name(element)
        if kind == "style":
            styles.append(element)
        elif kind == "script":
            notes["script"] += 1
        elif kind in _MOVING:
            notes["animation"] += 1
    by_id.pop("", None)
    if re.search(rb"<\?xml-stylesheet\s", data[:4096]):
        notes["style sheet of another file"] += 1
    return Document(root, by_id, tuple(styles), sum(1 for _ in root.iter()), b"context-" in data, notes)


def name(element: Element) -> str:
    """The name of an element of SVG; "" for one of another language. A file without namespaces is taken for SVG."""
    tag = element.tag
    if not isinstance(tag, str):
        return ""
    if tag.startswith(_SVG):
        return tag[len(_SVG) :]
    return "" if tag.startswith("{") else tag


def link(element: Element) -> str | None:
    """Where an element refers to, by ``href`` or ``xlink:href``."""
    found: str | None = element.get("href")
    return element.get(_LINK, element.get("xlink:href")) if found is None else found


def _unpacked(data: bytes) -> bytes:
    if not data.startswith(b"\x1f\x8b"):
        return data
    try:
        unpacked = zlib.decompressobj(wbits=31).decompress(data, _MOST)
    except zlib.error as error:
        raise UnreadableError(f"broken: its compression: {error}") from error
    if len(unpacked) == _MOST:
        raise UnreadableError(f"unpacked it is larger than {_MOST >> 20} MiB")
    return unpacked


def _tree(data: bytes) -> Element:
    options: dict[str, Any] = {
        "resolve_entities": "internal",
        "no_network": True,
        "remove_comments": True,
        "remove_pis": True,
        "huge_tree": b"<!ENTITY" not in data,  # pictures may be long, entities may not grow without end
    }
    data = data.lstrip() if data[:1].isspace() else data
    parser = etree.XMLParser(**options)
    try:
        return etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        # The parser's own log: that of the error holds errors of earlier files, too.
        if {entry.domain_name for entry in parser.error_log if entry.level_name != "WARNING"} == {"NAMESPACE"}:
            return etree.fromstring(data, etree.XMLParser(recover=True, **options))
        raise UnreadableError(f"broken: no XML: {error.msg}") from error
