"""The elements of a part's XML, as far as this reader knows their namespaces.

Namespaces are resolved here and not by the parser, since well-known files use prefixes that they do not declare.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any
from xml.parsers import expat

from shapewright.references.errors import UnreadableError

_MOST = 200_000
"""Elements outside of meshes, which have arrays."""


@dataclass(frozen=True, eq=False)
class Element:
    """The start of an element.

    Attributes:
        depth: 0 for the root.
        space: its namespace, empty without one; the prefix and a colon where that is not declared.
        name: its name without prefix.
        attributes: by their names without prefix; those that have none come first.
        prefixes: the namespaces by prefixes that hold in it.
    """

    depth: int
    space: str
    name: str
    attributes: dict[str, str]
    prefixes: dict[str, str]


def outline(text: bytes) -> list[Element]:
    """The elements of an XML text in UTF-8 in their order, without those below elements of another namespace.

    Raises UnreadableError for broken XML, for a document type definition, and for too many elements.
    """
    elements: list[Element] = []
    scopes: list[dict[str, str]] = [{"": ""}]
    foreign = 0

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal foreign
        prefixed = [key for key in attributes if ":" in key or key == "xmlns"]
        declared = {key[6:]: attributes[key] for key in prefixed if key.startswith("xmlns")}
        scopes.append(scopes[-1] | declared if declared else scopes[-1])
        if foreign:
            foreign += 1
            return
        prefix, _, name = tag.rpartition(":")
        space = scopes[-1].get(prefix, f"{prefix}:")
        if prefixed:
            bare = {key: value for key, value in attributes.items() if key not in prefixed}
            attributes = {key.rpartition(":")[2]: attributes[key] for key in prefixed} | bare
        elements.append(Element(len(scopes) - 2, space, name, attributes, scopes[-1]))
        foreign = int(space != elements[0].space)
        if len(elements) > _MOST:
            raise UnreadableError(f"more than {_MOST:,} elements outside of meshes")

    def end(_: str) -> None:
        nonlocal foreign
        scopes.pop()
        foreign = max(foreign - 1, 0)

    def refuse(*_: Any) -> None:
        raise UnreadableError("it has a document type definition, which the format forbids and which can be an attack")

    parser = expat.ParserCreate("utf-8")
    parser.StartElementHandler, parser.EndElementHandler, parser.StartDoctypeDeclHandler = start, end, refuse
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        raise UnreadableError(f"broken: its XML is not well-formed ({error})") from error
    return elements
