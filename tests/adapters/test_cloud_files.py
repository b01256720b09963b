"""Files of points that other libraries write, read by our readers."""

import sys

import numpy as np
import pytest

import shapewright as sw
from scanned import seen
from shapewright.modelling.solids import box
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import contents
from shapewright.shapes.conversion import as_reference

WHY = "needs the extra [points]; run `make test-adapters`"
SCAN = seen(box((1.0, 0.4, 0.7)).mesh(), 3000)
PLACES = np.round(SCAN.positions, 3) + np.array([20.0, -3.0, 1.0])
NORMALS = np.tile([0.6, 0.0, 0.8], (len(PLACES), 1))


@pytest.mark.parametrize("end", ["las", "laz"])
@pytest.mark.parametrize(("version", "kind"), [("1.2", 0), ("1.2", 3), ("1.3", 1), ("1.4", 6), ("1.4", 7), ("1.4", 10)])
def test_las_and_laz_of_every_version(tmp_path, end, version, kind):
    laspy = pytest.importorskip("laspy", reason=WHY)
    las = laspy.LasData(laspy.LasHeader(version=version, point_format=kind))
    las.header.scales, las.header.offsets = [0.001] * 3, [20.0, -3.0, 1.0]
    las.x, las.y, las.z = PLACES.T
    las.withheld = np.arange(len(PLACES)) % 10 == 0
    path = tmp_path / f"a.{end}"
    las.write(path)
    found = contents(path)
    assert found.up == "z"
    assert np.allclose(found.shape.positions, PLACES[np.arange(len(PLACES)) % 10 != 0], atol=1e-9)
    assert found.notes == ("300 of 3000 points left out: marked as withheld",)
    data = path.read_bytes()
    for broken in (data[:-100], data[:300], *([data + b"12345"] if end == "las" else [])):
        path.write_bytes(broken)
        with pytest.raises(UnreadableError, match=r"cut short|broken"):
            contents(path)


def test_laz_that_announces_more_than_there_is_is_refused_before_memory_is_taken(tmp_path):
    laspy = pytest.importorskip("laspy", reason=WHY)
    las = laspy.LasData(laspy.LasHeader(version="1.2", point_format=0))
    las.x, las.y, las.z = PLACES.T
    path = tmp_path / "a.laz"
    las.write(path)
    data = path.read_bytes()
    points = int.from_bytes(data[96:100], "little")
    table = int.from_bytes(data[points : points + 8], "little")
    for at, why in ((table + 4, r"announces \d+ chunks"), (100, "records do not fit"), (25, r"LAS 1\.255")):
        path.write_bytes(data[:at] + b"\xff\xff\xff\x7f" + data[at + 4 :])
        with pytest.raises(UnreadableError, match=why):
            contents(path)
    path.write_bytes(data[:points] + b"\xff" * 8 + data[points + 8 :] + table.to_bytes(8, "little"))
    assert len(contents(path).shape) == len(PLACES)


def test_all_scans_of_an_e57_stand_where_their_poses_put_them(tmp_path):
    pye57 = pytest.importorskip("pye57", reason=WHY)
    path = tmp_path / "a.e57"
    half = np.sqrt(0.5)
    with pye57.E57(str(path), mode="w") as file:
        for rotation, translation in (((1, 0, 0, 0), (5, 0, 0)), ((half, 0, 0, half), (0, 7, 0))):
            columns = {f"cartesian{axis}": PLACES[:, i] for i, axis in enumerate("XYZ")}
            file.write_scan_raw(columns, rotation=np.array(rotation), translation=np.array(translation))
    found = contents(path)
    assert found.unit == 1.0 and found.notes == ()
    turned = PLACES @ np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1.0]])  # by 90 degrees about Z
    assert np.allclose(
        found.shape.positions, np.concatenate([PLACES + np.array([5, 0, 0]), turned + np.array([0, 7, 0])]), atol=1e-6
    )
    assert (found.shape.seen_from[[0, -1]] == [[5, 0, 0], [0, 7, 0]]).all()
    data = path.read_bytes()
    for broken in (data[:-1000], data + b"1", data[:2000] + bytes([data[2000] ^ 1]) + data[2001:]):
        path.write_bytes(broken)
        with pytest.raises(UnreadableError, match=r"declares|checksum mismatch, file is corrupted$"):
            contents(path)


@pytest.mark.parametrize(("text", "order"), [(True, "="), (False, "<"), (False, ">")])
def test_ply_of_plyfile(tmp_path, text, order):
    plyfile = pytest.importorskip("plyfile", reason=WHY)
    rows = np.zeros(len(PLACES), dtype=[(name, "f8") for name in (*"xyz", "nx", "ny", "nz")] + [("red", "u1")])
    for i, axis in enumerate("xyz"):
        rows[axis], rows[f"n{axis}"] = PLACES[:, i], NORMALS[:, i]
    element = plyfile.PlyElement.describe(rows, "vertex")
    plyfile.PlyData([element], text=text, byte_order=order).write(str(tmp_path / "a.ply"))
    found = contents(tmp_path / "a.ply")
    assert np.allclose(found.shape.positions, PLACES, atol=1e-9)
    assert np.allclose(found.shape.normals, NORMALS)


@pytest.mark.parametrize(
    ("end", "options"),
    [
        ("pcd", {"write_ascii": True}),
        ("pcd", {}),
        ("pcd", {"compressed": True}),
        ("ply", {"write_ascii": True}),
        ("ply", {}),
        ("xyz", {}),
        ("xyzn", {}),
        ("pts", {}),
    ],
)
def test_files_of_open3d_and_its_point_clouds(tmp_path, end, options):
    open3d = pytest.importorskip("open3d", reason="needs Open3D, which is for this test alone", exc_type=ImportError)
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(PLACES))
    cloud.normals = open3d.utility.Vector3dVector(NORMALS)
    assert np.allclose(as_reference(cloud).normals, NORMALS)
    path = tmp_path / f"a.{end}"
    assert open3d.io.write_point_cloud(str(path), cloud, **options)
    theirs = open3d.io.read_point_cloud(str(path))
    ours = contents(path).shape
    assert np.allclose(ours.positions, np.asarray(theirs.points), atol=1e-6)
    assert np.allclose(ours.positions, PLACES, atol=1e-4)
    if theirs.has_normals():
        assert np.allclose(ours.normals, np.asarray(theirs.normals), atol=1e-5)


def test_a_folder_of_every_kind_is_a_collection(tmp_path):
    laspy, pye57 = (pytest.importorskip(name, reason=WHY) for name in ("laspy", "pye57"))
    las = laspy.LasData(laspy.LasHeader(version="1.4", point_format=6))
    las.header.scales, las.header.offsets = [0.001] * 3, [20.0, -3.0, 1.0]
    las.x, las.y, las.z = PLACES.T
    las.write(tmp_path / "a.laz")
    with pye57.E57(str(tmp_path / "b.e57"), mode="w") as file:
        file.write_scan_raw({f"cartesian{axis}": PLACES[:, i] for i, axis in enumerate("XYZ")})
    np.savetxt(tmp_path / "c.xyz", PLACES)
    refs = sw.Collection.load(tmp_path, up="z")
    assert not refs.skipped
    extents = np.array([one.shape.extent for one in refs])
    assert np.allclose(extents, extents[0], atol=2e-3)


def test_without_the_libraries_the_command_is_told(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pye57", None)
    path = tmp_path / "a.e57"
    path.write_bytes(b"ASTM-E57" + bytes(8) + (48).to_bytes(8, "little") + bytes(24))
    with pytest.raises(UnreadableError, match=r"pip install 'shapewright\[points\]'"):
        contents(path)
