"""A solid: a closed volume with labelled parts, its moves, booleans and deformations."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from manifold3d import Error, Manifold, Mesh64, OpType

from shapewright.modelling import arguments, deformation, verbs
from shapewright.modelling.arguments import ORIGIN, Axis, Direction, Vector
from shapewright.modelling.curves import TOLERANCE
from shapewright.modelling.deformation import Deformation
from shapewright.modelling.solid.alignment import aligned
from shapewright.modelling.solid.originals import given_ids, has_ids, manifold_of, owners_of, rule_ids, triangles
from shapewright.shapes import Floats, Ints, Mesh
from shapewright.shapes.slivers import SLIVER, has_slivers, heights, without_slivers


@dataclass(frozen=True, slots=True, eq=False)
class Solid:
    """A closed volume, possibly empty, whose faces know the label of the part that they came from.

    Attributes:
        manifold: the geometry; wrap a manifold3d.Manifold of your own as ``Solid(manifold)``.
        labels: the label of each original of manifold3d (the ids in ``run_original_id``) that has one.
        split: gives the solids that it was united from; None where it is of one piece.
        rules: the rule of a split grammar that made an original, or where several did those with a face id.
    """

    manifold: Manifold
    labels: Mapping[int, str] = field(default_factory=dict)
    split: Callable[[], tuple[Solid, ...]] | None = field(default=None, repr=False)
    rules: Mapping[int, str] = field(default_factory=dict, repr=False)

    @property
    def pieces(self) -> tuple[Solid, ...]:
        """The solids that it was united from, moved, cut and deformed as the whole was since."""
        return self.split() if self.split else (self,)

    @property
    def label_names(self) -> tuple[str, ...]:
        """The labels of its pieces."""
        return tuple(dict.fromkeys(self.labels.values()))

    def part(self, name: str) -> Solid:
        """Its pieces that bear a label, whole, not only what of them can be seen: ``table.part("top").bounds``.

        Raises ValueError when there is none.
        """
        found = [piece for piece in self.pieces if name in piece.labels.values()]
        if not found:
            labels = ", ".join(self.label_names) or "none"
            raise ValueError(f"part: no piece is labelled {name!r}; the labels are: {labels}")
        return union(*found)

    def without(self, *names: str) -> Solid:
        """The solid without the pieces that bear these labels and no other; empty when nothing is left."""
        kept = [piece for piece in self.pieces if not piece.labels or set(piece.labels.values()) - set(names)]
        return union(*kept) if kept else Solid(Manifold())

    def label(self, name: str) -> Solid:
        """The same solid as one part called ``name``; it replaces the labels it had."""
        original = self.manifold.as_original()
        return Solid(original, {original.original_id(): name})

    def __or__(self, other: Solid) -> Solid:
        """Union."""
        return union(self, other) if isinstance(other, Solid) else NotImplemented

    def __and__(self, other: Solid) -> Solid:
        """Intersection."""
        return self._joined(other, Manifold.__xor__, -1, lambda piece: piece & other)

    def __sub__(self, other: Solid) -> Solid:
        """Difference; the faces of a cut bear the label of what cut them."""
        return self._joined(other, Manifold.__sub__, 1, lambda piece: piece - other)

    def translate(self, by: Vector) -> Solid:
        step = arguments.vector("translate", "by", by)
        return self._moved(self.manifold.translate(step), lambda piece: piece.translate(step))

    def rotate(self, degrees: float, axis: Axis = "y", about: Vector = ORIGIN) -> Solid:
        turn, (x, y, z) = arguments.number("rotate", "degrees", degrees), _unit("rotate", axis)
        return self._about("rotate", about, lambda manifold: manifold.rotate((turn * x, turn * y, turn * z)))

    def scale(self, factor: float | Vector, about: Vector = ORIGIN) -> Solid:
        """Larger or smaller by a positive factor, or by one along each axis."""
        factors = arguments.size("scale", factor, "factor")
        return self._about("scale", about, lambda manifold: manifold.scale(factors))

    def fit(self, size: Vector, at: Vector = ORIGIN) -> Solid:
        """The same solid, stretched along each axis to fill a size, with its middle moved to ``at``."""
        extents, bounds = arguments.size("fit", size), self.bounds
        low, high = bounds
        if not (high > low).all():
            raise ValueError("fit: the solid is empty")
        x, y, z = (extent / reach for extent, reach in zip(extents, high - low, strict=True))
        return self.translate(-(low + high) / 2.0).scale((x, y, z)).translate(at)

    def mirror(self, axis: Axis, keep: bool = False, about: Vector = ORIGIN) -> Solid:
        """The mirror image along an axis; ``keep`` unites it with the original."""
        normal = _unit("mirror", axis)
        image = self._about("mirror", about, lambda manifold: manifold.mirror(normal))
        return self | image if keep else image

    def array(self, count: int, step: Vector) -> Solid:
        """The union of ``count`` copies, each ``step`` further than the one before, from where this one is."""
        x, y, z = arguments.vector("array", "step", step)
        return union(*(self.translate((i * x, i * y, i * z)) for i in range(arguments.count("array", count, 1))))

    def polar_array(self, count: int, axis: Axis = "y", about: Vector = ORIGIN) -> Solid:
        """The union of ``count`` copies spread evenly around an axis, the first of them where this one is."""
        number = arguments.count("polar_array", count, 1)
        return union(*(self.rotate(360 * i / number, axis, about) for i in range(number)))

    taper = verbs.taper
    profile = verbs.profile
    path = verbs.path
    twist = verbs.twist
    bend = verbs.bend

    def bulge(self, height: float, face: Direction = "y", tolerance: float = TOLERANCE) -> Solid:
        """The side that faces a direction, pushed out in the middle by ``height``; negative for in."""
        return self._deformed(verbs.bulge(self._domain, height, face), tolerance)

    def deform(self, function: Callable[[Floats], Floats], tolerance: float = TOLERANCE) -> Solid:
        """Every point moved by a function from points (N, 3) to points (N, 3), which must not fold space."""
        return self._deformed(deformation.Free(function, ORIGIN, (1, 1, 1)), tolerance)

    def deformed(self, deformations: Sequence[Deformation], tolerance: float) -> Solid:
        """The solid after all deformations, the first first; tolerance: how far facets may be off, a length."""
        from shapewright.modelling import facets  # compiled code, which takes a while to load

        mesh = self.manifold.to_mesh64()
        if not len(mesh.tri_verts):
            return self
        corners, owners = mesh.tri_verts.astype(np.int64), owners_of(mesh)
        surface = facets.Surface.of_triangles(mesh.vert_properties[:, :3], corners, np.arange(len(corners)))
        surface = facets.deformed(surface, deformations, tolerance)
        faces, origins = surface.triangles()
        face_ids = given_ids(mesh)[origins] if has_ids(self.rules) else None
        made = manifold_of(surface.points, faces, owners[origins], mesh.run_original_id, face_ids)
        return self._moved(made, lambda piece: piece.deformed(deformations, tolerance)).simplified()

    def simplified(self) -> Solid:
        """The solid without points that its shape does not need, within a millionth of its largest extent."""
        if self.checked().manifold.is_empty():
            return self
        return replace(self, manifold=self.manifold.simplify(SLIVER * self._extent))

    def mesh(self) -> Mesh:
        """Closed triangles, wound counter-clockwise seen from outside, with the labels; without faces if empty.

        Edges and heights of triangles below a millionth of the largest extent are removed.
        """
        if self.checked().manifold.is_empty():
            return Mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
        mesh, least = triangles(self.manifold, self.labels, self.rules), SLIVER * self._extent
        if not has_slivers(mesh.triangles, least):
            return mesh
        mesh = self._mended(least)  # booleans of flush faces leave triangles without area
        if not (heights(mesh.triangles) < least).any():
            return mesh
        # Those that stay lie between ribbons hardly higher than themselves, which have to go with them.
        coarser = (self._mended(times * least) for times in (10.0, 100.0))
        return next((mended for mended in coarser if mended.soundness().sound), mesh)

    def _mended(self, least: float) -> Mesh:
        """The mesh without edges, and as far as possible without triangles' heights, below ``least``."""
        mesh = triangles(self.manifold.simplify(least), self.labels, self.rules)
        return mesh.remade(*without_slivers(mesh.vertices, mesh.faces, np.arange(len(mesh.faces)), least))

    def checked(self) -> Solid:
        """The solid itself. Raises ValueError when manifold3d could not make it."""
        if self.manifold.status() != Error.NoError:
            raise ValueError(f"the solid has no geometry: manifold3d reports {self.manifold.status().name}")
        return self

    @property
    def volume(self) -> float:
        return float(self.manifold.volume())

    @property
    def bounds(self) -> Floats:
        """(2, 3): the least and the greatest corner. Raises ValueError for an empty solid."""
        if self.manifold.is_empty():
            raise ValueError("an empty solid has no bounds")
        return np.array(self.manifold.bounding_box(), dtype=np.float64).reshape(2, 3)

    @property
    def _extent(self) -> float:
        return float(np.ptp(self.bounds, axis=0).max())

    def _about(self, function: str, about: Vector, move: Callable[[Manifold], Manifold]) -> Solid:
        x, y, z = arguments.vector(function, "about", about)
        centred = x == y == z == 0.0
        made = move(self.manifold) if centred else move(self.manifold.translate((-x, -y, -z))).translate((x, y, z))
        return self._moved(made, lambda piece: piece._about(function, about, move))

    def _joined(
        self, other: Solid, boolean: Callable[..., Manifold], facing: int, change: Callable[[Solid], Solid]
    ) -> Solid:
        """What a boolean makes of it and another. change: what makes the same of a piece of it."""
        if not isinstance(other, Solid):
            return NotImplemented
        rules = {**self.rules, **other.rules}
        made = boolean(*aligned((self.manifold, other.manifold), facing, has_ids(rules)))
        return replace(self._moved(made, change), labels={**self.labels, **other.labels}, rules=rules)

    def _moved(self, manifold: Manifold, change: Callable[[Solid], Solid]) -> Solid:
        """The same solid with another manifold. change: what makes the same of a piece, when pieces are asked for."""
        pieces = (lambda: tuple(change(piece) for piece in self.pieces)) if self.split else None
        return Solid(manifold, self.labels, pieces, self.rules)

    @property
    def _domain(self) -> deformation.Domain:
        low, high = (tuple(corner) for corner in self.bounds.tolist())
        return deformation.Domain(low, high)

    def _deformed(self, by: Deformation, tolerance: float) -> Solid:
        if isinstance(by, deformation.Bend) and by.degrees == 0.0:
            return self
        return self.deformed((by,), arguments.positive("deform", "tolerance", tolerance) * self._extent)

    def __repr__(self) -> str:
        return f"Solid({', '.join([f'{self.manifold.num_tri()} triangles', *self.label_names])})"


def union(*solids: Solid) -> Solid:
    """All of them as one. Raises ValueError when there is none."""
    if not solids:
        raise ValueError("union: there is nothing to unite")
    if len(solids) == 1:
        return solids[0]
    labels = {original: name for solid in solids for original, name in solid.labels.items()}
    rules = {key: name for solid in solids for key, name in solid.rules.items()}
    made = Manifold.batch_boolean(aligned([solid.manifold for solid in solids], ids=has_ids(rules)), OpType.Add)
    return Solid(made, labels, lambda: tuple(piece for solid in solids for piece in solid.pieces), rules)


def hull(*solids: Solid) -> Solid:
    """The convex hull of all of them, as one part without labels. Raises ValueError when there is none."""
    if not solids:
        raise ValueError("hull: there is nothing to wrap")
    return Solid(Manifold.batch_hull([solid.manifold for solid in solids]))


def solid_of(points: Floats, faces: Ints) -> Solid:
    """The solid in a closed surface, whichever way it is wound. Raises ValueError when it is not closed."""
    corners = points[faces] - points.mean(axis=0)
    if np.einsum("fd,fd->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) < 0.0:
        faces = faces[:, ::-1]
    mesh = Mesh64(np.ascontiguousarray(points), np.ascontiguousarray(faces, dtype=np.uint64))
    return Solid(Manifold(mesh)).checked()


def labelled(mesh: Mesh) -> Solid:
    """The solid in a closed surface wound outwards, every face of which has a label, with its labels and rules."""
    assert mesh.face_labels is not None
    first = Manifold.reserve_ids(len(mesh.label_names))
    originals = range(first, first + len(mesh.label_names))
    rules, face_ids = rule_ids(mesh, originals)
    manifold = manifold_of(mesh.vertices, mesh.faces, mesh.face_labels, originals, face_ids)
    return Solid(manifold, dict(zip(originals, mesh.label_names, strict=True)), rules=rules).checked()


def _unit(function: str, name: str) -> tuple[float, float, float]:
    index = arguments.axis(function, name)
    return float(index == 0), float(index == 1), float(index == 2)
