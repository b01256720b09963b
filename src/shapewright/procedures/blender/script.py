"""Shapes of a node group as a script for Blender: an object with the group and its values for each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from shapewright.procedures.blender.sockets import Socket

_SCRIPT = """\
# For the Text Editor of Blender, in the file that has the node group: an object for each shape.
import bpy


def add(name, values):
    group = bpy.data.node_groups[{group!r}].copy()  # each object has its own defaults, which its modifier takes
    for item in group.interface.items_tree:
        if getattr(item, "identifier", None) in values:
            item.default_value = values[item.identifier]
    thing = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    thing.modifiers.new({group!r}, "NODES").node_group = group
    bpy.context.scene.collection.objects.link(thing)


# {legend}
{calls}
"""


def script(group: str, sockets: Sequence[Socket], shapes: Mapping[str, Mapping[str, Any]]) -> str:
    """The text of the script. shapes: values of arguments by the name of the shape.

    Values become defaults of a copy of the group: how a modifier holds them differs between versions of Blender.
    """
    known = {socket.argument: socket for socket in sockets}
    legend = ", ".join(f"{socket.identifier}: {socket.name}" for socket in sockets if not socket.held)
    calls = (
        f"add({name!r}, {{{', '.join(f'{known[key].identifier!r}: {value!r}' for key, value in values.items())}}})"
        for name, values in shapes.items()
    )
    return _SCRIPT.format(group=group, legend=legend, calls="\n".join(calls))
