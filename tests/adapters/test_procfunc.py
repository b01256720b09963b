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


SEATS = """\
import bpy
import procfunc as pf

def _cube(size):
    bpy.ops.mesh.primitive_cube_add(size=1.0)
    bpy.context.object.scale = size
    return pf.MeshObject(bpy.context.object)

def gloss_material_rand(rng):
    return pf.random.uniform(rng, 0.0, 1.0)

def _block_rand(rng):
    return pf.random.uniform(rng, 0.1, 0.2)

def _rods_rand(rng):
    return sum(pf.random.log_uniform(rng, 0.1, 0.2) for _ in range(pf.random.randint(rng, 1, 3)))

def seat_rand(rng, lift=0.0):
    width = pf.random.uniform(rng, 1.0, 2.0)
    depth = width * pf.random.uniform(rng, 0.5 * width, width)
    gloss_material_rand(rng)
    legs = pf.control.choice(rng, [(_block_rand, 2.0), (_rods_rand, 1.0)])
    height = pf.random.clip_gaussian(rng, mean=1.0, std=0.1)
    if width > 1.9:
        height += pf.random.uniform(rng, 2.0, 3.0)
    return _cube((width, depth, height + legs(rng) + lift))

def plain(width):
    return _cube((width, 1.0, 1.0))
"""


@pytest.fixture(scope="module")
def seat(tmp_path_factory):
    """A spec of a function of SEATS. Returns what loads it, with these lines after the first ones."""
    folder = tmp_path_factory.mktemp("seats")
    (folder / "seats.py").write_text(SEATS)

    def load(lines="", name="seat_rand"):
        (folder / "seat.toml").write_text(f'call = "seats:{name}"\npython = "{PYTHON}"\n{lines}')
        return sw.load_procedure(folder / "seat.toml")

    return load


def test_what_a_function_draws_is_its_space(seat):
    properties = seat().space.to_schema()["properties"]
    assert list(properties) == ["width", "depth", "legs", "height", "block", "rods", "rods_2", "rods_3"]
    assert properties["height"]["minimum"] == pytest.approx(0.7)
    assert (properties["depth"]["minimum"], properties["depth"]["maximum"]) == (0.0, 1.0)
    assert properties["legs"]["enum"] == ["block", "rods"] and properties["rods"]["type"] == "integer"
    assert {name: table.get("x-when") for name, table in properties.items() if "x-when" in table} == {
        "block": "legs == 'block'",
        "rods": "legs == 'rods'",
        "rods_2": "legs == 'rods'",
        "rods_3": "legs == 'rods' and rods >= 2",
    }


def test_draws_have_the_values_of_the_parameters(seat):
    made = seat()
    shape = made(width=1.5, depth=0.5, height=0.9, legs="block", block=0.15)
    np.testing.assert_allclose(shape.extent, [1.5, 1.05, 1.5 * 1.125], rtol=1e-5)
    rods = made(width=1.5, depth=0.5, height=0.9, legs="rods", rods=2, rods_2=0.1, rods_3=0.2)
    assert rods.extent[1] == pytest.approx(1.2)


def test_what_is_held_depends_on_the_seed_alone(seat):
    heights = [seat(f"[parameters]\nrng = {seed}\n")(width=1.95, height=0.9, block=0.1).extent[1] for seed in (0, 1, 0)]
    assert heights[0] == heights[2] != heights[1] and 3.0 < heights[0] < 4.0


def test_what_a_spec_says_of_a_draw_or_of_an_argument_goes_before(seat):
    made = seat('[parameters]\nlegs = "block"\nlift = 5.0\nwidth = { range = [1.2, 1.4] }\n')
    assert set(made.space.names) == {"width", "depth", "height", "block"}
    assert made.space.to_schema()["properties"]["width"]["maximum"] == 1.4
    assert made(height=0.9, block=0.1).extent[1] == pytest.approx(6.0)


def test_ranges_of_another_file_go_before_what_is_drawn(seat, tmp_path):
    recipe = tmp_path / "recipe.yml"
    recipe.write_text("base:\n  width: 1.3\ndataset_generation:\n  width:\n    min: 1.2\n    max: 1.4\n")
    width = seat(f'ranges = "{recipe}"\n').space["width"]
    assert (width.low, width.high, width.default) == (1.2, 1.4, 1.3)
    recipe.write_text(recipe.read_text().replace("width", "span"))
    with pytest.raises(ProcedureError, match=r"span: .*it draws width, depth, legs"):
        seat(f'ranges = "{recipe}"\n')


@pytest.mark.parametrize(
    ("lines", "name", "says"),
    [
        (
            "[parameters]\nlength = 2.0\n",
            "seat_rand",
            r"seat.toml:4: parameters.length: .* it draws width, depth, legs",
        ),
        ('[parameters]\nlegs = "rod"\n', "seat_rand", r"seat.toml:4: parameters.legs: .* there are 'block', 'rods'"),
        ("", "plain", r"seat.toml:1: .*it takes no rng, and draws nothing; say the ranges"),
        ("", "nothing_rand", r"seat.toml:1: .*no attribute 'nothing_rand'"),
    ],
)
def test_what_is_wrong_with_draws_is_told(seat, lines, name, says):
    with pytest.raises(ProcedureError, match=says):
        seat(lines, name)


@pytest.mark.parametrize(
    ("target", "known"),
    [
        ("vase:vase_rand", {"neck_scale", "profile_star_points", "foot_height"}),
        ("vase:cup_rand", {"diameter", "twist"}),
        ("bowl:bowl_rand", {"rib_count", "broad_lobes"}),
        ("table:table_dining_rand", {"base_fn", "leg_inset"}),
        ("chair:chair_dining_rand", {"back_fn", "slat_width"}),
    ],
)
def test_functions_of_infinigen_are_procedures_as_they_are(tmp_path, target, known):
    spec = tmp_path / "spec.toml"
    spec.write_text(f'call = "infinigen2.objects.{target}"\npython = "{PYTHON}"\nunit = "m"\n')
    made = sw.load_procedure(spec)
    assert known < set(made.space.names)
    assert not [name for name in made.space.names if "material" in name or "color" in name]
    one, other = (made(**values) for values in made.space.sample(2, seed=1))
    assert len(one.faces) > 100 and not np.allclose(one.extent, other.extent)
