"""A first procedure in Blender's Python: every parameter of the function is a parameter of the model.

A geometry node group needs no page like this: its inputs are the parameters. shapewright fit model.blend references
"""

from typing import Annotated, Literal

import bpy  # before bmesh, which comes with it
import bmesh
from mathutils import Matrix

from shapewright import Range, procedure


def box(mesh, size, at):
    place = Matrix.Translation(at) @ Matrix.Diagonal((*size, 1.0))
    bmesh.ops.create_cube(mesh, size=1.0, matrix=place)


def cylinder(mesh, diameter, height, at):
    place = Matrix.Translation(at)
    bmesh.ops.create_cone(
        mesh, cap_ends=True, segments=32, radius1=diameter / 2, radius2=diameter / 2, depth=height, matrix=place
    )


@procedure(up="z")
def stool(
    height: Annotated[float, Range(0.3, 0.9)] = 0.45,
    breadth: Annotated[float, Range(0.25, 0.6)] = 0.4,
    thickness: Annotated[float, Range(0.02, 0.08)] = 0.04,
    leg: Annotated[float, Range(0.02, 0.08)] = 0.04,
    seat: Literal["square", "round"] = "round",
    legs: Annotated[int, Range(3, 6)] = 4,
):
    mesh = bmesh.new()
    try:
        if seat == "round":
            cylinder(mesh, breadth, thickness, (0, 0, height - thickness / 2))
        else:
            box(mesh, (breadth, breadth, thickness), (0, 0, height - thickness / 2))
        for i in range(legs):
            turn = Matrix.Rotation(6.283185 * (i + 0.5) / legs, 4, "Z")
            at = turn @ Matrix.Translation((0.4 * breadth, 0, (height - thickness) / 2))
            box(mesh, (leg, leg, height - thickness), at.translation)
        mesh.verts.index_update()
        return [tuple(v.co) for v in mesh.verts], [[v.index for v in face.verts] for face in mesh.faces]
    finally:
        mesh.free()  # what stays in Blender's memory makes every later shape slower
