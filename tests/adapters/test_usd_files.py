"""USD by files that are written by hand, and by stages that usd-core measures."""

import pytest

pytest.importorskip("pxr", reason="the extra usd is not installed")

import numpy as np
from pxr import Usd, UsdGeom, UsdUtils

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import contents

TRIANGLE = (
    "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n"
    "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n"
)


def put(path, body: str, head: str = "") -> None:
    """A file in text; braces get lines of their own, as the format asks."""
    lines = body.replace("{ ", "{\n").replace(" }", "\n}")
    path.write_text(f"#usda 1.0\n(\n{head}\n)\n{lines}")


def read(tmp_path, body: str, head: str = "", name: str = "a.usda"):
    put(tmp_path / name, body, head)
    return contents(tmp_path / name)


def moved(operation: str, kind: str = "double3", name: str = "translate") -> str:
    return f'{kind} xformOp:{name} = {operation}\nuniform token[] xformOpOrder = ["xformOp:{name}"]'


def reason(tmp_path, body: str, head: str = "") -> str:
    with pytest.raises(UnreadableError) as error:
        read(tmp_path, body, head)
    return str(error.value)


def bounds(found) -> list[list[float]]:
    return np.round(found.shape.bounds, 6).tolist()


def test_prims_stand_in_the_frame_of_those_above(tmp_path):
    inner = f'def Cube "c" {{ double size = 2\n{moved("(1, 1, 1)")} }}'
    outer = f'def Xform "x" {{ {moved("(2, 3, 4)", "float3", "scale")}\n{inner} }}'
    assert bounds(read(tmp_path, outer)) == [[0, 0, 0], [4, 6, 8]]


@pytest.mark.parametrize(
    ("shape", "box"),
    [
        ('Sphere "s" { double radius = 2 }', [[-2, -2, -2], [2, 2, 2]]),
        ('Cylinder "s" { double radius = 1\ndouble height = 4\nuniform token axis = "X" }', [[-2, -1, -1], [2, 1, 1]]),
        ('Cone "s" { double radius = 1\ndouble height = 4\nuniform token axis = "Y" }', [[-1, -2, -1], [1, 2, 1]]),
        ('Capsule "s" { double radius = 1\ndouble height = 4 }', [[-1, -1, -3], [1, 1, 3]]),
        ('Plane "s" { double width = 2\ndouble length = 4 }', [[-1, -2, 0], [1, 2, 0]]),
        ('Cube "s" { }', [[-1, -1, -1], [1, 1, 1]]),
    ],
)
def test_exact_shapes_have_their_bounds(tmp_path, shape, box):
    assert bounds(read(tmp_path, f"def {shape}")) == box


@pytest.mark.parametrize(("orientation", "up"), [("rightHanded", 1.0), ("leftHanded", -1.0)])
def test_a_left_handed_mesh_is_turned_over(tmp_path, orientation, up):
    found = read(tmp_path, f'def Mesh "m" {{ uniform token orientation = "{orientation}"\n{TRIANGLE} }}')
    a, b, c = found.shape.triangles[0]
    assert np.sign(np.cross(b - a, c - a)[2]) == up


def test_holes_of_a_mesh_stay_open_and_a_subdivision_is_noted(tmp_path):
    mesh = (
        'uniform token subdivisionScheme = "catmullClark"\nint[] holeIndices = [1]\nint[] faceVertexCounts = [3, 3]\n'
        "int[] faceVertexIndices = [0, 1, 2, 0, 2, 3]\npoint3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]"
    )
    found = read(tmp_path, f'def Mesh "m" {{ {mesh} }}')
    assert (len(found.shape.faces), found.notes) == (1, ("1 x subdivision of a mesh left out",))


def test_guides_proxies_and_what_is_invisible_are_left_out(tmp_path):
    cubes = "".join(
        f'def Cube "{name}" {{ double size = 9\n{told} }}\n'
        for name, told in (
            ("a", 'uniform token purpose = "guide"'),
            ("b", 'uniform token purpose = "proxy"'),
            ("c", 'token visibility = "invisible"'),
        )
    )
    found = read(tmp_path, f'{cubes}def Cube "d" {{ uniform token purpose = "render" }}')
    assert bounds(found) == [[-1, -1, -1], [1, 1, 1]]
    assert sorted(found.notes) == [
        "1 x guide shape left out", "1 x proxy shape left out", "1 x shape that is invisible left out",
    ]  # fmt: skip


def test_curves_and_points_are_noted(tmp_path):
    found = read(tmp_path, 'def BasisCurves "c" {}\ndef Points "p" {}\ndef Cube "d" {}')
    assert sorted(found.notes) == ["1 x BasisCurves left out", "1 x Points left out"]


def test_instances_stand_where_they_are(tmp_path):
    body = 'class Xform "proto" { def Cube "c" {} }\n' + "".join(
        f'def "i{x}" (instanceable = true\ninherits = </proto>) {{ double3 xformOp:translate = ({x}, 0, 0)\n'
        'uniform token[] xformOpOrder = ["xformOp:translate"] }\n'
        for x in (0, 10)
    )
    found = read(tmp_path, body)
    assert len(found.shape.faces) == 24 and bounds(found) == [[-1, -1, -1], [11, 1, 1]]


def test_an_instancer_shows_its_prototypes_at_their_places_and_nowhere_else(tmp_path):
    body = (
        'def PointInstancer "p" { rel prototypes = [</p/big>, </p/small>]\nint[] protoIndices = [0, 1, 1]\n'
        "point3f[] positions = [(0, 0, 0), (10, 0, 0), (20, 0, 0)]\nint64[] invisibleIds = [2]\n"
        'double3 xformOp:translate = (0, 5, 0)\nuniform token[] xformOpOrder = ["xformOp:translate"]\n'
        'def Cube "big" { double size = 4 }\n'
        f'def Cube "small" {{ {moved("(0, 0, 3)")} }} }}'
    )
    found = read(tmp_path, body)
    assert len(found.shape.faces) == 24 and bounds(found) == [[-2, 3, -2], [11, 7, 4]]


def test_of_variants_the_selected_one_is_shown(tmp_path):
    sizes = "".join(
        f'"{name}" {{ def Cube "c" {{ double size = {size} }} }}\n' for name, size in (("low", 2), ("high", 6))
    )
    chosen = 'variants = { string level = "high" }\nprepend variantSets = "level"'
    body = f'def Xform "x" ({chosen}) {{\nvariantSet "level" = {{ {sizes} }} }}'
    assert bounds(read(tmp_path, body)) == [[-3, -3, -3], [3, 3, 3]]


def test_unit_and_up_are_told(tmp_path):
    found = read(tmp_path, 'def Cube "c" {}', 'upAxis = "Z"\nmetersPerUnit = 0.0254')
    assert (found.unit, found.up) == (0.0254, "z")


def test_faces_have_the_names_of_prim_and_material(tmp_path):
    bound = 'def Cube "leg" (prepend apiSchemas = ["MaterialBindingAPI"]) { rel material:binding = </oak> }'
    found = read(tmp_path, f'{bound}\ndef Cube "top" {{}}\ndef Material "oak" {{}}')
    assert {name: found.shape.labels.count(name) for name in found.shape.label_names} == {"leg (oak)": 12, "top": 12}


class TestOtherFiles:
    def test_layers_of_the_folder_are_read(self, tmp_path):
        (tmp_path / "in").mkdir()
        put(tmp_path / "in/b.usda", 'def Xform "x" { def Cube "c" { double size = 4 } }', 'defaultPrim = "x"')
        for arc in ("references", "payload"):
            assert bounds(read(tmp_path, f'def "y" (prepend {arc} = @./in/b.usda@) {{}}')) == [[-2, -2, -2], [2, 2, 2]]
        assert bounds(read(tmp_path, "", "subLayers = [@in/b.usda@]")) == [[-2, -2, -2], [2, 2, 2]]

    def test_layers_outside_are_refused_also_by_way_of_others(self, tmp_path):
        folder = tmp_path / "in"
        folder.mkdir()
        (tmp_path / "b.usda").write_text('#usda 1.0\ndef Cube "c" {}')
        (folder / "c.usda").write_text("#usda 1.0\n(subLayers = [@../b.usda@])")
        (tmp_path / "in/link.usda").symlink_to(tmp_path / "b.usda")
        for asset in ("../b.usda", str(tmp_path / "b.usda"), "c.usda", "link.usda", "https://a.b/c.usda"):
            assert "lies outside its folder" in reason(folder, "", f"subLayers = [@{asset}@]")

    def test_a_layer_that_is_missing_is_named(self, tmp_path):
        assert "it needs ./none.usda, which is missing" in reason(tmp_path, "", "subLayers = [@./none.usda@]")

    def test_a_prim_that_is_missing_is_noted(self, tmp_path, capfd):
        found = read(tmp_path, 'def Cube "c" {}\ndef "y" (prepend references = </none>) {}')
        assert found.notes == ("1 x reference that leads nowhere left out",)
        assert "".join(capfd.readouterr()) == ""

    def test_a_package_is_read(self, tmp_path):
        read(tmp_path, 'def Cube "c" { double size = 6 }')
        assert UsdUtils.CreateNewUsdzPackage(str(tmp_path / "a.usda"), str(tmp_path / "a.usdz"))
        assert bounds(contents(tmp_path / "a.usdz")) == [[-3, -3, -3], [3, 3, 3]]


def test_the_binary_form_holds_the_same(tmp_path):
    stage = Usd.Stage.CreateNew(str(tmp_path / "b.usdc"))
    UsdGeom.Cube.Define(stage, "/c").GetSizeAttr().Set(8.0)
    stage.Save()
    assert bounds(contents(tmp_path / "b.usdc")) == [[-4, -4, -4], [4, 4, 4]]
    whole = (tmp_path / "b.usdc").read_bytes()
    (tmp_path / "c.usdc").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(UnreadableError, match="broken"):
        contents(tmp_path / "c.usdc")


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("def Cube {", "broken"),
        (f'def Mesh "m" {{ {TRIANGLE.replace("[3]", "[4]")} }}', "a mesh of 4 corners has 3"),
        (f'def Mesh "m" {{ {TRIANGLE.replace("1, 2]", "1, 9]")} }}', "outside its 3 vertices"),
        ('def Scope "s" {}', "it holds no triangles"),
    ],
)
def test_what_does_not_add_up_is_refused(tmp_path, body, said):
    assert said in reason(tmp_path, body)


def test_a_skin_stands_where_its_joints_put_it(tmp_path):
    skeleton = (
        'def Skeleton "k" { uniform token[] joints = ["a"]\n'
        "uniform matrix4d[] bindTransforms = [((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))]\n"
        "uniform matrix4d[] restTransforms = [((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 7, 0, 1))] }"
    )
    mesh = (
        'def Mesh "m" (prepend apiSchemas = ["SkelBindingAPI"]) { rel skel:skeleton = </r/k>\n'
        f'{TRIANGLE}int[] primvars:skel:jointIndices = [0, 0, 0] (elementSize = 1\ninterpolation = "vertex")\n'
        'float[] primvars:skel:jointWeights = [1, 1, 1] (elementSize = 1\ninterpolation = "vertex") }'
    )
    assert bounds(read(tmp_path, f'def SkelRoot "r" {{ {skeleton}\n{mesh} }}')) == [[0, 7, 0], [1, 8, 0]]
