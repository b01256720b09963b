"""STEP and IGES as cadquery writes them, read by our reader and measured by OpenCASCADE."""

import pytest

cadquery = pytest.importorskip("cadquery", reason="the extra cadquery is not installed")
pytest.importorskip("cascadio", reason="the extra cad is not installed")

import numpy as np  # noqa: E402

from shapewright.references.errors import UnreadableError  # noqa: E402
from shapewright.references.readers.formats import contents  # noqa: E402


def volume(shape) -> float:
    corners = shape.triangles
    return float((corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6)


def bracket():
    plate = cadquery.Workplane("XY").box(40, 20, 4).faces(">Z").workplane().hole(8)
    return plate.union(cadquery.Workplane("XY").box(4, 20, 30).translate((18, 0, 15))).edges("|Y").fillet(1.0)


@pytest.mark.parametrize("name", ["a.step", "a.stp"])
def test_a_part_has_the_volume_and_the_bounds_that_opencascade_measures(tmp_path, name):
    part = bracket()
    cadquery.exporters.export(part, str(tmp_path / name), "STEP")
    found = contents(tmp_path / name)
    assert found.unit == 1.0 and found.notes == ()
    solid = part.val()
    assert volume(found.shape) * 1e9 == pytest.approx(solid.Volume(), rel=5e-3)
    box = solid.BoundingBox()
    least, greatest = found.shape.bounds * 1e3
    assert least.tolist() == pytest.approx([box.xmin, box.ymin, box.zmin], abs=0.05)
    assert greatest.tolist() == pytest.approx([box.xmax, box.ymax, box.zmax], abs=0.05)


@pytest.mark.parametrize("size", [0.1, 10.0, 1e4])
def test_triangles_are_as_fine_whatever_the_size(tmp_path, size):
    cadquery.exporters.export(cadquery.Workplane("XY").sphere(size), str(tmp_path / "a.step"))
    found = contents(tmp_path / "a.step").shape
    assert volume(found) * 1e9 == pytest.approx(4 / 3 * np.pi * size**3, rel=0.03)
    assert 200 < len(found.faces) < 5000


def test_parts_of_an_assembly_keep_their_names_and_places(tmp_path):
    leg = cadquery.Workplane("XY").box(2, 2, 20)
    table = cadquery.Assembly(name="table")
    for i, x in enumerate((-10, 10)):
        table.add(leg, name=f"leg {i}", loc=cadquery.Location(cadquery.Vector(x, 0, 0)), color=cadquery.Color("red"))
    table.add(cadquery.Workplane("XY").box(30, 10, 2).translate((0, 0, 11)), name="top")
    table.export(str(tmp_path / "a.step"))
    found = contents(tmp_path / "a.step").shape
    assert (found.extent * 1e3).tolist() == pytest.approx([30, 10, 22], rel=1e-5)
    assert {"leg 0", "leg 1", "top"} <= {(label or "").partition(" (")[0] for label in found.labels}


@pytest.mark.parametrize("unit", ["MM", "IN", "M"])
def test_iges_is_read_and_prints_nothing(tmp_path, capfd, unit):
    from OCP.IGESControl import IGESControl_Writer

    writer = IGESControl_Writer(unit, 1)
    writer.AddShape(cadquery.Workplane("XY").box(1, 2, 3).val().wrapped)
    writer.ComputeModel()
    assert writer.Write(str(tmp_path / "a.igs"))
    capfd.readouterr()
    found = contents(tmp_path / "a.igs")
    assert capfd.readouterr().out == ""
    assert (found.shape.extent * found.unit * 1e3).tolist() == pytest.approx([1, 2, 3], rel=1e-5)


def test_a_file_that_opencascade_finds_broken_is_refused_and_nothing_printed(tmp_path, capfd):
    cadquery.exporters.export(cadquery.Workplane("XY").box(1, 1, 1), str(tmp_path / "a.step"))
    text = (tmp_path / "a.step").read_text()
    (tmp_path / "b.step").write_text(text.replace("ADVANCED_FACE(", "ADVANCED_FACE(,,", 1))
    capfd.readouterr()
    with pytest.raises(UnreadableError, match="broken: OpenCASCADE says ERR StepFile : Incorrect Syntax"):
        contents(tmp_path / "b.step")
    assert capfd.readouterr() == ("", "")


def test_nothing_is_read_of_a_file_without_shapes(tmp_path):
    cadquery.exporters.export(cadquery.Workplane("XY").box(1, 1, 1), str(tmp_path / "a.step"))
    head, _, _ = (tmp_path / "a.step").read_text().partition("DATA;")
    (tmp_path / "b.step").write_text(f"{head}DATA;\nENDSEC;\nEND-ISO-10303-21;\n")
    with pytest.raises(UnreadableError, match=r"no shape|Incorrect Syntax"):
        contents(tmp_path / "b.step")
