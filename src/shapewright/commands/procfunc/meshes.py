"""Objects of Blender as an OBJ file. ``caller.py`` loads this file in a Python that has bpy, and no shapewright."""

from __future__ import annotations

import contextlib
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

SUBDIVISIONS = 1
"""Levels at most of a Subdivision modifier that the function left unapplied. Infinigen 2 leaves 3 or 4, for pictures: a
vase has 2,000 faces with 1 level, and 16 times as many with 3."""
_KEPT = ("libraries", "screens", "window_managers", "workspaces", "scenes")
"""What Blender itself makes, and needs."""


@contextlib.contextmanager
def removed_afterwards() -> Iterator[None]:
    """Removes what is made inside: each data block makes all later work of Blender slower."""
    import bpy

    before = {name: set(blocks) for name, blocks in _blocks(bpy)}
    try:
        yield
    finally:
        bpy.data.batch_remove([block for name, blocks in _blocks(bpy) for block in set(blocks) - before[name]])


def _blocks(bpy: Any) -> Iterator[tuple[str, Any]]:
    for kind in bpy.data.bl_rna.properties:
        if kind.type == "COLLECTION" and kind.identifier not in _KEPT:
            yield kind.identifier, getattr(bpy.data, kind.identifier)


def objects_of(result: Any) -> list[Any]:
    """The objects in what a function returned: Blender's, procfunc's, nodes, and tuples, lists and dicts of these."""
    import bpy

    if isinstance(result, bpy.types.Object):
        return [result, *result.children_recursive]
    if isinstance(result, bpy.types.Collection):
        return list(result.all_objects)
    if isinstance(result, bpy.types.Mesh):
        return [bpy.data.objects.new(result.name, result)]
    if isinstance(result, dict):
        return objects_of(list(result.values()))
    if isinstance(result, (list, tuple)):
        nodes = [each for each in result if _is_node(each)]
        shown = getattr(result, "mesh", getattr(result, "geometry", nodes[0] if nodes else None))
        several = [each for each in result if not _is_node(each) or each is shown]  # the others are fields on its mesh
        found = [each for inner in several for each in objects_of(inner)]
        return list(dict.fromkeys(found))
    if _is_node(result):
        made = sys.modules["procfunc"].nodes.to_mesh_object(result).item()
        made.name = "geometry"  # instead of the name of procfunc's empty mesh
        return [made]
    package = type(result).__module__.partition(".")[0]
    return objects_of(result.item()) if package == "procfunc" and hasattr(result, "item") else []


def _is_node(value: Any) -> bool:
    return type(value).__name__ == "ProcNode"


def written(objects: list[Any], out: str) -> str:
    """The OBJ file of objects as the scene shows them: modifiers applied, in place, polygons as they are.

    Groups are the objects where there are several, and the materials where an object has several.
    """
    import bpy

    for each in objects:
        if each.name not in bpy.context.view_layer.objects:
            bpy.context.scene.collection.objects.link(each)
        for modifier in each.modifiers:
            if modifier.type == "SUBSURF":
                modifier.levels = min(modifier.levels, SUBDIVISIONS)
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    lines: list[str] = []
    count = 0
    for shown in graph.object_instances:
        owner = shown.parent if shown.is_instance else shown.object
        if owner is None or owner.original not in objects or shown.object.type not in _WITH_FACES:
            continue
        name = owner.original.name if len(objects) > 1 else ""
        mesh = shown.object.to_mesh()
        lines += _lines(mesh, shown.matrix_world, name, owner.original.name, count)
        count += len(mesh.vertices)
        shown.object.to_mesh_clear()
    Path(out).write_text("\n".join(lines) + "\n", encoding="utf-8")
    return out


_WITH_FACES = ("MESH", "CURVE", "SURFACE", "FONT", "META")


def _lines(mesh: Any, matrix: Any, name: str, usual: str, first: int) -> list[str]:
    import numpy as np

    points = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", points)
    place = np.array(matrix)
    points = points.reshape(-1, 3) @ place[:3, :3].T + place[:3, 3]
    lines = [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in points]
    way = -1 if np.linalg.det(place[:3, :3]) < 0 else 1  # what is mirrored is turned inside out
    groups: dict[int, list[str]] = {}
    for polygon in mesh.polygons:
        corners = " ".join(str(first + 1 + i) for i in list(polygon.vertices)[::way])
        groups.setdefault(polygon.material_index, []).append(f"f {corners}")
    for slot, label in _labels(mesh, sorted(groups)).items():
        label = "_".join(part for part in (name, label if len(groups) > 1 else "") if part) or usual
        lines += [f"g {re.sub('[^A-Za-z0-9_.-]', '_', label)}", *groups[slot]]
    return lines


def _labels(mesh: Any, slots: list[int]) -> dict[int, str]:
    """Names of materials by their slots, without the numbers that Blender and procfunc add to make them differ."""
    own = {slot: mesh.materials[slot] if slot < len(mesh.materials) else None for slot in slots}
    plain = {slot: re.sub(r"[._]\d+$", "", each.name) if each else "plain" for slot, each in own.items()}
    alone = list(plain.values())
    return {slot: name if alone.count(name) == 1 else f"{name}_{slot}" for slot, name in plain.items()}
