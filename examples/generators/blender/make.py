"""Makes the two .blend files beside it: a column with materials, a shelf of instances with named attributes.

    python make.py [FOLDER]        in an environment with bpy, or: blender --background --python make.py -- [FOLDER]

In Blender one draws such node groups. Here they are written down, so that everybody can see what is in the files.
"""

import sys
from pathlib import Path

import bpy

FLOAT, INT, BOOL, MENU = "NodeSocketFloat", "NodeSocketInt", "NodeSocketBool", "NodeSocketMenu"


class Group:
    """A geometry node group that is being written: each method adds nodes and returns their output."""

    def __init__(self, name):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
        self.tree.is_modifier = True
        self.entry = self.tree.nodes.new("NodeGroupInput")

    def socket(self, name, kind, default, low=None, high=None, text=""):
        item = self.tree.interface.new_socket(name, in_out="INPUT", socket_type=kind, description=text)
        if low is not None:
            item.min_value, item.max_value = low, high
        item.default_value = default
        return self.entry.outputs[item.identifier]

    def node(self, kind, *inputs, **properties):
        """A node with values or links at its inputs, in their order; None leaves one as it is."""
        node = self.tree.nodes.new(kind)
        for name, value in properties.items():
            setattr(node, name, value)
        shown = [socket for socket in node.inputs if socket.enabled]
        for socket, value in zip(shown, inputs, strict=False):
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, socket)
            elif value is not None:
                socket.default_value = value
        return next(socket for socket in node.outputs if socket.enabled)

    def menu(self, name, text, **shapes):
        """A menu socket: one of several geometries. The first is the default."""
        switch = self.tree.nodes.new("GeometryNodeMenuSwitch")
        switch.data_type = "GEOMETRY"
        switch.enum_definition.enum_items.clear()
        for option in shapes:
            switch.enum_definition.enum_items.new(option)
        for option, shape in shapes.items():
            self.tree.links.new(shape, switch.inputs[option])
        item = self.tree.interface.new_socket(name, in_out="INPUT", socket_type=MENU, description=text)
        self.tree.links.new(self.entry.outputs[item.identifier], switch.inputs[0])
        item.default_value = next(iter(shapes))
        return switch.outputs[0]

    def math(self, operation, a, b):
        return self.node("ShaderNodeMath", a, b, operation=operation)

    def vector(self, x=0.0, y=0.0, z=0.0):
        return self.node("ShaderNodeCombineXYZ", x, y, z)

    def moved(self, shape, x=0.0, y=0.0, z=0.0):
        node = self.tree.nodes.new("GeometryNodeTransform")
        self.tree.links.new(shape, node.inputs["Geometry"])
        self.tree.links.new(self.vector(x, y, z), node.inputs["Translation"])
        return node.outputs[0]

    def box(self, x, y, z):
        return self.node("GeometryNodeMeshCube", self.vector(x, y, z))

    def cone(self, sides, top, foot, height):
        """A prism where both radii are the same; it stands on the ground."""
        return self.node("GeometryNodeMeshCone", sides, None, None, top, foot, height)

    def join(self, *shapes):
        node = self.tree.nodes.new("GeometryNodeJoinGeometry")
        for shape in shapes:
            self.tree.links.new(shape, node.inputs[0])
        return node.outputs[0]

    def when(self, condition, shape):
        return self.node("GeometryNodeSwitch", condition, None, shape, input_type="GEOMETRY")

    def material(self, shape, name, colour):
        material = bpy.data.materials.new(name)
        material.diffuse_color = (*colour, 1.0)
        return self.node("GeometryNodeSetMaterial", shape, None, material)

    def named(self, shape, name):
        """Its faces get a boolean attribute of this name."""
        kind = {"data_type": "BOOLEAN", "domain": "FACE"}
        return self.node("GeometryNodeStoreNamedAttribute", shape, None, name, True, **kind)

    def finish(self, shape, path):
        self.tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
        self.tree.links.new(shape, self.tree.nodes.new("NodeGroupOutput").inputs[0])
        holder = bpy.data.objects.new(self.tree.name, bpy.data.meshes.new(self.tree.name))
        bpy.context.scene.collection.objects.link(holder)
        holder.modifiers.new(self.tree.name, "NODES").node_group = self.tree
        bpy.data.texts.new("shapewright").write("size=given")
        bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)


def column(path):
    group = Group("Column")
    height = group.socket("Height", FLOAT, 1.0, 0.6, 1.6, "From the ground to the head")
    radius = group.socket("Radius", FLOAT, 0.14, 0.08, 0.22)
    narrowing = group.socket("Top / Foot", FLOAT, 0.8, 0.5, 1.0, "Radius at the top as a share of that at the foot")
    sides = group.socket("Sides", INT, 6, 3, 8, "Of the shaft")
    head_height = group.socket("Head Height", FLOAT, 0.15, 0.08, 0.3)
    plinth = group.socket("Plinth", BOOL, True, text="Whether it stands on a slab")
    top = group.math("MULTIPLY", radius, narrowing)
    wide = group.math("MULTIPLY", radius, 1.7)
    double = group.math("MULTIPLY", wide, 2.0)
    square = group.moved(group.box(double, double, head_height), z=group.math("MULTIPLY", head_height, 0.5))
    heads = {
        "Round": group.cone(32, wide, wide, head_height),
        "Square": square,
        "Chalice": group.cone(32, wide, top, head_height),
    }
    head = group.menu("Head", "What lies on top", **heads)
    shaft = group.material(group.cone(sides, top, radius, height), "shaft", (0.75, 0.7, 0.6))
    head = group.material(group.moved(head, z=height), "head", (0.55, 0.3, 0.2))
    slab = group.material(group.moved(group.box(double, double, 0.08), z=0.04), "plinth", (0.3, 0.3, 0.32))
    group.finish(group.join(shaft, head, group.when(plinth, slab)), path)


def shelf(path):
    group = Group("Shelf")
    width = group.socket("Width", FLOAT, 0.8, 0.5, 1.4)
    height = group.socket("Height", FLOAT, 1.2, 0.7, 2.0, "Of the body, without the feet")
    depth = group.socket("Depth", FLOAT, 0.35, 0.2, 0.5)
    thickness = group.socket("Board Thickness", FLOAT, 0.03, 0.015, 0.06)
    boards = group.socket("Boards", INT, 4, 2, 7, "Top and bottom are two of them")
    foot_height = group.socket("Foot Height", FLOAT, 0.1, 0.04, 0.2)
    back = group.socket("Back", BOOL, True)
    group.socket("Bevel", FLOAT, 0.0, text="Not used yet; it has no limits, so it stays as it is")

    inner = group.math("SUBTRACT", width, group.math("MULTIPLY", thickness, 2.0))
    gap = group.math("SUBTRACT", height, thickness)
    step = group.math("DIVIDE", gap, group.math("SUBTRACT", boards, 1.0))
    half = group.math("MULTIPLY", thickness, 0.5)
    line = group.node("GeometryNodeMeshLine", boards, group.vector(z=half), group.vector(z=step))
    row = group.node("GeometryNodeInstanceOnPoints", line, None, group.box(inner, depth, thickness))
    row = group.named(group.node("GeometryNodeRealizeInstances", row), "board")

    middle = group.math("MULTIPLY", height, 0.5)
    out = group.math("MULTIPLY", group.math("SUBTRACT", width, thickness), 0.5)
    side = group.box(thickness, depth, height)
    left = group.moved(side, x=group.math("MULTIPLY", out, -1.0), z=middle)
    cheeks = group.named(group.join(left, group.moved(side, x=out, z=middle)), "side")
    behind = group.math("MULTIPLY", group.math("SUBTRACT", depth, 0.01), 0.5)
    panel = group.named(group.moved(group.box(inner, 0.01, height), y=behind, z=middle), "back")

    down = group.math("MULTIPLY", foot_height, -0.5)
    grid = group.node(
        "GeometryNodeMeshGrid", group.math("SUBTRACT", width, 0.08), group.math("SUBTRACT", depth, 0.08), 2, 2
    )
    corners = group.moved(grid, z=group.math("MULTIPLY", foot_height, -1.0))
    kinds = {
        "Posts": group.node("GeometryNodeInstanceOnPoints", corners, None, group.cone(16, 0.02, 0.02, foot_height)),
        "Pegs": group.node("GeometryNodeInstanceOnPoints", corners, None, group.cone(16, 0.035, 0.012, foot_height)),
        "Plinth": group.moved(group.box(inner, group.math("SUBTRACT", depth, 0.06), foot_height), z=down),
    }
    feet = group.menu("Feet", "What it stands on", **kinds)
    feet = group.named(group.node("GeometryNodeRealizeInstances", feet), "foot")
    whole = group.join(row, cheeks, group.when(back, panel), feet)
    group.finish(group.moved(whole, z=foot_height), path)


if __name__ == "__main__":
    own = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    folder = Path(own[0]) if own else Path(__file__).parent
    column((folder / "column.blend").resolve())
    shelf((folder / "shelf.blend").resolve())
