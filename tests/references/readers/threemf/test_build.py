import numpy as np
import pytest

from gltf_files import CUBE
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from threemf_files import BEAMS, SLICES, archive, components, mesh, model, moved, object_, relations, single, written

BOOLEAN = "http://schemas.3mf.io/3dmanufacturing/booleanoperations/2023/07"
LATTICE = f'<b:beamlattice radius="1" xmlns:b="{BEAMS}"><b:beams><b:beam v1="0" v2="7"/></b:beams></b:beamlattice>'


def cubes(tmp_path, data: bytes):
    """The least and the greatest corner of each cube that is built, and the notes."""
    found, notes = read(written(tmp_path, data))
    corners = found.vertices.reshape(-1, 8, 3)
    return np.stack([corners.min(axis=1), corners.max(axis=1)], axis=1).tolist(), notes


def reason(tmp_path, data: bytes) -> str:
    with pytest.raises(UnreadableError) as error:
        read(written(tmp_path, data))
    return str(error.value)


def with_parts(root: str, **parts: str) -> bytes:
    named = {f"3D/{name}.model": text for name, text in parts.items()}
    return archive({"_rels/.rels": relations("/3D/3dmodel.model"), "3D/3dmodel.model": root, **named})


class TestPlaces:
    def test_every_item_stands_where_it_is_put(self, tmp_path):
        data = single(model(object_(1, mesh()), 'objectid="1"', f'objectid="1" {moved(4)}'))
        assert cubes(tmp_path, data) == ([[[0, 0, 0], [1, 1, 1]], [[4, 0, 0], [5, 1, 1]]], ())

    def test_components_stand_in_the_frame_of_their_object(self, tmp_path):
        turn = 'transform="0 2 0 -2 0 0 0 0 2 0 0 0"'
        pair = object_(2, components('objectid="1"', f'objectid="1" {moved(3)}'))
        data = single(model(object_(1, mesh()) + pair + object_(3, components(f'objectid="2" {moved(0, 0, 9)}')),
                            f'objectid="3" {turn}'))  # fmt: skip
        assert cubes(tmp_path, data)[0] == [[[-2, 0, 18], [0, 2, 20]], [[-2, 6, 18], [0, 8, 20]]]

    def test_an_object_may_have_a_mesh_and_be_named_after_it_is_used(self, tmp_path):
        data = single(model(object_(2, components('objectid="1"')) + object_(1, mesh()), 'objectid="2"'))
        assert len(cubes(tmp_path, data)[0]) == 1

    def test_objects_that_nothing_builds_are_no_part_of_it(self, tmp_path):
        data = single(model(object_(1, mesh()) + object_(2, mesh(2 * CUBE)), 'objectid="1"'))
        assert cubes(tmp_path, data)[0] == [[[0, 0, 0], [1, 1, 1]]]

    def test_what_is_mirrored_keeps_its_outside(self, tmp_path):
        data = single(model(object_(1, mesh()), 'objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"'))
        corners = read(written(tmp_path, data))[0].triangles
        assert (corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6 == pytest.approx(1.0)


class TestParts:
    def test_items_and_components_find_objects_of_other_parts_by_path_and_number(self, tmp_path):
        first, second = model(object_(1, mesh())), model(object_(1, mesh(2 * CUBE)))
        group = object_(
            2, components('p:path="/3D/a.model" objectid="1"', f'p:path="/3D/b.model" objectid="1" {moved(5)}')
        )
        root = model(
            object_(1, mesh(3 * CUBE)) + group, 'objectid="2"', 'objectid="1"', 'objectid="1" p:path="/3d/B.model"'
        )
        found, notes = cubes(tmp_path, with_parts(root, a=first, b=second))
        assert found == [
            [[0, 0, 0], [1, 1, 1]],
            [[5, 0, 0], [7, 2, 2]],
            [[0, 0, 0], [3, 3, 3]],
            [[0, 0, 0], [2, 2, 2]],
        ]
        assert notes == ()

    def test_components_without_path_are_of_their_own_part(self, tmp_path):
        part = model(object_(1, mesh(2 * CUBE)) + object_(7, components('objectid="1"')))
        root = model(object_(1, mesh()), 'objectid="7" p:path="/3D/a.model"')
        assert cubes(tmp_path, with_parts(root, a=part))[0] == [[[0, 0, 0], [2, 2, 2]]]

    def test_the_build_of_another_part_is_no_part_of_it(self, tmp_path):
        part = model(object_(1, mesh()), 'objectid="1"', f'objectid="1" {moved(50)}')
        root = model("", 'objectid="1" p:path="/3D/a.model"')
        assert cubes(tmp_path, with_parts(root, a=part))[0] == [[[0, 0, 0], [1, 1, 1]]]

    def test_parts_in_other_units_are_brought_to_that_of_the_build(self, tmp_path):
        part = model(object_(1, mesh()), attributes='unit="inch"')
        root = model("", f'objectid="1" p:path="/3D/a.model" {moved(2)}', attributes='unit="centimeter"')
        np.testing.assert_allclose(cubes(tmp_path, with_parts(root, a=part))[0], [[[2, 0, 0], [4.54, 2.54, 2.54]]])

    def test_what_is_not_there_is_named(self, tmp_path):
        root = model(object_(1, mesh()), 'objectid="1" p:path="/3D/a.model"')
        assert "needs its part /3d/a.model, which is missing" in reason(tmp_path, single(root))
        assert "object 1 of /3d/a.model, which is not there" in reason(tmp_path, with_parts(root, a=model("")))
        assert "object 9 of /3d/3dmodel.model" in reason(tmp_path, single(model("", 'objectid="9"')))

    def test_a_part_that_is_broken_is_named(self, tmp_path):
        root = model("", 'objectid="1" p:path="/3D/a.model"')
        assert "(part /3d/a.model)" in reason(tmp_path, with_parts(root, a="<model"))


class TestOtherForms:
    def test_beams_are_noted(self, tmp_path):
        data = single(
            model(object_(1, mesh()) + object_(2, mesh(9 * CUBE, [], LATTICE)), 'objectid="1"', 'objectid="2"')
        )
        found, notes = read(written(tmp_path, data))
        assert found.bounds.tolist() == [[0, 0, 0], [1, 1, 1]]
        assert notes == ("1 x lattice of beams left out",)

    def test_beams_alone_are_the_reason(self, tmp_path):
        data = single(model(object_(2, mesh(9 * CUBE, [], LATTICE)), 'objectid="2"'))
        assert reason(tmp_path, data) == "no triangles, only beams, which are not read"

    def test_a_mesh_that_is_a_sketch_of_slices_is_refused(self, tmp_path):
        sketch = object_(1, mesh(), f'xmlns:s="{SLICES}" s:slicestackid="3" s:meshresolution="lowres"')
        assert "slice extension" in reason(tmp_path, single(model(sketch, 'objectid="1"')))
        assert len(cubes(tmp_path, single(model(sketch + object_(2, mesh()), 'objectid="2"')))[0]) == 1

    def test_an_object_of_another_form_is_refused_by_name(self, tmp_path):
        shape = f'<bo:booleanshape xmlns:bo="{BOOLEAN}" objectid="1"><bo:boolean objectid="1"/></bo:booleanshape>'
        data = single(model(object_(1, mesh()) + object_(3, shape), 'objectid="3"'))
        assert reason(tmp_path, data) == f"an object is <booleanshape> of {BOOLEAN}, which is not read"

    def test_another_form_beside_a_mesh_is_noted(self, tmp_path):
        other = '<x:tetrahedra xmlns:x="http://example.org/x"/>'
        _, notes = read(written(tmp_path, single(model(object_(1, mesh(more=other)), 'objectid="1"'))))
        assert notes == ("1 x <tetrahedra> of http://example.org/x passed over",)

    @pytest.mark.parametrize("kind", ["support", "solidsupport", "other"])
    def test_what_only_supports_is_left_out_with_a_note(self, tmp_path, kind):
        support = object_(2, mesh(3 * CUBE), f'type="{kind}"')
        pair = object_(3, components('objectid="1"', 'objectid="2"'))
        found, notes = cubes(tmp_path, single(model(object_(1, mesh()) + support + pair, 'objectid="3"')))
        assert found == [[[0, 0, 0], [1, 1, 1]]]
        assert notes == (f"1 x object of the type '{kind}' left out",)


class TestHostileBuilds:
    def test_nothing_to_build_is_a_reason(self, tmp_path):
        why = "nothing is to be built: its build section is empty or missing"
        assert reason(tmp_path, single(model(object_(1, mesh())))) == why
        assert reason(tmp_path, single(model(object_(1, mesh())).replace("<build></build>", ""))) == why

    def test_components_of_themselves_are_refused(self, tmp_path):
        ring = object_(1, components('objectid="2"')) + object_(2, components('objectid="1"'))
        assert "object 1 of /3d/3dmodel.model is a component of itself" in reason(
            tmp_path, single(model(ring, 'objectid="1"'))
        )

    def test_components_that_double_with_each_level_are_refused(self, tmp_path):
        levels = [object_(i, components(f'objectid="{i - 1}"', f'objectid="{i - 1}"')) for i in range(2, 60)]
        data = single(model(object_(1, mesh()) + "".join(levels), 'objectid="59"'))
        assert "triangles, more than the 10,000,000 that are read" in reason(tmp_path, data)
        empty = single(model(object_(1, mesh([], [])) + "".join(levels), 'objectid="59"'))
        assert "more than 200,000 places" in reason(tmp_path, empty)

    def test_a_tower_of_components_is_refused(self, tmp_path):
        levels = [object_(i, components(f'objectid="{i - 1}"')) for i in range(2, 5000)]
        data = single(model(object_(1, mesh()) + "".join(levels), 'objectid="4999"'))
        assert "more than 100 levels of components" in reason(tmp_path, data)
