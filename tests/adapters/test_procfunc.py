"""Functions of procfunc and Infinigen 2, called in the Python that has them."""

import os

import numpy as np
import pytest

import shapewright as sw
from shapewright.procedures import ProcedureError

SETTING = "SHAPEWRIGHT_PROCFUNC"
if not (PYTHON := os.environ.get(SETTING)):
    pytest.skip(f"set {SETTING} to a Python that has infinigen 2", allow_module_level=True)

THINGS = """\
from typing import NamedTuple
import bpy
import procfunc as pf

class Result(NamedTuple):
    height: float
    mesh: pf.MeshObject

def box(width=1.0, kind="object"):
    bpy.ops.mesh.primitive_cube_add(size=1.0)
    made = bpy.context.object
    made.name, made.scale, made.location = "Box", (width, 1.0, 2.0), (0.0, 0.0, 3.0)
    asset = pf.MeshObject(made)
    if kind == "count":
        return [(0, 0, len(bpy.data.objects)), (0, 1, 0), (1, 0, 0), (1, 1, 0)], [(0, 1, 2), (1, 2, 3)]
    if kind == "materials":
        for name in ("wood.001", "steel_7"):
            made.data.materials.append(bpy.data.materials.new(name))
        made.data.polygons[0].material_index = 1
    if kind == "smooth":
        made.modifiers.new("Smooth", "SUBSURF").levels = 4
    if kind == "pair":
        bpy.ops.mesh.primitive_cube_add(size=0.5)
        bpy.context.object.name = "Lid"
        return [asset, bpy.context.object]
    if kind == "mirrored":
        made.scale[0] *= -1.0
    return {"tuple": Result(2.0, asset), "asset": asset, "dict": {"mesh": asset}}.get(kind, made)

def ball(width, kind):
    return pf.nodes.geo.mesh_uv_sphere(segments=16, rings=8, radius=width / 2).mesh
"""
KINDS = ("object", "asset", "tuple", "dict", "materials", "smooth", "pair", "mirrored", "count")


@pytest.fixture(scope="module")
def make(tmp_path_factory):
    """Builds what a function of THINGS returns."""
    folder = tmp_path_factory.mktemp("things")
    (folder / "things.py").write_text(THINGS)
    for name in ("box", "ball"):
        (folder / f"{name}.toml").write_text(
            f'call = "things:{name}"\npython = "{PYTHON}"\n[parameters]\n'
            f"width = {{ range = [1, 4] }}\nkind = {{ choices = {list(KINDS)} }}\n"
        )
    loaded = {name: sw.load_procedure(folder / f"{name}.toml") for name in ("box", "ball")}
    return lambda name, **values: loaded[name](**values)


@pytest.mark.parametrize("kind", ["object", "asset", "tuple", "dict", "mirrored"])
def test_an_object_is_a_shape_in_its_place_with_z_up_whatever_it_comes_in(make, kind):
    shape = make("box", width=3.0, kind=kind)
    np.testing.assert_allclose(shape.bounds, [[-1.5, 2.0, -0.5], [1.5, 4.0, 0.5]], atol=1e-6)
    assert shape.label_names == ("Box",) and shape.soundness().closed
    inside = np.linalg.det(shape.vertices[shape.faces]).sum() / 6.0  # positive where all faces look outwards
    assert inside == pytest.approx(6.0)


def test_a_node_is_a_shape(make):
    shape = make("ball", width=2.0)
    assert shape.extent == pytest.approx([2.0, 2.0, 2.0], abs=0.1) and shape.label_names == ("geometry",)


def test_materials_and_objects_name_the_parts(make):
    assert set(make("box", kind="materials").label_names) == {"wood", "steel"}
    assert set(make("box", kind="pair").label_names) == {"Box", "Lid"}


def test_a_subdivision_that_is_not_applied_is_made_once(make):
    assert len(make("box", kind="smooth").faces) == 2 * 6 * 4


def test_what_a_call_leaves_in_blender_is_removed(make):
    counts = [make("box", width=1.0 + i / 10, kind="count").extent[2] for i in range(3)]
    assert counts[0] == counts[1] == counts[2]


def test_a_vase_of_infinigen_has_its_ranges_beside(tmp_path):
    spec = tmp_path / "vase.toml"
    spec.write_text(
        f'call = "infinigen2.objects.vase:vase"\npython = "{PYTHON}"\nunit = "m"\nsize = "given"\n[parameters]\n'
        "height = { range = [0.17, 0.5] }\ndiameter = { range = [0.05, 0.3] }\n"
    )
    vase = sw.load_procedure(spec)
    assert vase(height=0.4, diameter=0.2).extent[1] == pytest.approx(0.4, rel=0.05)
    assert len(vase(height=0.4, diameter=0.2).faces) < 10_000


def test_a_function_that_is_not_there_is_told_with_its_line(tmp_path):
    spec = tmp_path / "vase.toml"
    spec.write_text(
        f'python = "{PYTHON}"\ncall = "infinigen2.objects.vase:vaze"\n[parameters]\nx = {{ bool = true }}\n'
    )
    with pytest.raises(ProcedureError, match=r"vase.toml:2: .*no attribute 'vaze'"):
        sw.load_procedure(spec)(x=True)
