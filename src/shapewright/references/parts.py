"""What files call the parts of their shapes: the names of nodes, objects and groups, and of materials."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from shapewright.shapes import Ints, Mesh
from shapewright.storage import printable

_UNNAMED = frozenset(["", "default", "none", "(null)", "off", "unlabelled"])
"""What programs write in the place of a name, in small letters."""
_LONGEST = 80


class PartName(NamedTuple):
    """What a file calls a part: its own name and that of its material, empty where it has none."""

    name: str = ""
    material: str = ""

    @classmethod
    def of(cls, name: object, material: object = None) -> PartName:
        """From what a file holds: text, bytes, or what is no name."""
        return cls(_word(name), _word(material))


@dataclass(frozen=True, eq=False)
class Parts:
    """Which part each of F faces, or of P polygons, belongs to.

    Attributes:
        names: what there is, each once.
        of_faces: (F,) int64, index into names.
    """

    names: tuple[PartName, ...]
    of_faces: Ints

    @classmethod
    def of(cls, runs: Iterable[tuple[PartName, int]]) -> Parts:
        """From names with the number of faces that follow one another under each."""
        number: dict[PartName, int] = {}
        indices = [(number.setdefault(name, len(number)), count) for name, count in runs if count]
        rows = np.array(indices, dtype=np.int64).reshape(-1, 2)
        return cls(tuple(number), np.repeat(rows[:, 0], rows[:, 1]))

    def repeated(self, counts: Ints) -> Parts:
        """Of faces that each polygon was cut into, counts (P,)."""
        return replace(self, of_faces=np.repeat(self.of_faces, counts))

    def labelled(self, mesh: Mesh, faces: Ints | slice = slice(None)) -> Mesh:
        """The mesh with the names as labels. faces: those of the file that the faces of the mesh are.

        A label is the name with the material in brackets, ``drawer (oak)``. What all parts have in common is left out.
        """
        one_name, one_material = (len({part[i] for part in self.names}) == 1 for i in (0, 1))
        words = [_label(part, one_name and not one_material, one_material) for part in self.names]
        names = tuple(dict.fromkeys(word for word in words if word))
        if not names:
            return mesh
        places = {word: i for i, word in enumerate(names)}
        number = np.array([places.get(word, -1) for word in words], dtype=np.int64)
        return replace(mesh, face_labels=number[self.of_faces[faces]], label_names=names)


def _label(part: PartName, without_name: bool, without_material: bool) -> str:
    name, material = "" if without_name else part.name, part.material
    if not name or not material:
        return name or material
    return name if without_material else f"{name} ({material})"


def _word(name: object) -> str:
    text = name.decode("utf-8", "replace") if isinstance(name, bytes) else name if isinstance(name, str) else ""
    text = printable(" ".join(text.split()))[:_LONGEST]
    return "" if text.lower() in _UNNAMED else text
