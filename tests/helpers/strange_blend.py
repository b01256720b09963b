"""Makes strange.blend: node groups with sockets of every kind, and some that fail; and linking.blend, which links one.

Run in Blender's Python:

python strange_blend.py FOLDER
"""

import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples" / "generators" / "blender"))
from make import BOOL, FLOAT, INT, Group


class Another(Group):
    def __init__(self, name):
        self.tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
        self.entry = self.tree.nodes.new("NodeGroupInput")

    def finish(self, shape, **held):
        """A group on an object whose modifier holds these values, by names of sockets."""
        self.tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
        self.tree.links.new(shape, self.tree.nodes.new("NodeGroupOutput").inputs[0])
        holder = bpy.data.objects.new(self.tree.name, bpy.data.meshes.new(self.tree.name))
        bpy.context.scene.collection.objects.link(holder)
        modifier = holder.modifiers.new(self.tree.name, "NODES")
        modifier.node_group = self.tree
        for item in self.tree.interface.items_tree:
            if item.name in held:
                modifier[item.identifier] = held[item.name]


def kinds():
    """A box of the size of a vector socket, and a thing of the file where a socket says which."""
    group = Another("Kinds")
    group.socket("class", FLOAT, 0.3, 0.25, 0.5)
    group.socket("Below", FLOAT, 0.0, 0.5, 1.0, "Its default lies below its minimum")
    group.socket("Half", FLOAT, 1.0, 0.0, 3.4e38)
    group.socket("Seed", INT, 3, 0, 100)
    size = group.socket("Size", "NodeSocketVector", (1.0, 0.5, 0.25), 0.1, 2.0)
    group.socket("Where", "NodeSocketVector", (0.0, 0.0, 0.0))
    group.socket("Colour", "NodeSocketColor", (1.0, 0.0, 0.0, 1.0))
    thing = group.tree.interface.new_socket("Thing", in_out="INPUT", socket_type="NodeSocketObject")
    group.tree.interface.new_socket("Paint", in_out="INPUT", socket_type="NodeSocketMaterial")
    group.tree.interface.new_socket("Own", in_out="INPUT", socket_type=FLOAT).hide_in_modifier = True
    for panel in ("Legs", "Top"):
        home = group.tree.interface.new_panel(panel)
        item = group.tree.interface.new_socket("Radius", in_out="INPUT", socket_type=FLOAT, parent=home)
        item.min_value, item.max_value, item.default_value = 0.1, 0.2, 0.15
    info = group.tree.nodes.new("GeometryNodeObjectInfo")
    group.tree.links.new(group.entry.outputs[thing.identifier], info.inputs[0])
    cube = bpy.data.meshes.new("cube")
    cube.from_pydata([(0, 0, 5), (1, 0, 5), (0, 1, 5)], [], [(0, 1, 2)])
    far = bpy.data.objects.new("far", cube)
    group.finish(group.join(group.node("GeometryNodeMeshCube", size), info.outputs["Geometry"]), Thing=far)


def grid():
    """As many points as is asked for: too many take too long, or too much memory."""
    group = Another("Grid")
    count = group.socket("Count", INT, 10, 2, 40_000)
    group.finish(group.node("GeometryNodeMeshGrid", 1.0, 1.0, count, count))


def wire():
    """A circle that has no surface until it is made solid."""
    group = Another("Wire")
    solid = group.socket("Solid", BOOL, False)
    radius = group.socket("Radius", FLOAT, 1.0, 0.5, 2.0)
    circle = group.node("GeometryNodeMeshCircle", 16, radius)
    disc = group.node("GeometryNodeMeshCircle", 16, radius, fill_type="NGON")
    group.finish(group.node("GeometryNodeSwitch", solid, circle, disc, input_type="GEOMETRY"))


def switches():
    """Sockets that matter only at some values of others."""
    group = Another("Switches")
    height = group.socket("Height", FLOAT, 1.0, 0.5, 2.0)
    drawers = group.socket("Drawers", INT, 0, 0, 4)
    back = group.socket("Back", BOOL, False)
    knob, panel = (group.socket(name, FLOAT, 1.0, 0.5, 2.0) for name in ("Knob", "Panel"))
    span = group.socket("Span", FLOAT, 1.0, 0.5, 2.0)
    some = group.node("FunctionNodeCompare", drawers, 0, data_type="INT", operation="GREATER_THAN")
    shapes = {"Plain": group.box(height, height, height), "Wide": group.box(span, height, height)}
    both = group.node("FunctionNodeBooleanMath", some, back, operation="OR")
    form = group.menu("Form", "", **shapes)
    group.finish(group.join(form, group.when(some, group.box(knob, 1, 1)), group.when(both, group.box(1, 1, panel))))


def loose():
    """No socket of it is a parameter."""
    group = Another("Loose")
    size = group.socket("Size", FLOAT, 1.0)
    group.finish(group.node("GeometryNodeMeshCube", group.vector(size, size, size)))


def link(folder):
    """A file that has a group of the other one only."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "linking.blend"))
    with bpy.data.libraries.load(str(folder / "strange.blend"), link=True, relative=True) as (_, taken):
        taken.node_groups = ["Wire"]
    holder = bpy.data.objects.new("holder", bpy.data.meshes.new("holder"))
    bpy.context.scene.collection.objects.link(holder)
    holder.modifiers.new("Wire", "NODES").node_group = bpy.data.node_groups["Wire"]
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "linking.blend"), compress=True)


if __name__ == "__main__":
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.unit_settings.scale_length = 0.001
    for make in (kinds, grid, wire, switches, loose):
        make()
    folder = Path(sys.argv[-1]).resolve()
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "strange.blend"), compress=True)
    link(folder)
