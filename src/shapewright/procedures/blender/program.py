"""The program that runs in Blender's Python: it opens a .blend file once, and builds shapes of its node groups.

It is run as a script, by a Python that has ``bpy`` or by Blender itself, version 4.2 and later. So it imports the
standard library, numpy and bpy alone. Requests come on standard input, answers go to what was standard output: four
bytes with the length, then JSON; after an answer's JSON the arrays that it lists. What Blender prints goes to standard
error.
"""

from __future__ import annotations

import ast
import contextlib
import ctypes
import json
import os
import queue
import signal
import struct
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO, Any

HELLO = b"\0shapewright\0"
"""What the program writes first: Blender may have printed before."""
_BY_FILE = {"object", "material", "collection", "image", "texture"}
"""Kinds of sockets whose values are data-blocks. An object of the file that uses the group says which."""
_BUILT_IN = {"sharp_face", "freestyle_face"}
"""Boolean attributes of faces that Blender makes itself."""
_OLDEST = (4, 2, 0)
"""The oldest version that was tried."""


def main() -> None:
    """Answer requests until standard input ends, or the process that asks."""
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    waiting: queue.SimpleQueue[dict[str, Any]] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(requests, waiting), daemon=True).start()
    _end_with_parent()
    answers.write(HELLO)
    _run_on(one=True)
    file: File | None = None
    while True:
        request = waiting.get()
        answer, arrays = dict[str, Any](), dict[str, Any]()
        try:
            if "open" in request:
                file = File(request["open"])
                answer = file.inside
            else:
                assert file is not None
                bench = file.bench(request["group"])
                if "memory" in request:
                    _limit_memory(request["memory"])
                    answer, arrays = bench.built(request["values"])
                else:
                    answer = {"idle": bench.idle(request["values"])}
        except ModuleNotFoundError as error:
            answer = {"lost": "module", "name": error.name}
        except MemoryError:
            answer = {"lost": "memory"}
        except Exception as error:  # noqa: BLE001 - told to the process that asks
            answer = {"error": f"{type(error).__name__}: {error}"}
        _send(answers, answer, arrays)
        if "memory" in request:
            _run_on(one=False)


class File:
    """An open .blend file.

    inside: what is in it. ``groups``: its geometry node groups, each with name, sockets, and whether it is no part of
        another one; ``scale``: metres of its unit; ``facts``: what the text called "shapewright" says; ``files``:
        other .blend files that it links.
    """

    def __init__(self, path: str) -> None:
        import bpy

        if bpy.app.version < _OLDEST:
            raise RuntimeError(f"this is version {bpy.app.version_string}; 4.2 or later is needed")
        self.bpy: Any = bpy
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.wm.open_mainfile(filepath=path, load_ui=False, use_scripts=False)
        trees = [tree for tree in bpy.data.node_groups if tree.bl_idname == "GeometryNodeTree"]
        inner = {node.node_tree for tree in trees for node in tree.nodes if getattr(node, "node_tree", None)}
        said = bpy.data.texts.get("shapewright")
        self.inside = {
            "groups": [
                {"name": tree.name, "outer": tree not in inner, "sockets": list(_sockets(tree))}
                for tree in trees
                if any(item.socket_type == "NodeSocketGeometry" for item in _items(tree, "OUTPUT"))
            ],
            "scale": _short(bpy.context.scene.unit_settings.scale_length),
            "facts": said.as_string() if said else "",
            "files": [bpy.path.abspath(library.filepath) for library in bpy.data.libraries],
        }
        self._open: dict[str, _Bench] = {}

    def bench(self, name: str) -> _Bench:
        """The place where a group is built."""
        if name not in self._open:
            self._open[name] = _Bench(self.bpy, self.bpy.data.node_groups[name])
        return self._open[name]


class _Bench:
    """An object of a scene of its own, on which a group builds: of the file's scenes nothing is evaluated.

    Values are set at a node that holds the group, since how a modifier holds them differs between versions. Instances
    are realized behind it. Each evaluation takes the place of the one before, so nothing adds up in the file.
    """

    def __init__(self, bpy: Any, group: Any) -> None:
        modifier = next(
            (m for o in bpy.data.objects for m in o.modifiers if getattr(m, "node_group", None) == group), None
        )
        tree = bpy.data.node_groups.new("shapewright", "GeometryNodeTree")
        for way in ("INPUT", "OUTPUT"):
            tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
        kinds = ("NodeGroupInput", "GeometryNodeGroup", "GeometryNodeRealizeInstances", "NodeGroupOutput")
        entry, self.node, real, end = map(tree.nodes.new, kinds)
        self.node.node_tree = group
        if begin := next((socket for socket in self.node.inputs if socket.type == "GEOMETRY"), None):
            tree.links.new(entry.outputs[0], begin)
        tree.links.new(next(socket for socket in self.node.outputs if socket.type == "GEOMETRY"), real.inputs[0])
        tree.links.new(real.outputs[0], end.inputs[0])
        self.sockets = {socket.identifier: socket for socket in self.node.inputs}
        base = modifier.id_data.data if modifier else None
        mesh = base if isinstance(base, bpy.types.Mesh) else bpy.data.meshes.new("shapewright")
        for identifier, socket in self.sockets.items():
            if modifier and socket.type.lower() in _BY_FILE:
                with contextlib.suppress(KeyError, TypeError):  # versions after 4 may keep it elsewhere
                    socket.default_value = modifier[identifier]
        self.holder = bpy.data.objects.new("shapewright", mesh)
        self.holder.modifiers.new("shapewright", "NODES").node_group = tree
        scene = bpy.data.scenes.new("shapewright")
        scene.collection.objects.link(self.holder)
        self.layer = scene.view_layers[0]

    def _set(self, values: dict[str, Any]) -> None:
        for identifier, value in values.items():
            socket = self.sockets[identifier]
            now = socket.default_value
            if (list(now) if isinstance(value, list) else now) != value:
                socket.default_value = value

    def idle(self, values: dict[str, Any]) -> list[str]:
        """The sockets that change nothing at these values, by identifier; before version 4.5 none is known."""
        self._set(values)
        return [name for name, socket in self.sockets.items() if getattr(socket, "is_inactive", False)]

    def built(self, values: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
        """The group's mesh at these values, by identifiers of sockets."""
        self._set(values)
        self.layer.update()
        evaluated = self.holder.evaluated_get(self.layer.depsgraph)
        mesh = evaluated.data
        if not len(mesh.polygons):
            warnings = [w.message for w in getattr(evaluated.modifiers[0], "node_warnings", ())]
            return {"empty": [len(mesh.vertices), len(mesh.edges)], "warnings": warnings}, {}
        return _tables(mesh)


def _sockets(tree: Any) -> Iterator[dict[str, Any]]:
    """What is known of the inputs of a group, as plain values."""
    for item in _items(tree, "INPUT"):
        kind = item.socket_type.removeprefix("NodeSocket").lower()
        if kind == "geometry":
            continue
        default: Any = getattr(item, "default_value", None)
        if kind in _BY_FILE or hasattr(default, "name"):
            default = getattr(default, "name", None)
        elif hasattr(default, "__len__") and not isinstance(default, str):
            default = [_short(value) for value in default]
        yield {
            "identifier": item.identifier,
            "name": item.name,
            "panel": item.parent.name if item.parent else "",
            "description": item.description,
            "kind": kind,
            "default": _short(default),
            "low": _short(getattr(item, "min_value", None)),
            "high": _short(getattr(item, "max_value", None)),
            "options": _options(item) if kind == "menu" else [],
            "hidden": item.hide_in_modifier,
        }


def _items(tree: Any, way: str) -> list[Any]:
    return [item for item in tree.interface.items_tree if item.item_type == "SOCKET" and item.in_out == way]


def _short(value: Any) -> Any:
    """In the seven digits that Blender's numbers have: .14 comes as 0.14000000059604645."""
    return float(f"{value:.7g}") if isinstance(value, float) else value


def _options(item: Any) -> list[str]:
    """The options of a menu. They come from a node inside; here only the error about a wrong one lists them."""
    try:
        item.default_value = "\1"
    except TypeError as error:
        with contextlib.suppress(ValueError, SyntaxError):
            return [str(option) for option in ast.literal_eval(str(error).partition("not found in ")[2])]
    return []


def _tables(mesh: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    """A mesh as triangles, each with the number of its label and of its material."""
    import numpy as np

    mesh.calc_loop_triangles()
    triangles = mesh.loop_triangles

    def column(rows: Any, name: str, width: int, kind: Any) -> Any:
        values = np.empty(len(rows) * width, dtype=kind)
        rows.foreach_get(name, values)
        return values.reshape(-1, width) if width > 1 else values

    faces = column(triangles, "vertices", 3, np.int32)
    polygons = column(triangles, "polygon_index", 1, np.int32)
    slots = column(mesh.polygons, "material_index", 1, np.int32)[polygons]
    materials = list(mesh.materials)
    slots = np.where(slots < len(materials), slots, -1)
    slots[np.isin(slots, [i for i, material in enumerate(materials) if material is None])] = -1
    where: dict[str, Callable[[Any], Any]] = {
        "FACE": lambda marked: marked[polygons],
        "POINT": lambda marked: marked[faces].all(axis=1),
        "CORNER": lambda marked: marked[column(triangles, "loops", 3, np.int32)].all(axis=1),
    }
    labels = np.full(len(faces), -1, dtype=np.int32)
    names: list[str] = []
    for attribute in mesh.attributes:
        own = not attribute.is_internal and attribute.name not in _BUILT_IN
        if own and attribute.data_type == "BOOLEAN" and attribute.domain in where:
            marked = where[attribute.domain](column(attribute.data, "value", 1, bool))
            labels[marked] = len(names)
            names.append(attribute.name)
    header = {
        "labels": names,
        "materials": [material.name if material else "" for material in materials],
        "colours": [list(_colour(material)) if material else [0.0] * 4 for material in materials],
    }
    points = column(mesh.vertices, "co", 3, np.float32)
    return header, {"vertices": points, "faces": faces, "face_labels": labels, "face_materials": slots}


def _colour(material: Any) -> Any:
    """Linear RGBA: the base colour of its shader where that is one value, else its colour in the viewport."""
    nodes = material.node_tree.nodes if material.use_nodes and material.node_tree else ()
    for node in nodes:
        base = node.inputs.get("Base Color") if node.type == "BSDF_PRINCIPLED" else None
        if base is not None and not base.is_linked:
            return base.default_value
    return material.diffuse_color


def _listen(stream: IO[bytes], waiting: queue.SimpleQueue[dict[str, Any]]) -> None:
    while len(head := stream.read(4)) == 4:
        waiting.put(json.loads(stream.read(struct.unpack(">I", head)[0])))
    os._exit(0)


def _send(stream: IO[bytes], answer: dict[str, Any], arrays: dict[str, Any]) -> None:
    tables = [[name, array.dtype.str, array.shape] for name, array in arrays.items()]
    text = json.dumps({**answer, "arrays": tables}).encode()
    stream.write(struct.pack(">I", len(text)) + text)
    for array in arrays.values():
        stream.write(array.tobytes())
    stream.flush()


def _end_with_parent() -> None:
    """Linux ends this process with the thread that started it; elsewhere the end of standard input does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def _run_on(one: bool) -> None:
    """One core, on which Blender starts its threads: shapes are built side by side. Then those of the parent."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))} if one else os.sched_getaffinity(os.getppid()))


def _limit_memory(megabytes: int | None) -> None:
    """The address space that may be mapped from the first limit on."""
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        if megabytes is not None and resource.getrlimit(resource.RLIMIT_AS)[0] == resource.RLIM_INFINITY:
            mapped = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
            resource.setrlimit(resource.RLIMIT_AS, (mapped + megabytes * 2**20, resource.RLIM_INFINITY))


if __name__ == "__main__":
    main()
