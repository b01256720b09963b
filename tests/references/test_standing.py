import numpy as np
import pytest
import trimesh

from shapewright.axes.turns import TURNS
from shapewright.modelling.solids import box
from shapewright.references import Collection, Orientation
from shapewright.references.standing import axes_record, found_axes, recorded_orientation
from shapewright.shapes import Points
from shapewright.shapes.files import encode


def chair(width):
    shape = box((width, 0.08, 0.9), at=(0, 0.45, 0)) | box((width, 0.6, 0.08), at=(0, 0.75, -0.41))
    for x, z in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        shape = shape | box((0.08, 0.45, 0.08), at=(x * (width / 2 - 0.04), 0.225, z * 0.41))
    return shape.mesh()


WIDTHS = (0.7, 0.75, 0.8, 0.9, 1.0, 1.1)
FILE = Orientation("-x", "y")  # how the files of these tests stand


@pytest.fixture
def folder(tmp_path):
    for width in WIDTHS:
        mesh = chair(width).transformed(FILE.matrix.T)
        (tmp_path / f"chair {width}.obj").write_bytes(encode(mesh, "obj"))
    return tmp_path


def test_up_and_front_are_found(folder):
    found = Collection.load(folder, up="auto")
    assert (found.up, found.front, found.taught) == ("auto", None, False)
    for reference in found:
        width = float(reference.name.split()[1])
        assert (reference.orientation, reference.axes_by) == (FILE, "found")
        np.testing.assert_allclose(reference.shape.bounds, chair(width).normalised().bounds, atol=1e-6)
        ends = reference.to_original(reference.shape.vertices)
        assert np.ptp(ends, axis=0)[1] == pytest.approx(0.9, abs=1e-4)  # their depth is along the files' y


def test_the_author_is_believed_where_a_manifest_says_more(folder):
    (folder / "list.csv").write_text("path,up,front\nchair 0.7.obj,,\nchair 0.8.obj,z,\nchair 0.9.obj,,\n")
    found = Collection.load(folder / "list.csv", up="auto")
    assert [(r.orientation.up, r.axes_by) for r in found] == [("-x", "found"), ("z", "author"), ("-x", "found")]


def test_of_a_front_that_is_told_only_the_up_is_found(folder):
    found = Collection.load(folder, up="auto", front="Y")
    assert {reference.orientation for reference in found} == {FILE}
    assert {r.orientation.front for r in Collection.load(folder, up="auto", front="-z")} == {"-z"}


def test_tidy_files_stay_as_they_are(folder):
    tidy = Collection.of({str(width): chair(width) for width in WIDTHS}, up="auto")
    assert {(reference.orientation, reference.axes_by) for reference in tidy} == {(Orientation(), "default")}


def test_a_procedures_shapes_are_asked_again_from_the_start(folder):
    sideways = [chair(width).transformed(TURNS[2]) for width in np.linspace(0.6, 1.2, 30)]
    found = Collection.load(folder, up="auto").stood(sideways)
    assert found.taught
    assert {reference.orientation for reference in found} == {FILE.then(TURNS[2])}


def test_what_was_found_is_recorded_and_taken_up_again(folder):
    found = Collection.load(folder, up="auto")
    records = {reference.name: axes_record(reference) for reference in found}
    assert (
        records["chair 0.7"].items() >= {"up": "-x", "front": "y", "by": "found", "has_up": True, "fronts": 1}.items()
    )
    again = Collection.load(folder).oriented({name: recorded_orientation(each) for name, each in records.items()})
    for before, after in zip(found, again, strict=True):
        np.testing.assert_allclose(after.shape.vertices, before.shape.vertices, atol=1e-12)


def test_what_a_run_has_found_stays_so_and_the_author_may_still_change_it(folder):
    found = Collection.load(folder, up="auto")
    records = {reference.name: axes_record(reference) for reference in found}
    records["chair 0.7"] |= {"up": "z", "front": "x"}
    records["chair 0.9"] |= {"up": "z", "front": "x", "by": "author"}  # which he has taken back since
    (folder / "shapewright.csv").write_text("path,up,front\nchair 0.8.obj,y,z\n")
    again = Collection.load(folder, up="auto").stood(recorded=found_axes({"axes": records}))
    standing = {each.name: (each.orientation, each.axes_by) for each in again}
    assert standing["chair 0.7"] == (Orientation("z", "x"), "found")
    assert standing["chair 0.75"] == standing["chair 0.9"] == (FILE, "found")
    assert standing["chair 0.8"] == (Orientation("y", "z"), "author")
    assert axes_record(again["chair 0.75"]) == records["chair 0.75"]
    np.testing.assert_allclose(again["chair 0.75"].shape.vertices, found["chair 0.75"].shape.vertices, atol=1e-12)


def test_a_procedure_that_builds_z_up_does_not_lay_down_what_is_found_to_stand():
    tidy = Collection.of({str(width): chair(width) for width in WIDTHS}, up="auto")
    assert {reference.orientation for reference in tidy.standing("z")} == {Orientation()}
    block = Collection.of({"block": box((1, 0.4, 0.6)).mesh()})  # nothing was looked for
    assert {reference.orientation for reference in block.standing("z")} == {Orientation.of("z")}


def points_of(mesh, seed=0, count=6000):
    """Evenly spread over a surface."""
    return Points(trimesh.Trimesh(mesh.vertices, mesh.faces, process=False).sample(count, seed=seed))


def test_points_are_found_to_stand_as_meshes_are():
    given = {str(width): points_of(chair(width)).transformed(FILE.matrix.T) for width in WIDTHS}
    taught = [chair(width) for width in np.linspace(0.6, 1.2, 30)]
    found = Collection.of(given, up="auto").stood(taught)
    assert {(reference.orientation, reference.axes_by) for reference in found} == {(FILE, "found")}
    for reference in found:
        right = chair(float(reference.name)).normalised()
        np.testing.assert_allclose(reference.shape.bounds, right.bounds, atol=0.01)


def test_points_that_lie_on_their_floor_keep_its_up_and_the_author_may_still_tell_a_front():
    ground = points_of(box((3, 0.001, 3), at=(0, -0.001, 0)).mesh(), 1)
    scans = {}
    for width in WIDTHS:
        both = Points(np.concatenate([points_of(chair(width)).positions, ground.positions]))
        scans[str(width)] = both.transformed(Orientation("z", "x").matrix.T)
    taught = [chair(width) for width in np.linspace(0.6, 1.2, 30)]
    lying = [mesh.transformed(Orientation("x", "y").matrix.T) for mesh in taught]  # as if chairs lay on their sides
    for shapes, fronts in ((taught, {"x"}), (lying, {"x", "-x", "y", "-y"})):
        found = Collection.of(scans, up="auto").stood(shapes)
        assert {reference.orientation.up for reference in found} == {"z"}
        assert {reference.orientation.front for reference in found} <= fronts
    assert {reference.orientation.front for reference in Collection.of(scans, up="auto", front="z")} == {"z"}


def test_drawings_have_no_axes_to_find(tmp_path):
    (tmp_path / "a.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><path d="M0 0h9v9z"/></svg>'
    )
    (reference,) = Collection.load(tmp_path, up="auto")
    assert reference.finding is None
    assert axes_record(reference) == {"up": "y", "front": "z", "by": "default"}
