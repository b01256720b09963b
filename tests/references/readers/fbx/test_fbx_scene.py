import numpy as np
import pytest

from fbx_files import binary, cube, geometry, model, node, properties, scene, written
from gltf_files import CUBE
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import contents

EYE = np.eye(4)


def put(tmp_path, data: bytes):
    path = tmp_path / "a.fbx"
    path.write_bytes(data)
    return path


def bounds(tmp_path, nodes) -> list[list[float]]:
    return np.round(contents(put(tmp_path, binary(nodes))).shape.bounds, 6).tolist()


def reason(tmp_path, data: bytes) -> str:
    with pytest.raises(UnreadableError) as error:
        contents(put(tmp_path, data))
    return str(error.value)


def volume(found) -> float:
    corners = found.shape.triangles
    return float((corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6)


class TestForms:
    @pytest.mark.parametrize(
        "data",
        [
            binary(cube()),
            binary(cube(), compressed=False),
            binary(cube(), version=7700),
            binary(cube(), order=">"),
            written(cube()),
            written(cube()).replace(b"a: 0", b"a:\n ; why not\n 0"),
            written(cube()).decode().encode("utf-16"),
        ],
        ids=["packed", "plain", "64 bits", "big endian", "text", "lists on their own lines", "UTF-16"],
    )
    def test_each_form_holds_the_same_cube(self, tmp_path, data):
        found = contents(put(tmp_path, data))
        assert (len(found.shape.faces), found.shape.bounds.tolist(), found.notes) == (12, [[0, 0, 0], [1, 1, 1]], ())
        assert volume(found) == pytest.approx(1.0)

    def test_before_version_7_a_model_holds_its_geometry_and_is_known_by_name(self, tmp_path):
        shape = geometry(1)[2]
        moved = node("Properties60", below=[node("Property", "Lcl Translation", "", "A", 1.0, 2.0, 3.0)])
        objects = [node("Model", "Model::box", "Mesh", below=[moved, *shape])]
        links = [node("Connect", "OO", "Model::box", "Model::Scene")]
        nodes = [node("Objects", below=objects), node("Connections", below=links)]
        for data in (binary(nodes, 6100), written(nodes, 6100)):
            assert contents(put(tmp_path, data)).shape.bounds.tolist() == [[1, 2, 3], [2, 3, 4]]

    def test_older_versions_are_refused_with_the_way_out(self, tmp_path):
        assert "FBX of version 5.8" in reason(tmp_path, binary(cube(), version=5800))
        assert "save it as FBX 2013 or newer" in reason(tmp_path, written(cube(), version=5800))

    @pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
    def test_a_file_cut_short_is_refused(self, tmp_path, share):
        for data in (binary(cube()).rstrip(b"\0"), written(cube())):
            assert reason(tmp_path, data[: int(len(data) * share)]).startswith(("broken", "it holds no triangles"))

    def test_an_array_that_does_not_unpack_to_what_it_announces_is_refused(self, tmp_path):
        plain = binary(cube(), compressed=False)
        at = plain.index(b"d" + (24).to_bytes(4, "little"))
        assert "broken" in reason(tmp_path, plain[: at + 1] + (25).to_bytes(4, "little") + plain[at + 5 :])
        packed = binary(cube())
        at = packed.index(b"d" + (24).to_bytes(4, "little"))
        assert "has 192" in reason(tmp_path, packed[: at + 1] + (2**25).to_bytes(4, "little") + packed[at + 5 :])

    def test_a_file_damaged_as_text_is_told(self, tmp_path):
        assert "as by a transfer as text" in reason(tmp_path, binary(cube()).replace(b"\0", b" "))

    def test_what_is_no_fbx_is_told(self, tmp_path):
        assert "no FBX" in reason(tmp_path, b"a: 1\n")
        assert "line 2 is not understood" in reason(tmp_path, b"; FBX 7.4.0\n<html>")


class TestPlaces:
    def test_a_model_is_scaled_then_turned_then_moved(self, tmp_path):
        steps = {"Lcl_Translation": [5, 0, 0], "Lcl_Rotation": [0, 0, 90], "Lcl_Scaling": [2, 1, 1]}
        assert bounds(tmp_path, cube(**steps)) == [[4, 0, 0], [5, 2, 1]]

    @pytest.mark.parametrize("order", [0, 5])
    def test_the_order_of_rotation_counts_where_it_is_active(self, tmp_path, order):
        about_x = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
        about_z = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
        corners = CUBE @ (about_z @ about_x if order == 0 else about_x @ about_z).T
        turned = {"Lcl_Rotation": [90, 0, 90], "RotationOrder": order, "RotationActive": 1}
        assert bounds(tmp_path, cube(**turned)) == [corners.min(axis=0).tolist(), corners.max(axis=0).tolist()]

    def test_pivots_are_where_a_model_turns_and_grows(self, tmp_path):
        turned = {"Lcl_Rotation": [0, 0, 180], "RotationPivot": [1, 1, 0]}
        assert bounds(tmp_path, cube(**turned)) == [[1, 1, 0], [2, 2, 1]]
        assert bounds(tmp_path, cube(Lcl_Scaling=[3, 3, 3], ScalingPivot=[1, 1, 1])) == [[-2, -2, -2], [1, 1, 1]]

    def test_rotations_before_and_behind_stand_around_that_of_the_model(self, tmp_path):
        turned = {"PreRotation": [0, 0, 90], "Lcl_Rotation": [90, 0, 0], "PostRotation": [90, 0, 0]}
        assert bounds(tmp_path, cube(**turned)) == [[-1, 0, 0], [0, 1, 1]]

    def test_offsets_move(self, tmp_path):
        assert bounds(tmp_path, cube(RotationOffset=[1, 0, 0], ScalingOffset=[0, 2, 0])) == [[1, 2, 0], [2, 3, 1]]

    def test_the_geometric_transformation_is_not_inherited(self, tmp_path):
        nodes = scene(
            [geometry(1), model(2, GeometricTranslation=[0, 0, 9], Lcl_Translation=[1, 0, 0]), model(3)],
            (1, 2), (1, 3), (2, 0), (3, 2),
        )  # fmt: skip
        assert bounds(tmp_path, nodes) == [[1, 0, 0], [2, 1, 10]]

    @pytest.mark.parametrize(("way", "size"), [(0, [6, 1, 1]), (1, [2, 3, 1]), (2, [2, 1, 1])])
    def test_a_scale_is_inherited_in_three_ways(self, tmp_path, way, size):
        """A child that is turned by 90 degrees below one that is three times as high."""
        child = model(3, Lcl_Rotation=[0, 0, 90], Lcl_Scaling=[1, 2, 1], InheritType=way)
        above = model(2, "Null", Lcl_Scaling=[1, 3, 1], Lcl_Translation=[2, 2, 0])
        found = bounds(tmp_path, scene([geometry(1), above, child], (1, 3), (3, 2), (2, 0)))
        assert np.subtract(*found[::-1]).tolist() == size

    def test_instances_stand_at_each_model(self, tmp_path):
        nodes = scene([geometry(1), model(2), model(3, Lcl_Translation=[4, 0, 0])], (1, 2), (1, 3), (2, 0), (3, 0))
        found = contents(put(tmp_path, binary(nodes)))
        assert len(found.shape.faces) == 24 and found.shape.bounds.tolist() == [[0, 0, 0], [5, 1, 1]]

    def test_what_is_mirrored_keeps_its_outside(self, tmp_path):
        assert volume(contents(put(tmp_path, binary(cube(Lcl_Scaling=[-1, 1, 1]))))) == pytest.approx(1.0)

    def test_templates_tell_what_a_model_does_not(self, tmp_path):
        usual = node("Properties70", below=[node("P", "Lcl Scaling", "", "", "A", 2.0, 2.0, 2.0)])
        kind = node("ObjectType", "Model", below=[node("PropertyTemplate", "FbxNode", below=[usual])])
        assert bounds(tmp_path, [node("Definitions", below=[kind]), *cube()]) == [[0, 0, 0], [2, 2, 2]]

    def test_models_below_themselves_are_refused(self, tmp_path):
        nodes = scene([geometry(1), model(2), model(3)], (1, 2), (2, 3), (3, 2))
        assert "below themselves" in reason(tmp_path, binary(nodes))


class TestShown:
    def test_what_is_hidden_is_left_out_with_all_below(self, tmp_path):
        objects = [geometry(1), model(2), model(3, Visibility=0), model(4, Lcl_Translation=[9, 9, 9])]
        found = contents(put(tmp_path, binary(scene(objects, (1, 2), (1, 4), (2, 0), (3, 0), (4, 3)))))
        assert found.shape.bounds.tolist() == [[0, 0, 0], [1, 1, 1]]
        assert found.notes == ("1 x mesh that is hidden left out",)

    def test_layers_that_are_not_shown_hide_their_models(self, tmp_path):
        layer = node("CollectionExclusive", 9, "DisplayLayer::a", "DisplayLayer", below=[model(0, Show=0)[2][0]])
        objects = [geometry(1), model(2), model(3), layer]
        found = contents(put(tmp_path, binary(scene(objects, (1, 2), (1, 3), (2, 0), (3, 0), (3, 9)))))
        assert (len(found.shape.faces), found.notes) == (12, ("1 x mesh that is hidden left out",))

    def test_of_levels_of_detail_the_first_is_shown(self, tmp_path):
        objects = [geometry(1), model(5, "LodGroup"), model(2), model(3, Lcl_Scaling=[7, 7, 7])]
        found = contents(put(tmp_path, binary(scene(objects, (1, 2), (1, 3), (5, 0), (2, 5), (3, 5)))))
        assert found.shape.bounds.tolist() == [[0, 0, 0], [1, 1, 1]]
        assert found.notes == ("1 x lower level of detail left out",)

    def test_faces_have_the_names_of_their_model_and_material(self, tmp_path):
        layer = node("LayerElementMaterial", 0, below=[node("Materials", np.array([0] * 4 + [1] * 8, "i4"))])
        materials = [node("Material", 7 + i, f"Material::{name}", "") for i, name in enumerate(("oak", "brass"))]
        objects = [geometry(1, more=[layer]), model(2), model(3), *materials]
        links = [(1, 2), (1, 3), (7, 2), (8, 2), (7, 3)]
        found = contents(put(tmp_path, binary(scene(objects, *links)))).shape
        assert [found.labels.count(name) for name in ("m2 (oak)", "m2 (brass)", "m3 (oak)", "m3")] == [4, 8, 4, 8]

    def test_unit_and_axes_are_told(self, tmp_path):
        settings = {
            "UpAxis": 2,
            "UpAxisSign": 1,
            "FrontAxis": 1,
            "FrontAxisSign": -1,
            "CoordAxis": 0,
            "UnitScaleFactor": 2.54,
        }
        found = contents(put(tmp_path, binary(cube(settings))))
        assert (found.up, found.unit) == ("z", pytest.approx(0.0254))

    def test_a_left_handed_file_is_mirrored_front_to_back(self, tmp_path):
        settings = {"UpAxis": 1, "FrontAxis": 2, "FrontAxisSign": -1, "CoordAxis": 0}
        found = contents(put(tmp_path, binary(cube(settings))))
        assert found.shape.bounds.tolist() == [[0, 0, -1], [1, 1, 0]] and volume(found) == pytest.approx(1.0)


class TestGeometry:
    def test_polygons_end_at_a_negative_corner(self, tmp_path):
        concave = [[0, 0, 0], [4, 0, 0], [1, 1, 0], [0, 4, 0]]
        nodes = scene([geometry(1, concave, [[0, 1, 2, 3]]), model(2)], (1, 2), (2, 0))
        found = contents(put(tmp_path, binary(nodes)))
        corners = found.shape.triangles
        assert np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2].sum() / 2 == 4

    def test_polygons_that_are_holes_are_left_open(self, tmp_path):
        hole = node("LayerElementHole", 0, below=[node("Hole", np.array([1] + [0] * 11, "i4"))])
        nodes = scene([geometry(1, more=[hole]), model(2)], (1, 2), (2, 0))
        assert len(contents(put(tmp_path, binary(nodes))).shape.faces) == 11

    @pytest.mark.parametrize("polygons", [[[0, 1, 99]], [[0, 99, 1]]])
    def test_corners_outside_the_vertices_are_refused(self, tmp_path, polygons):
        assert "outside its 8 vertices" in reason(
            tmp_path, binary(scene([geometry(1, polygons=polygons), model(2)], (1, 2)))
        )

    def test_a_polygon_without_end_is_refused(self, tmp_path):
        shape = geometry(1)
        shape[2][1] = node("PolygonVertexIndex", np.array([0, 1, 2, 3], "i4"))
        assert "has no end" in reason(tmp_path, binary(scene([shape, model(2)], (1, 2))))

    def test_curves_are_noted(self, tmp_path):
        curve = node("Geometry", 7, "Geometry::", "NurbsCurve", below=[node("Points", np.zeros(12))])
        found = contents(put(tmp_path, binary(scene([geometry(1), curve, model(2)], (1, 2), (7, 2), (2, 0)))))
        assert found.notes == ("1 x NurbsCurve without polygons left out",)


class TestDeformers:
    def skin(self, bone, transform=EYE, weights=(1.0,) * 8):
        arrays = [
            node("Indexes", np.arange(len(weights), dtype="i4")),
            node("Weights", np.array(weights)),
            node("Transform", np.ravel(transform.T)),
        ]
        objects = [
            geometry(1),
            model(2, Lcl_Translation=[50, 0, 0]),
            bone,
            node("Deformer", 11, "Deformer::", "Skin"),
            node("Deformer", 12, "SubDeformer::", "Cluster", below=arrays),
        ]
        return scene(objects, (1, 2), (2, 0), (3, 0), (11, 1), (12, 11), (3, 12))

    def test_a_skin_stands_where_its_bones_put_it(self, tmp_path):
        assert bounds(tmp_path, self.skin(model(3, "LimbNode", Lcl_Translation=[0, 3, 0]))) == [[0, 3, 0], [1, 4, 1]]

    def test_in_the_pose_that_it_was_bound_in_it_stands_at_its_model(self, tmp_path):
        transform = EYE.copy()
        transform[:3, 3] = [50, -3, 0]
        bone = model(3, "LimbNode", Lcl_Translation=[0, 3, 0])
        assert bounds(tmp_path, self.skin(bone, transform)) == [[50, 0, 0], [51, 1, 1]]

    def test_what_no_bone_moves_stands_at_its_model(self, tmp_path):
        found = bounds(tmp_path, self.skin(model(3, "LimbNode"), weights=(1.0,) * 4))
        assert found == [[0, 0, 0], [51, 1, 1]]

    def blend(self, percent: float, full=(100.0,)):
        shapes = [
            node("Geometry", 30 + i, "Geometry::", "Shape",
                 below=[node("Indexes", np.array([7], "i4")), node("Vertices", np.array([0.0, 0.0, float(i + 1)]))])
            for i in range(len(full))
        ]  # fmt: skip
        channel = node("Deformer", 22, "SubDeformer::", "BlendShapeChannel",
                       below=[node("Properties70", below=[node("P", "DeformPercent", "", "", "A", percent)]),
                              node("FullWeights", np.array(full))])  # fmt: skip
        objects = [geometry(1), model(2), node("Deformer", 21, "Deformer::", "BlendShape"), channel, *shapes]
        links = [(30 + i, 22) for i in range(len(full))]
        return scene(objects, (1, 2), (2, 0), (21, 1), (22, 21), *links)

    @pytest.mark.parametrize(
        ("percent", "full", "height"),
        [(0, (100,), 1), (50, (100,), 1.5), (50, (50, 100), 2), (75, (50, 100), 2.5), (100, (50, 100), 3)],
    )
    def test_blend_shapes_count_by_the_weights_of_the_file(self, tmp_path, percent, full, height):
        assert bounds(tmp_path, self.blend(percent, full))[1][2] == pytest.approx(height)

    def test_of_a_single_shape_blender_writes_how_much_each_vertex_moves(self, tmp_path):
        nodes = self.blend(100.0)
        shape = next(each for each in nodes[0][2] if each[1][2] == "Shape")
        channel = next(each for each in nodes[0][2] if each[1][2] == "BlendShapeChannel")
        shape[2][:] = [node("Indexes", np.array([6, 7], "i4")), node("Vertices", np.array([0, 4.0, 0, 0, 0, 4.0]))]
        channel[2][1] = node("FullWeights", np.array([25.0, 50.0]))
        assert bounds(tmp_path, nodes)[1] == [1, 2, 3]

    def test_before_version_7_2_a_geometry_holds_its_shapes(self, tmp_path):
        shape = node(
            "Shape", "tall", below=[node("Indexes", np.array([7], "i4")), node("Vertices", np.array([0, 0, 2.0]))]
        )
        nodes = scene([geometry(1, more=[properties(tall=50.0), shape]), model(2)], (1, 2), (2, 0))
        assert bounds(tmp_path, nodes)[1] == [1, 1, 2]

    def test_a_skin_by_dual_quaternions_is_noted(self, tmp_path):
        nodes = self.skin(model(3, "LimbNode"))
        skin = next(each for each in nodes[0][2] if each[1][2] == "Skin")
        skin[2].append(node("SkinningType", "DualQuaternion"))
        assert contents(put(tmp_path, binary(nodes))).notes == ("1 x dual quaternion of skins left out",)

    def test_two_models_of_one_number_are_refused(self, tmp_path):
        nodes = scene([geometry(1), model(2), model(2, Lcl_Translation=[5, 0, 0])], (1, 2))
        assert "nothing tells them apart" in reason(tmp_path, binary(nodes))

    def test_instances_of_a_skin_stand_to_one_another_as_their_models(self, tmp_path):
        nodes = self.skin(model(3, "LimbNode"))
        nodes[0][2].append(model(4, Lcl_Translation=[53, 0, 0]))
        nodes[1][2].append(node("C", "OO", 1, 4))
        assert bounds(tmp_path, nodes) == [[0, 0, 0], [4, 1, 1]]
