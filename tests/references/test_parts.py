import io

import numpy as np
import pytest
import trimesh

from collada_files import document, show
from shapewright.references import Collection
from shapewright.references.parts import PartName, Parts
from shapewright.references.readers.formats import read
from shapewright.shapes import Mesh
from threemf_files import mesh, model, moved, object_, single, written

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"


def labels(path, data: bytes | str) -> list[str | None]:
    path.write_bytes(data.encode() if isinstance(data, str) else data)
    shape, _ = read(path)
    assert isinstance(shape, Mesh)
    return list(shape.labels)


def named(*runs: tuple[str, str]) -> list[str | None]:
    """The labels of one face for each name and material."""
    count = len(runs)
    mesh = Mesh(np.eye(3), np.tile([[0, 1, 2]], (count, 1)))
    return list(Parts.of((PartName(*run), 1) for run in runs).labelled(mesh).labels)


class TestLabels:
    def test_a_label_has_the_material_in_brackets(self):
        assert named(("seat", "oak"), ("leg", "steel")) == ["seat (oak)", "leg (steel)"]

    def test_what_all_parts_have_in_common_is_left_out(self):
        assert named(("seat", "oak"), ("leg", "oak")) == ["seat", "leg"]
        assert named(("chair", "oak"), ("chair", "steel")) == ["oak", "steel"]
        assert named(("chair", "oak"), ("chair", "oak")) == ["chair", "chair"]

    def test_a_part_without_a_name_has_its_material_or_no_label(self):
        assert named(("", "oak"), ("leg", "steel"), ("", "")) == ["oak", "leg (steel)", None]

    def test_words_in_place_of_names_are_none(self):
        assert PartName.of("(null)", b" default ") == PartName()
        assert PartName.of(7, None) == PartName()


class TestFiles:
    def test_obj_has_groups_and_materials_that_last_until_others_come(self, tmp_path):
        text = f"{SQUARE}f 1 2 3\ng drawer front\nusemtl oak\nf 1 2 3 4\no leg\nf 1 2 5\nusemtl steel\nf 2 3 5\n"
        front, leg, steel = "drawer front (oak)", "leg (oak)", "leg (steel)"
        assert labels(tmp_path / "a.obj", text) == [None, front, front, leg, steel]

    def test_obj_without_names_has_no_labels(self, tmp_path):
        assert labels(tmp_path / "a.obj", f"{SQUARE}f 1 2 3\n") == [None]

    def test_a_name_that_is_not_utf8_is_read_as_well_as_it_can_be(self, tmp_path):
        assert labels(tmp_path / "a.obj", SQUARE.encode() + b"g T\xfcr\nf 1 2 3\n") == ["T\N{REPLACEMENT CHARACTER}r"]

    def test_faces_that_are_left_out_take_their_names_with_them(self, tmp_path):
        text = f"{SQUARE}v nan 0 0\ng a\nf 1 2 6\nf 1 2 3\ng b\nf 1 2 5\n"
        assert labels(tmp_path / "a.obj", text) == ["a", "b"]

    def test_text_stl_has_the_names_of_its_solids(self, tmp_path):
        facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        text = f"solid seat\n{facet}{facet}endsolid seat\nsolid leg\n{facet}endsolid\n"
        assert labels(tmp_path / "a.stl", text) == ["seat", "seat", "leg"]

    def test_glb_has_the_names_of_nodes_as_another_program_writes_them(self, tmp_path):
        scene = trimesh.Scene()
        scene.add_geometry(trimesh.creation.box(), node_name="seat", geom_name="g0")
        high = trimesh.transformations.translation_matrix([0, 2, 0])
        scene.add_geometry(trimesh.creation.box(), node_name="back", geom_name="g1", transform=high)
        assert labels(tmp_path / "a.glb", scene.export(file_type="glb")) == ["seat"] * 12 + ["back"] * 12

    def test_glb_has_the_names_of_materials(self, tmp_path):
        scene = trimesh.Scene()
        for name in ("oak", "steel"):
            box = trimesh.creation.box()
            box.visual = trimesh.visual.TextureVisuals(material=trimesh.visual.material.PBRMaterial(name=name))
            scene.add_geometry(box, node_name=f"part of {name}", geom_name=name)
        found = labels(tmp_path / "a.glb", scene.export(file_type="glb"))
        assert dict.fromkeys(found) == dict.fromkeys(["part of oak (oak)", "part of steel (steel)"])

    def test_3mf_has_the_names_of_objects_and_their_materials(self, tmp_path):
        looks = '<basematerials id="9"><base name="red"/><base name="blue"/></basematerials>'
        parts = object_(1, mesh(), 'name="lid" pid="9" pindex="1"') + object_(2, mesh(), 'name="box" pid="9"')
        data = single(model(looks + parts, 'objectid="1"', f'objectid="2" {moved(4)}'))
        assert list(read(written(tmp_path, data))[0].labels) == ["lid (blue)"] * 12 + ["box (red)"] * 12

    def test_a_component_without_a_name_has_that_of_the_object_that_holds_it(self, tmp_path):
        held = object_(1, mesh()) + object_(2, '<components><component objectid="1"/></components>', 'name="lid"')
        data = single(model(held + object_(3, mesh(), 'name="box"'), 'objectid="2"', f'objectid="3" {moved(4)}'))
        assert list(read(written(tmp_path, data))[0].labels) == ["lid"] * 12 + ["box"] * 12

    def test_collada_has_the_names_of_nodes_or_of_those_above(self, tmp_path):
        below = f"<node><translate>2 0 0</translate>{show()}</node>"
        nodes = f'<node name="seat">{show()}{below}</node><node name="back">{show()}</node>'
        found = labels(tmp_path / "a.dae", document(nodes))
        assert [label for label, after in zip(found, [*found[1:], None], strict=True) if label != after] == [
            "seat",
            "back",
        ]


@pytest.mark.parametrize("up", ["y", "z"])
def test_a_reference_keeps_them_when_it_is_turned_and_scaled(tmp_path, up):
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box((2, 3, 4)), node_name="seat")
    scene.add_geometry(trimesh.creation.box((1, 1, 9)), node_name="back")
    (tmp_path / "a.glb").write_bytes(io.BytesIO(scene.export(file_type="glb")).getvalue())
    shape = Collection.load(tmp_path, up=up)["a"].turned(1).shape
    assert isinstance(shape, Mesh)
    assert shape.label_names == ("seat", "back")
    tall = shape.vertices[shape.faces[np.array(shape.labels) == "back"]].reshape(-1, 3)
    assert np.ptp(tall, axis=0).max() == pytest.approx(1.0)
