"""The objects of an FBX file, their properties, and how they are connected."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.fbx.binary import MAGIC, read_binary
from shapewright.references.readers.fbx.nodes import Node, Value
from shapewright.references.readers.fbx.written import read_written
from shapewright.shapes import Floats

Key: TypeAlias = int | str
"""What names an object: its number, before version 7 its name."""

_OLDEST, _NUMBERED = 6000, 7000
_UNIQUE = ("Model", "Geometry")
_PROPERTIES = {"Properties70": ("P", 4), "Properties60": ("Property", 3)}
"""The nodes that list properties; the name of one, and where its values begin."""
_SHOWN = 60


@dataclass(frozen=True, eq=False)
class Object:
    """An object.

    Attributes:
        key: what names it.
        kind: such as Model, Geometry or Deformer.
        form: of its kind, such as Mesh.
        node: all that is written of it.
        properties: the values of each; those of the template of its kind where it has none of its own.
    """

    key: Key
    kind: str
    form: str
    node: Node
    properties: Mapping[str, Sequence[Value]]

    @property
    def name(self) -> str:
        """What a person calls it."""
        at = 1 if isinstance(self.key, int) else 0
        return self.node.text(at).partition("\0\x01")[0].rpartition("::")[2]

    def number(self, name: str, usual: float) -> float:
        """A property that is a number."""
        return float(self.vector(name, (usual,))[0])

    def vector(self, name: str, usual: Sequence[float]) -> Floats:
        """A property that is as many numbers as its usual value. Raises UnreadableError where it has other values."""
        found = self.properties.get(name)
        if not found:
            return np.array(usual)
        numbers = [value for value in found[: len(usual)] if isinstance(value, int | float)]
        if len(numbers) < len(usual):
            raise UnreadableError(f"broken: {name[:_SHOWN]} is {found[0]!r:.60}, and no {len(usual)} numbers")
        return np.array(numbers, dtype=np.float64)


@dataclass(frozen=True, eq=False)
class Document:
    """The parsed file.

    Attributes:
        objects: by their keys, in the order of the file.
        sources: the objects that are connected to each, in the order of the file.
        parents: those that each is connected to.
        of_root: the objects that the root of the scene is connected to.
        settings: the global ones.
    """

    objects: Mapping[Key, Object]
    sources: Mapping[Key, Sequence[Object]]
    parents: Mapping[Key, Sequence[Key]]
    of_root: Collection[Key]
    settings: Object

    def below(self, key: Key, kind: str, form: str | None = None) -> list[Object]:
        """The objects of a kind, and of a form of it, that are connected to an object."""
        return [each for each in self.sources.get(key, ()) if each.kind == kind and form in (None, each.form)]


def parse(data: bytes) -> Document:
    """The document of a file, binary or text. Raises UnreadableError, with the reason."""
    is_binary = data.startswith(MAGIC)
    if not is_binary and data.startswith(MAGIC[:18]):
        raise UnreadableError("broken: its header is damaged, as by a transfer as text")
    top, version = read_binary(data) if is_binary else read_written(data)
    if version < _OLDEST:
        raise UnreadableError(f"FBX of version {version / 1000:g}, which is not read; save it as FBX 2013 or newer")
    listed = top.child("Objects") or Node("Objects", (), ())
    templates = _templates(top)
    objects: dict[Key, Object] = {}
    for node in listed.below:
        found = _object(node, templates, version)
        if found is None:
            continue
        if found.kind in _UNIQUE and objects.get(found.key, found).kind in _UNIQUE and found.key in objects:
            raise UnreadableError(
                f"broken: two objects are called {str(found.key)[:_SHOWN]}, and nothing tells them apart"
            )
        objects[found.key] = found
    settings = top.child("GlobalSettings") or listed.child("GlobalSettings") or Node("GlobalSettings", (), ())
    sources, parents = defaultdict[Key, list[Object]](list), defaultdict[Key, list[Key]](list)
    of_root = set[Key]()
    connections = top.child("Connections") or Node("Connections", (), ())
    for node in connections.below:
        if node.name in ("C", "Connect") and node.text(0) == "OO" and len(node.values) >= 3:
            source, target = _key(node.values[1]), _key(node.values[2])
            if source in (0, "Model::Scene"):
                of_root.add(target)
            elif source in objects:
                sources[target].append(objects[source])
                parents[source].append(target)
    return Document(
        objects, sources, parents, of_root, Object("", "GlobalSettings", "", settings, _properties(settings))
    )


def _key(value: Value) -> Key:
    """A name as text files write it: the class, two colons, and the name."""
    if isinstance(value, str):
        name, sign, kind = value.partition("\0\x01")
        return f"{kind}::{name}" if sign else value
    return value if isinstance(value, int) else -1


def _object(node: Node, templates: Mapping[str, Mapping[str, Sequence[Value]]], version: int) -> Object | None:
    """The object that a node tells; None for one without a name."""
    at = 2 if version >= _NUMBERED and node.values and isinstance(node.values[0], int) else 1
    if not node.values:
        return None
    kind = node.name
    properties = {**templates.get(kind, {}), **_properties(node)}
    return Object(_key(node.values[0]), kind, node.text(at), node, properties)


def _properties(node: Node) -> dict[str, Sequence[Value]]:
    found: dict[str, Sequence[Value]] = {}
    for listing, (name, start) in _PROPERTIES.items():
        for each in (node.child(listing) or Node("", (), ())).children(name):
            found[each.text(0)] = each.values[start:]
    return found


def _templates(top: Node) -> dict[str, Mapping[str, Sequence[Value]]]:
    """What the properties of each kind are where an object does not tell them."""
    definitions = top.child("Definitions") or Node("", (), ())
    found: dict[str, Mapping[str, Sequence[Value]]] = {}
    for kind in definitions.children("ObjectType"):
        template = kind.child("PropertyTemplate")
        if template is not None:
            found.setdefault(kind.text(0), _properties(template))
    return found
