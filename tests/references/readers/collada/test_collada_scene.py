import io
import zipfile

import numpy as np
import pytest

from collada_files import document, geometry, show, source
from gltf_files import CUBE
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import contents

EYE = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"


def put(tmp_path, data: bytes, name: str = "a.dae"):
    path = tmp_path / name
    path.write_bytes(data)
    return path


def bounds(tmp_path, data: bytes) -> list[list[float]]:
    return np.round(contents(put(tmp_path, data)).shape.bounds, 9).tolist()


def reason(tmp_path, data: bytes) -> str:
    with pytest.raises(UnreadableError) as error:
        contents(put(tmp_path, data))
    return str(error.value)


def volume(corners: np.ndarray) -> float:
    return float((corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6)


class TestPlaces:
    def test_steps_of_a_node_are_taken_in_their_order(self, tmp_path):
        steps = "<translate>5 0 0</translate><rotate>0 0 1 90</rotate><scale>2 1 1</scale>"
        assert bounds(tmp_path, document(f"<node>{steps}{show()}</node>")) == [[4, 0, 0], [5, 2, 1]]
        turned = "<rotate>0 0 1 90</rotate><translate>5 0 0</translate>"
        assert bounds(tmp_path, document(f"<node>{turned}{show()}</node>")) == [[-1, 5, 0], [0, 6, 1]]

    def test_a_matrix_is_written_row_by_row(self, tmp_path):
        node = f"<node><matrix>1 0 0 7 0 1 0 8 0 0 1 9 0 0 0 1</matrix>{show()}</node>"
        assert bounds(tmp_path, document(node)) == [[7, 8, 9], [8, 9, 10]]

    def test_lookat_stands_at_the_eye_and_looks_along_minus_z(self, tmp_path):
        node = f"<node><lookat>1 2 3  5 2 3  0 1 0</lookat>{show()}</node>"
        assert bounds(tmp_path, document(node)) == [[0, 2, 3], [1, 3, 4]]

    def test_nodes_stand_in_the_frame_of_those_above(self, tmp_path):
        node = f"<node><scale>2 2 2</scale><node><translate>1 0 0</translate>{show()}</node></node>"
        assert bounds(tmp_path, document(node)) == [[2, 0, 0], [4, 2, 2]]

    def test_nodes_of_the_library_stand_at_each_instance(self, tmp_path):
        library = f'<library_nodes><node id="n"><translate>0 0 4</translate>{show()}</node></library_nodes>'
        nodes = '<node><instance_node url="#n"/></node><node><scale>3 1 1</scale><instance_node url="#n"/></node>'
        found = contents(put(tmp_path, document(nodes, more=library)))
        assert len(found.shape.faces) == 24 and found.shape.bounds.tolist() == [[0, 0, 4], [3, 1, 5]]

    def test_what_is_mirrored_keeps_its_outside(self, tmp_path):
        found = contents(put(tmp_path, document(f"<node><scale>-1 1 1</scale>{show()}</node>")))
        assert volume(found.shape.triangles) == pytest.approx(1.0)

    def test_hidden_nodes_are_left_out_with_a_note(self, tmp_path):
        extra = '<extra><technique profile="FCOLLADA"><visibility>0</visibility></technique></extra>'
        nodes = f"<node>{show()}</node><node><scale>9 9 9</scale>{show()}{extra}</node>"
        found = contents(put(tmp_path, document(nodes)))
        assert found.shape.bounds.tolist() == [[0, 0, 0], [1, 1, 1]]
        assert found.notes == ("1 x mesh that is hidden left out",)

    def test_a_node_below_itself_is_refused(self, tmp_path):
        library = f'<library_nodes><node id="n">{show()}<instance_node url="#n"/></node></library_nodes>'
        assert "below themselves" in reason(tmp_path, document('<node><instance_node url="#n"/></node>', more=library))

    def test_nodes_that_double_at_each_level_are_refused(self, tmp_path):
        levels = "".join(
            f'<node id="n{i}"><instance_node url="#n{i + 1}"/><instance_node url="#n{i + 1}"/></node>'
            for i in range(40)
        )
        library = f'<library_nodes>{levels}<node id="n40">{show()}</node></library_nodes>'
        said = reason(tmp_path, document('<node><instance_node url="#n0"/></node>', more=library))
        assert "more than 200,000 places" in said

    def test_a_skew_is_refused(self, tmp_path):
        assert "skew" in reason(tmp_path, document(f"<node><skew>45 1 0 0 0 1 0</skew>{show()}</node>"))

    def test_faces_have_the_names_of_their_node_and_material(self, tmp_path):
        bound = '<bind_material><instance_material symbol="m" target="#oak-1"/></bind_material>'
        instance = f'<instance_geometry url="#box">{bound}</instance_geometry>'
        shape = geometry().replace("<triangles ", '<triangles material="m" ')
        library = '<library_materials><material id="oak-1" name="oak"/></library_materials>'
        nodes = f'<node name="leg">{instance}</node><node name="group"><node>{show()}</node></node>'
        labels = contents(put(tmp_path, document(nodes, shape, library))).shape.labels
        assert [labels.count(name) for name in ("leg (oak)", "group (m)")] == [12, 12]

    def test_unit_and_up_axis_are_told(self, tmp_path):
        asset = '<unit meter="0,0254" name="inch"/><up_axis>Z_UP</up_axis>'
        found = contents(put(tmp_path, document(f"<node>{show()}</node>", asset=asset)))
        assert (found.unit, found.up) == (0.0254, "z")
        assert found.shape.bounds.tolist() == [[0, 0, 0], [1, 1, 1]]

    def test_what_other_files_hold_is_noted(self, tmp_path):
        nodes = f'<node>{show()}<instance_geometry url="b.dae#x"/><instance_node url="../c.dae#y"/></node>'
        found = contents(put(tmp_path, document(nodes)))
        assert set(found.notes) == {"1 x node of another file left out", "1 x mesh of another file left out"}

    def test_what_is_not_there_is_named(self, tmp_path):
        assert "the geometry 'chair', which is not there" in reason(tmp_path, document(f"<node>{show('chair')}</node>"))


class TestFiles:
    def test_an_archive_has_the_document_that_its_manifest_names(self, tmp_path):
        with zipfile.ZipFile(buffer := io.BytesIO(), "w") as archive:
            archive.writestr("a.dae", document(f"<node><scale>9 9 9</scale>{show()}</node>"))
            archive.writestr("in/b.dae", document(f"<node>{show()}</node>"))
            archive.writestr("manifest.xml", "<dae_root>./in/b.dae#s</dae_root>")
        found = contents(put(tmp_path, buffer.getvalue(), "a.zae"))
        assert found.shape.bounds.tolist() == [[0, 0, 0], [1, 1, 1]]

    def test_entities_are_refused(self, tmp_path):
        bomb = b'<!DOCTYPE x [<!ENTITY a "aaaa">]>' + document(f"<node>{show()}</node>")[38:]
        assert "document type definition" in reason(tmp_path, bomb)

    def test_utf_16_and_files_without_namespace_are_read(self, tmp_path):
        text = document(f"<node>{show()}</node>").decode().replace('"utf-8"', '"utf-16"')
        bare = text.replace('xmlns="http://www.collada.org/2005/11/COLLADASchema"', "")
        for data in (text.encode("utf-16"), bare.encode("utf-16-le")):
            assert bounds(tmp_path, data) == [[0, 0, 0], [1, 1, 1]]

    def test_a_file_cut_short_is_refused(self, tmp_path):
        assert "not well-formed" in reason(tmp_path, document(f"<node>{show()}</node>")[:-40])

    def test_a_scene_without_meshes_is_refused(self, tmp_path):
        assert reason(tmp_path, document("<node/>")) == "it holds no triangles"


def skinned(joint: str, bind: str = EYE, inverse: str = EYE, influences: str = "0 0 " * 8) -> bytes:
    skin = (
        f'<controller id="c"><skin source="#box"><bind_shape_matrix>{bind}</bind_shape_matrix>'
        + source("j", ["arm"], 1, "Name_array")
        + source("m", [map(float, inverse.split())], 16)
        + source("w", [1.0, 0.5], 1)
        + '<joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#m"/></joints>'
        '<vertex_weights count="8"><input semantic="JOINT" source="#j" offset="0"/>'
        f'<input semantic="WEIGHT" source="#w" offset="1"/><vcount>{"1 " * 8}</vcount><v>{influences}</v>'
        "</vertex_weights></skin></controller>"
    )
    nodes = f'{joint}<node><translate>50 0 0</translate><instance_controller url="#c"/></node>'
    return document(nodes, more=f"<library_controllers>{skin}</library_controllers>")


class TestControllers:
    def test_a_skin_stands_where_its_joints_put_it(self, tmp_path):
        joint = '<node sid="arm" type="JOINT"><translate>0 3 0</translate></node>'
        moved = skinned(joint, bind="1 0 0 2 0 1 0 0 0 0 1 0 0 0 0 1")
        assert bounds(tmp_path, moved) == [[2, 3, 0], [3, 4, 1]]

    def test_in_the_pose_that_it_was_bound_in_its_shape_is_as_it_was(self, tmp_path):
        joint = '<node sid="arm"><translate>0 3 0</translate></node>'
        assert bounds(tmp_path, skinned(joint, inverse="1 0 0 0 0 1 0 -3 0 0 1 0 0 0 0 1")) == [[0, 0, 0], [1, 1, 1]]

    def test_weights_count_by_their_share(self, tmp_path):
        joint = '<node sid="arm"><translate>0 3 0</translate></node>'
        assert bounds(tmp_path, skinned(joint, influences="0 1 " * 8)) == [[0, 3, 0], [1, 4, 1]]

    def test_without_its_joints_a_skin_is_bound_and_noted(self, tmp_path):
        found = contents(put(tmp_path, skinned("")))
        assert found.shape.bounds.tolist() == [[50, 0, 0], [51, 1, 1]]
        assert found.notes == ("1 x pose of a skin without joints left out",)

    def test_a_skin_that_refers_beyond_its_joints_is_refused(self, tmp_path):
        assert "joints or weights" in reason(tmp_path, skinned('<node sid="arm"/>', influences="7 0 " * 8))

    @pytest.mark.parametrize(("method", "height"), [("NORMALIZED", 1.5), ("RELATIVE", 2.5)])
    def test_a_morph_stands_at_the_weights_of_the_file(self, tmp_path, method, height):
        morph = (
            f'<controller id="c"><morph source="#box" method="{method}">{source("t", ["tall"], 1, "IDREF_array")}'
            f'{source("w", [0.5], 1)}<targets><input semantic="MORPH_TARGET" source="#t"/>'
            '<input semantic="MORPH_WEIGHT" source="#w"/></targets></morph></controller>'
        )
        shapes = geometry() + geometry("tall", CUBE * [1, 2, 1] + [0, 1, 0], "")
        data = document(
            '<node><instance_controller url="#c"/></node>',
            shapes,
            f"<library_controllers>{morph}</library_controllers>",
        )
        assert bounds(tmp_path, data)[1][1] == pytest.approx(height if method == "RELATIVE" else 2.0)
