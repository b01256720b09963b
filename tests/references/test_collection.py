import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import shapely
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

import shapewright as sw
from shapewright.references import Collection, CollectionError, Orientation
from shapewright.references.orientation import AXES
from shapewright.shapes import Drawing, Mesh
from shapewright.shapes.files import encode
from threemf_files import mesh, model, object_, single

SHARED = Path(__file__).resolve().parents[2].parent / "shared"
ORIENTATIONS = [(up, front) for up in AXES for front in AXES if up[-1] != front[-1]]

# A wedge that no rotation maps onto itself; Z up, front -Y: 2 wide, 1 deep, 4 high, away from the origin.
WEDGE = np.array([[10, 20, 30], [12, 20, 30], [10, 21, 30], [10, 20, 34]], dtype=float)
FACES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def obj(vertices=WEDGE, faces=FACES) -> str:
    lines = ["v {} {} {}".format(*vertex) for vertex in np.asarray(vertices).tolist()]
    return "\n".join(lines + ["f {} {} {}".format(*face) for face in (np.asarray(faces) + 1).tolist()])


@pytest.fixture
def folder(tmp_path):
    for name in ("chair10", "chair9", "Bench"):
        (tmp_path / f"{name}.obj").write_text(obj())
    (tmp_path / "broken.ply").write_bytes(b"ply\n")
    (tmp_path / "empty.stl").write_bytes(b"")
    (tmp_path / "chair9.mtl").write_text("newmtl wood")
    return tmp_path


class TestLoad:
    def test_what_can_be_read_is_there_in_natural_order_and_the_rest_has_a_reason(self, folder):
        refs = sw.Collection.load(folder)
        assert len(refs) == 3
        assert refs.names == ("Bench", "chair9", "chair10")
        assert [reference.name for reference in refs] == list(refs.names)
        assert refs["chair9"].path == folder / "chair9.obj"
        assert refs.skipped == {
            folder / "broken.ply": "broken: no PLY header",
            folder / "empty.stl": "the file is empty",
        }
        assert refs.source == str(folder)
        assert repr(refs) == f"Collection(3 references from {folder}, 2 skipped)"

    def test_equal_shapes_are_both_kept_and_have_one_digest(self, folder):
        refs = Collection.load(folder)
        assert len({reference.digest for reference in refs}) == 1
        (folder / "Bench.obj").write_text(obj(faces=FACES[1:]))
        assert len({reference.digest for reference in Collection.load(folder)}) == 2

    def test_a_manifest_turns_each_file_its_way(self, folder):
        (folder / "list.csv").write_text("path,up\nBench.obj,z\nchair9.obj,\nnone.obj,\n")
        refs = Collection.load(folder / "list.csv")
        np.testing.assert_array_equal(refs["Bench"].shape.extent, [0.5, 1.0, 0.25])
        np.testing.assert_array_equal(refs["chair9"].shape.extent, [0.5, 0.25, 1.0])
        assert refs.skipped == {folder / "none.obj": "no such file or directory"}

    def test_any_iterable_of_sources(self, folder):
        refs = Collection.load(path for path in (folder / "Bench.obj", str(folder / "chair*.obj")))
        assert refs.names == ("Bench", "chair9", "chair10")
        assert refs.source == f"{folder / 'Bench.obj'} and 1 more"

    def test_notes_say_what_of_a_file_was_left_out(self, tmp_path):
        (tmp_path / "a.obj").write_text(obj() + "\nv nan 0 0\nf 1 2 5")
        assert Collection.load(tmp_path)["a"].notes == ("1 of 5 triangles left out: a corner is not finite",)

    def test_every_file_broken(self, tmp_path):
        for i in range(8):
            (tmp_path / f"{i}.off").write_text("nonsense")
        with pytest.raises(CollectionError) as error:
            Collection.load(tmp_path)
        first, *reasons = str(error.value).splitlines()
        assert first == "none of the 8 files can be read:"
        assert reasons[0].startswith(f"  {tmp_path / '0.off'}: broken: does not begin with OFF")
        assert reasons[-1] == "  and 3 more"
        assert len(reasons) == 6

    def test_the_only_file_broken(self, tmp_path):
        (tmp_path / "a.obj").write_text("f 1 2 3")
        with pytest.raises(
            CollectionError, match=r"the only file cannot be read:\n .*a\.obj: broken: faces point outside"
        ):
            Collection.load(tmp_path / "a.obj")

    def test_a_name_that_is_not_there(self, folder):
        refs = Collection.load(folder)
        assert "chair9" in refs
        assert "chair8" not in refs
        with pytest.raises(KeyError, match="no reference 'chair8' among 3; there is chair9"):
            refs["chair8"]


class TestNormalisation:
    def test_z_up_becomes_y_up_front_to_z_centred_with_extent_1(self, tmp_path):
        (tmp_path / "a.obj").write_text(obj())
        reference = Collection.load(tmp_path, up="z")["a"]
        np.testing.assert_allclose(reference.shape.bounds, [[-0.25, -0.5, -0.125], [0.25, 0.5, 0.125]])
        # The file's first corner is its left, lower, front one (its front is -Y): so it stays.
        np.testing.assert_allclose(reference.shape.vertices[0], [-0.25, -0.5, 0.125])
        assert reference.orientation == Orientation("z", "-y")
        np.testing.assert_array_equal(reference.shape.faces, FACES)

    @given(
        npst.arrays(np.float64, (6, 3), elements=st.floats(-1e3, 1e3, width=32)),
        st.sampled_from(ORIENTATIONS),
    )
    def test_to_original_undoes_it(self, vertices, axes):
        vertices[:3] = WEDGE[:3]
        reference = Collection.of({"a": (vertices, [[0, 1, 2], [3, 4, 5]])}, up=axes[0], front=axes[1])["a"]
        np.testing.assert_allclose(reference.to_original(reference.shape.vertices), vertices, rtol=0, atol=1e-9)
        turned = vertices @ reference.orientation.matrix.T
        np.testing.assert_array_equal(reference.transform.apply(turned), reference.shape.vertices)
        np.testing.assert_allclose(reference.shape.bounds.mean(axis=0), 0, atol=1e-12)
        assert reference.shape.extent.max() == pytest.approx(1.0)


class TestInMemory:
    def test_every_form_of_a_mesh(self):
        shapes = {
            "m10": sw.Mesh(WEDGE, FACES),
            "m9": trimesh.Trimesh(WEDGE, FACES, process=False),
            "arrays": (WEDGE.tolist(), FACES.tolist()),
        }
        refs = Collection.of(shapes)
        assert refs.names == ("arrays", "m9", "m10")
        assert len({reference.digest for reference in refs}) == 1
        assert {reference.path for reference in refs} == {None}
        assert refs.source == "memory"

    @pytest.mark.parametrize(
        ("shape", "message"),
        [
            ("a.obj", "^seat: str is no shape; give a Mesh, a trimesh"),
            (None, "^seat: NoneType is no shape"),
            ((WEDGE, FACES + 9), "^seat: faces point outside the 4 vertices"),
            ((WEDGE * np.nan, FACES), "^seat: .*not finite"),
            ((WEDGE, FACES * 0), "^seat: .*no size"),
            ((WEDGE * [1, 0, 0], FACES), "^seat: its triangles have no area"),
        ],
    )
    def test_what_cannot_be_used(self, shape, message):
        with pytest.raises(CollectionError, match=message):
            Collection.of({"seat": shape})

    def test_drawings_are_normalised_too(self):
        references = Collection.of({"seat": shapely.box(2, 0, 6, 2), "back": Drawing(shapely.box(0, 0, 1, 1))})
        seat = references["seat"]
        assert references.kind is Drawing
        assert seat.shape.bounds == pytest.approx(np.array([[-0.5, -0.25], [0.5, 0.25]]))
        assert seat.to_original([[0.5, 0.25]]) == pytest.approx(np.array([[6, 2]]))
        assert seat.digest != references["back"].digest

    def test_meshes_and_drawings_do_not_mix(self):
        with pytest.raises(
            CollectionError, match=r"1 meshes or points and 1 drawings \(leg, ...\) in one collection; load one"
        ):
            Collection.of({"seat": (WEDGE, FACES), "leg": shapely.box(0, 0, 1, 1)})

    def test_no_shapes(self):
        with pytest.raises(CollectionError, match="at least one"):
            Collection.of({})


def test_mesh_files_that_need_no_trimesh_do_not_import_it(folder):
    code = f"import sys, shapewright; len(shapewright.Collection.load({str(folder / '*.obj')!r})); print(*sys.modules)"
    modules = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert "numpy" in modules
    assert not {"trimesh", "torch"} & set(modules)


@pytest.mark.skipif(
    not (SHARED / "data" / "references").is_dir(), reason="the open reference shapes are not beside the project"
)
@pytest.mark.parametrize(("source", "count"), [("furniture", 134), ("cuboids/table", 100), ("manifest.csv", 434)])
def test_the_open_references_load_whole(source, count):
    refs = Collection.load(SHARED / "data" / "references" / source)
    assert len(refs) == count
    assert refs.skipped == {}
    assert all(reference.notes == () for reference in refs)
    for reference in refs:
        # They are normalised already, to float32.
        np.testing.assert_allclose(reference.transform.centre, 0, atol=1e-5)
        assert reference.transform.scale == pytest.approx(1.0, abs=1e-5)
        np.testing.assert_allclose(reference.shape.extent.max(), 1.0)


class TestWhatAFormatSays:
    """Of its axes and its unit."""

    @pytest.fixture
    def wedge(self, tmp_path):
        package = single(model(object_(1, mesh(WEDGE, FACES)), 'objectid="1"', attributes='unit="centimeter"'))
        (tmp_path / "wedge.3mf").write_bytes(package)
        return tmp_path / "wedge.3mf"

    def test_a_3mf_is_z_up_and_its_size_is_known(self, wedge):
        (reference,) = Collection.load(wedge)
        assert (reference.orientation, reference.axes_by) == (Orientation("z", "-y"), "format")
        assert reference.unit == 0.01
        np.testing.assert_allclose(reference.size, [0.02, 0.04, 0.01])  # width, height, depth
        np.testing.assert_allclose(reference.to_original(reference.shape.bounds).min(axis=0), WEDGE.min(axis=0))

    @pytest.mark.parametrize("word", [{"up": "x"}, {"front": "x"}])
    def test_the_author_knows_better(self, wedge, word):
        (reference,) = Collection.load(wedge, **word)
        assert (reference.orientation, reference.axes_by) == (Orientation.of(**word), "author")

    def test_so_does_a_manifest_that_says_y(self, wedge):
        wedge.with_name("list.csv").write_text("path,up\nwedge.3mf,y\nwedge.3mf,\n")
        first, second = Collection.load(wedge.with_name("list.csv"))
        assert (first.orientation.up, first.axes_by) == ("y", "author")
        assert (second.orientation.up, second.axes_by) == ("z", "format")

    def test_gltf_is_in_metres_and_obj_in_nothing(self, tmp_path):
        (tmp_path / "a.glb").write_bytes(encode(Mesh(WEDGE, FACES)))
        (tmp_path / "b.obj").write_text(obj())
        a, b = Collection.load(tmp_path)
        assert (a.orientation, a.axes_by, a.unit) == (Orientation(), "format", 1.0)
        assert (b.orientation, b.axes_by, b.unit) == (Orientation(), "default", None)
        np.testing.assert_allclose(a.size, [2, 1, 4])
        np.testing.assert_allclose(b.size, [2, 1, 4])
