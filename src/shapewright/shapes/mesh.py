"""A triangle mesh in space, with labels, and with the rules that made it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from shapewright.shapes.arrays import Bytes, Floats, Ints, Transform, ends

if TYPE_CHECKING:
    from shapewright.shapes.soundness import Soundness


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles in space; closed or soup alike.

    Attributes:
        vertices: (V, 3) float64, Y up, front towards +Z.
        faces: (F, 3) int64, indices of vertices.
        face_labels: (F,) int64, index into label_names, -1 for a face without label; None when nothing is labelled.
        label_names: the labels.
        face_rules: (F,) int64, index into rule_names, -1 for a face that no rule of a grammar made; None when none is.
        rule_names: the rules.
        face_colours: (F, 4) uint8, sRGB and opacity; all 0 for a face without colour; None when nothing is coloured.

    Raises ValueError for arrays of another form, vertices that are not finite, or faces that point at no vertex.
    """

    vertices: Floats
    faces: Ints
    face_labels: Ints | None = None
    label_names: tuple[str, ...] = ()
    face_rules: Ints | None = None
    rule_names: tuple[str, ...] = ()
    face_colours: Bytes | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", np.ascontiguousarray(self.vertices, dtype=np.float64))
        object.__setattr__(self, "faces", np.ascontiguousarray(self.faces, dtype=np.int64))
        if self.vertices.ndim != 2 or self.vertices.shape[1] != 3:
            raise ValueError(f"vertices have the form {self.vertices.shape}, not (V, 3)")
        if self.faces.ndim != 2 or self.faces.shape[1] != 3:
            raise ValueError(f"faces have the form {self.faces.shape}, not (F, 3)")
        if not np.isfinite(self.vertices).all():
            raise ValueError("some vertices are not finite (NaN or infinity)")
        if len(self.faces) and (self.faces.min() < 0 or self.faces.max() >= len(self.vertices)):
            raise ValueError(f"faces point outside the {len(self.vertices)} vertices")
        for field in ("face_labels", "face_rules"):
            if (indices := getattr(self, field)) is not None:
                indices = np.ascontiguousarray(indices, dtype=np.int64)
                object.__setattr__(self, field, indices)
                if indices.shape != (len(self.faces),):
                    raise ValueError(f"{len(indices)} {field.replace('_', ' ')} for {len(self.faces)} faces")
        if self.face_colours is not None and self.face_colours.shape != (len(self.faces), 4):
            raise ValueError(f"face colours have the form {self.face_colours.shape}, not ({len(self.faces)}, 4)")

    @cached_property
    def bounds(self) -> Floats:
        """(2, 3): the least and the greatest corner of the vertices that faces use."""
        if not len(self.faces):
            raise ValueError("a mesh without faces has no bounds")
        used = np.zeros(len(self.vertices), dtype=bool)
        used[self.faces] = True
        return ends(self.vertices if used.all() else self.vertices[used])

    @property
    def extent(self) -> Floats:
        """(3,): size of the bounding box."""
        return np.asarray(self.bounds[1] - self.bounds[0])

    @cached_property
    def triangles(self) -> Floats:
        """(F, 3, 3): the corners of each face."""
        return np.asarray(self.vertices[self.faces])

    @property
    def labels(self) -> tuple[str | None, ...]:
        """The label of each face, None where it has none."""
        return _named(self.face_labels, self.label_names, len(self.faces))

    @property
    def rules(self) -> tuple[str | None, ...]:
        """The rule that made each face, None where there is none."""
        return _named(self.face_rules, self.rule_names, len(self.faces))

    def label(self, name: str) -> Mesh:
        """The same mesh with every face labelled ``name``."""
        return replace(self, face_labels=np.zeros(len(self.faces), dtype=np.int64), label_names=(name,))

    def remade(self, vertices: Floats, faces: Ints, origins: Ints) -> Mesh:
        """Other triangles with what is known of those faces of this mesh that they come from, origins (F,)."""
        labels, rules = (each if each is None else each[origins] for each in (self.face_labels, self.face_rules))
        colours = None if self.face_colours is None else self.face_colours[origins]
        return Mesh(vertices, faces, labels, self.label_names, rules, self.rule_names, colours)

    def transformed(self, matrix: ArrayLike) -> Mesh:
        """The mesh under a 3x3 or 4x4 matrix; faces keep their order of corners."""
        matrix = np.asarray(matrix, dtype=np.float64)
        moved = self.vertices @ matrix[:3, :3].T
        return replace(self, vertices=moved + matrix[:3, 3] if matrix.shape == (4, 4) else moved)

    def normalisation(self) -> Transform:
        """Centre of the bounding box to the origin, largest extent to 1 (LFD, "Descriptor")."""
        largest = float(self.extent.max())
        if largest <= 0.0:
            raise ValueError("a mesh of no size cannot be normalised")
        return Transform(tuple(self.bounds.mean(axis=0)), 1.0 / largest)

    def normalised(self) -> Mesh:
        return replace(self, vertices=self.normalisation().apply(self.vertices))

    def soundness(self) -> Soundness:
        """Whether the mesh is closed, manifold, oriented, free of self-intersections and slivers; and its parts."""
        from shapewright.shapes.soundness import soundness

        return soundness(self.vertices, self.faces)

    def __repr__(self) -> str:
        return f"Mesh({len(self.vertices)} vertices, {len(self.faces)} faces)"


def concatenate(meshes: list[Mesh]) -> Mesh:
    """One mesh of all triangles of several; labels, rules and colours are kept. Raises ValueError for an empty list."""
    if not meshes:
        raise ValueError("nothing to concatenate")
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    faces = [len(mesh.faces) for mesh in meshes]
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.faces + start for mesh, start in zip(meshes, starts, strict=False)]),
        *_joined([mesh.face_labels for mesh in meshes], [mesh.label_names for mesh in meshes], faces),
        *_joined([mesh.face_rules for mesh in meshes], [mesh.rule_names for mesh in meshes], faces),
        _colours(meshes),
    )


def _colours(meshes: list[Mesh]) -> Bytes | None:
    if all(mesh.face_colours is None for mesh in meshes):
        return None
    none = (np.zeros((len(mesh.faces), 4), dtype=np.uint8) for mesh in meshes)
    return np.concatenate(
        [bare if m.face_colours is None else m.face_colours for m, bare in zip(meshes, none, strict=True)]
    )


def _named(indices: Ints | None, names: tuple[str, ...], faces: int) -> tuple[str | None, ...]:
    return (None,) * faces if indices is None else tuple(names[i] if i >= 0 else None for i in indices)


def _joined(
    indices: list[Ints | None], names: list[tuple[str, ...]], faces: list[int]
) -> tuple[Ints | None, tuple[str, ...]]:
    """One row of indices into one row of names, for several: the inverse of taking them apart."""
    number = {name: i for i, name in enumerate(dict.fromkeys(name for some in names for name in some))}
    renumbered = [
        np.full(count, -1) if old is None else np.array([*(number[name] for name in some), -1], dtype=np.int64)[old]
        for old, some, count in zip(indices, names, faces, strict=True)
    ]
    return np.concatenate(renumbered) if number else None, tuple(number)
