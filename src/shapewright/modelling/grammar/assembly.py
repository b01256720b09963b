"""From the finished boxes of a derivation to a solid or a mesh."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from manifold3d import Manifold

from shapewright.modelling.arguments import SIDES
from shapewright.modelling.facets import Surface, deformed
from shapewright.modelling.grammar.boxes import Box
from shapewright.modelling.grammar.expansion import Node
from shapewright.modelling.grammar.forms import Fill, Round
from shapewright.modelling.grammar.grid_union import unite
from shapewright.modelling.solid.originals import owners_of
from shapewright.modelling.solid.sections import without_repeats
from shapewright.modelling.solid.solid import Solid, labelled, union
from shapewright.shapes import Floats, Ints, Mesh, concatenate

_CORNERS = np.array([(i >> 2 & 1, i >> 1 & 1, i & 1) for i in range(8)], dtype=bool)
_QUADS = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
_TRIANGLES = _QUADS[:, [0, 1, 2, 0, 2, 3]].reshape(12, 3)


def mesh(leaves: Sequence[Node], tolerance: float) -> Mesh:
    """The union of all as a mesh, deformed group by group, whose faces know their labels and rules.

    tolerance: how far facets may be from the smooth shape, a length.
    """
    plain = all(_is_plain(leaf.box) and not leaf.box.groups and not leaf.box.is_void for leaf in leaves)
    return (_united(leaves) if plain else None) or joined(leaves, tolerance).mesh()


def joined(leaves: Sequence[Node], tolerance: float) -> Solid:
    """The same as a solid."""
    return _join(leaves, 0, tolerance)[0] or Solid(Manifold())


def apart(leaves: Sequence[Node], tolerance: float) -> Mesh:
    """Every box's own closed surface, without any union. Raises ValueError where there are voids to be cut."""
    if any(leaf.box.is_void for leaf in leaves):
        raise ValueError("voids can only be cut out when boxes are joined")
    plain = [leaf for leaf in leaves if _is_plain(leaf.box) and not leaf.box.groups]
    meshes = [_boxes(plain)] if plain else []
    for leaf in leaves:
        if leaf.box.groups or not _is_plain(leaf.box):
            surface, names = _surface(leaf, tolerance)
            for deformations in (leaf.box.deformations, *(group.deformations for group in reversed(leaf.box.groups))):
                surface = deformed(surface, deformations, tolerance)
            meshes.append(_made_by(leaf, surface.points, *surface.triangles(), names))
    return concatenate(meshes)


def _join(leaves: Sequence[Node], depth: int, tolerance: float) -> tuple[Solid | None, Solid | None]:
    """The union of leaves that share their first ``depth`` groups, and the union of the voids among them."""
    here = [leaf for leaf in leaves if len(leaf.box.groups) == depth]
    inner: dict[object, list[Node]] = {}
    for leaf in leaves:
        if len(leaf.box.groups) > depth:
            inner.setdefault(leaf.box.groups[depth], []).append(leaf)
    solids = _solids([leaf for leaf in here if not leaf.box.is_void], tolerance)
    voids = _solids([leaf for leaf in here if leaf.box.is_void], tolerance)
    for members in inner.values():
        group = members[0].box.groups[depth]
        if bent := _bent(members, depth, tolerance):
            solids.append(bent)
            continue
        solid, void = _join(members, depth + 1, tolerance)
        if group.deformations:
            solid = solid.deformed(group.deformations, tolerance) if solid else None
            void = void.deformed(group.deformations, tolerance) if void else None
        if group.scope:
            solid, void = solid - void if solid and void else solid, None
        solids += [solid] if solid else []
        voids += [void] if void else []
    return union(*solids) if solids else None, union(*voids) if voids else None


def _bent(leaves: Sequence[Node], depth: int, tolerance: float) -> Solid | None:
    """A group of plain boxes united and deformed without booleans, if it is one."""
    plain = all(len(leaf.box.groups) == depth + 1 and _is_plain(leaf.box) and not leaf.box.is_void for leaf in leaves)
    united = _united(leaves) if plain else None
    if not united:
        return None
    surface = Surface.of_triangles(united.vertices, united.faces, np.arange(len(united.faces)))
    bent = deformed(surface, leaves[0].box.groups[depth].deformations, tolerance)
    return _solid(united.remade(bent.points, *bent.triangles()), len(surface.points))


def _solid(mesh: Mesh, points: int) -> Solid:
    """The solid in a surface, without needless cuts. points: how many the surface had before it was deformed."""
    solid = labelled(mesh)
    return solid.simplified() if len(mesh.vertices) > points else solid


def _solids(leaves: Sequence[Node], tolerance: float) -> list[Solid]:
    """The plain ones among leaves as one solid, if they can be stitched, and each of the others as its own."""
    plain = [leaf for leaf in leaves if _is_plain(leaf.box)]
    united = _united(plain) if len(plain) > 1 else None
    if not united:
        return [_leaf_solid(leaf, tolerance) for leaf in leaves]
    others = [_leaf_solid(leaf, tolerance) for leaf in leaves if not _is_plain(leaf.box)]
    return [labelled(united), *others]  # in this order, in which the originals of manifold3d are numbered


def _united(leaves: Sequence[Node]) -> Mesh | None:
    """The union of plain boxes, if it can be stitched without booleans."""
    united = unite(*_ends(leaves), _numbered([leaf.label for leaf in leaves])[0])
    return _of_leaves(leaves, *united) if united else None


def _of_leaves(leaves: Sequence[Node], points: Floats, faces: Ints, boxes: Ints) -> Mesh:
    """The mesh of these points and faces, which knows its labels and rules. boxes: (F,), the leaf of each face."""
    owners, labels = _numbered([leaf.label for leaf in leaves])
    makers, rules = _numbered([leaf.made_by for leaf in leaves])
    return Mesh(points, faces, owners[boxes], labels, makers[boxes], rules)


def _numbered(names: Sequence[str]) -> tuple[Ints, tuple[str, ...]]:
    """Indices (N,) into different names, and these."""
    different = {name: i for i, name in enumerate(dict.fromkeys(names))}
    return np.array([different[name] for name in names]), tuple(different)


def _made_by(leaf: Node, points: Floats, faces: Ints, owners: Ints, names: tuple[str, ...]) -> Mesh:
    """The triangles of a leaf. owners: (F,), indices of names."""
    return Mesh(points, faces, owners, names, np.zeros(len(faces), dtype=np.int64), (leaf.made_by,))


def _leaf_solid(leaf: Node, tolerance: float) -> Solid:
    box = leaf.box
    if isinstance(box.form, Fill):
        solid = _filled(leaf, box.form)
        return solid.deformed(box.deformations, tolerance) if box.deformations else solid
    if _is_plain(box):
        return labelled(_boxes([leaf]))
    surface, names = _surface(leaf, tolerance)
    bent = deformed(surface, box.deformations, tolerance)
    return _solid(_made_by(leaf, bent.points, *bent.triangles(), names), len(surface.points))


def _surface(leaf: Node, tolerance: float) -> tuple[Surface, tuple[str, ...]]:
    """The surface of a leaf before its own deformations, and the labels that its owners stand for."""
    box, name = leaf.box, leaf.label
    if isinstance(box.form, Fill):
        mesh = _filled(leaf, box.form).mesh()
        assert mesh.face_labels is not None
        return Surface.of_triangles(mesh.vertices, mesh.faces, mesh.face_labels), mesh.label_names
    surface = _rounded(box, box.form, tolerance) if box.form else _plain(leaf)
    sides = dict(box.names)
    names = tuple(dict.fromkeys([name, *(label for side, label in sides.items() if side)]))
    owners = np.array([names.index(sides.get(side, name)) for side in SIDES])
    return replace(surface, owners=owners[surface.owners]), names


def _plain(leaf: Node) -> Surface:
    owners = np.array([_side_towards(leaf.box, axis, sign) for axis in range(3) for sign in (-1, 1)])
    return Surface(_corner_points([leaf])[0], _QUADS.ravel(), np.arange(0, 25, 4), owners)


def _rounded(box: Box, form: Round, tolerance: float) -> Surface:
    """A prism whose section is a rectangle with round corners, or an ellipse."""
    u, v = (d for d in range(3) if d != form.axis)
    half = np.array([box.size[u], box.size[v]]) / 2.0
    radii = half if form.radius is None else np.full(2, form.radius)
    reach = 2.0 * math.acos(max(1.0 - tolerance / radii.max(), 0.0))
    steps = max(math.ceil(math.pi / 2.0 / reach), 2)
    turn = np.linspace(0.0, math.pi / 2.0, steps + 1)
    quarter = half - radii + radii * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    quarter[0, 0], quarter[-1, 1] = half
    signs = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)])
    ring = np.concatenate([sign * (quarter if sign.prod() > 0 else quarter[::-1]) for sign in signs])
    low, high = np.array([box.low[u], box.low[v]]), np.array([box.high[u], box.high[v]])
    ring = np.where(ring == half, high, np.where(ring == -half, low, (low + high) / 2.0 + ring))
    ring = without_repeats(ring if form.axis != 1 else ring[::-1])  # x and z, seen from above, turn the other way
    count = len(ring)
    points = np.empty((2, count, 3))
    points[..., [u, v]] = ring
    points[:, :, form.axis] = [[box.low[form.axis]], [box.high[form.axis]]]
    here = np.arange(count)
    after = np.roll(here, -1)
    sides = np.stack([here, after, after + count, here + count], axis=1)
    corners = np.concatenate([sides.ravel(), here[::-1], here + count])
    normals = ring[after] - ring[here]
    normals = np.stack([normals[:, 1], -normals[:, 0]], axis=1) * (1.0 if form.axis != 1 else -1.0)
    widest = np.abs(normals).argmax(axis=1)
    owners = [_side_towards(box, (u, v)[d], int(np.sign(normals[i, d]))) for i, d in enumerate(widest)]
    owners += [_side_towards(box, form.axis, -1), _side_towards(box, form.axis, 1)]
    starts = np.concatenate([np.arange(0, 4 * count, 4), [4 * count, 5 * count, 6 * count]])
    return Surface(points.reshape(-1, 3), corners, starts, np.array(owners))


def _side_towards(box: Box, axis: int, sign: int) -> int:
    """The index of the side of a box that faces along an axis of space, or against it."""
    return 2 * axis + (sign * box.facing[axis] > 0)


def _filled(leaf: Node, form: Fill) -> Solid:
    box = leaf.box
    low, high = np.array(box.low), np.array(box.high)
    solid = form.make(tuple(high - low), **dict(form.arguments))
    for axis, facing in zip("xyz", box.facing, strict=True):
        if facing < 0:
            solid = solid.mirror(axis)  # type: ignore[arg-type]
    solid = solid.translate((low + high) / 2.0)
    if not solid.labels or dict(box.names).get(None):
        solid = solid.label(leaf.label)
        return replace(solid, rules=dict.fromkeys(solid.labels, leaf.made_by))
    mesh = solid.manifold.to_mesh64()
    names = tuple(solid.labels.get(original, leaf.label) for original in mesh.run_original_id)
    points, faces = mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64)
    return labelled(_made_by(leaf, points, faces, owners_of(mesh), names))


def _boxes(leaves: Sequence[Node]) -> Mesh:
    """The surfaces of plain boxes."""
    numbers = np.arange(len(leaves))
    faces = _TRIANGLES + 8 * numbers[:, None, None]
    return _of_leaves(leaves, _corner_points(leaves).reshape(-1, 3), faces.reshape(-1, 3), np.repeat(numbers, 12))


def _corner_points(leaves: Sequence[Node]) -> Floats:
    """(B, 8, 3)"""
    low, high = _ends(leaves)
    return np.where(_CORNERS, high[:, None], low[:, None])


def _ends(leaves: Sequence[Node]) -> tuple[Floats, Floats]:
    """The least and the greatest corners (B, 3)."""
    return np.array([leaf.box.low for leaf in leaves]), np.array([leaf.box.high for leaf in leaves])


def _is_plain(box: Box) -> bool:
    return not (box.form or box.deformations or any(side for side, _ in box.names))
