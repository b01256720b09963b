"""Every file of points of a folder, as our readers and Open3D read it.

The environment variable SHAPEWRIGHT_PUBLIC_MODELS names the folder, for example with clones of PointCloudLibrary/data,
PointCloudLibrary/pcl and PDAL/PDAL.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import contents
from shapewright.shapes import Points

FOLDER = os.environ.get("SHAPEWRIGHT_PUBLIC_MODELS")
KINDS = (".pcd", ".pts", ".xyz", ".xyzn", ".ply")
LARGEST = 50_000_000  # bytes
CLOUDS = sorted(path for path in Path(FOLDER).rglob("*") if path.suffix.lower() in KINDS) if FOLDER else []
KNOWN = {
    "too few to show a surface": "we ask for a hundred points",
    "it declares 8 points and holds 9": "PDAL's bunny_8.pts has a point more than it says; Open3D passes it over",
    "decimals need a point": "PDAL's utm17_comma.pcd has commas between its numbers, which PCD has not",
    "no field 'x'": "pictures and descriptors of PCL, which Open3D reads as no points",
    "cannot understand the line": "a PCD without a header",
    "no property 'z'": "points in the plane, to which Open3D adds what was in memory",
}


@pytest.mark.skipif(not FOLDER, reason="SHAPEWRIGHT_PUBLIC_MODELS names no folder of public models")
@pytest.mark.parametrize("path", CLOUDS or [Path()], ids=str)
def test_a_cloud_is_read_as_open3d_reads_it_or_the_difference_is_known(path):
    open3d = pytest.importorskip("open3d", reason="needs Open3D, which is for this test alone", exc_type=ImportError)
    if path.stat().st_size > LARGEST:
        pytest.skip(f"larger than {LARGEST} bytes")
    cloud = open3d.io.read_point_cloud(str(path), remove_nan_points=True, remove_infinite_points=True)
    theirs = np.asarray(cloud.points)
    try:
        ours = contents(path).shape
    except UnreadableError as error:
        assert not len(theirs) or any(words in str(error) for words in KNOWN), error
        return
    if not isinstance(ours, Points) or not len(theirs):
        return  # a mesh, which other suites compare; fields with capital letters, which Open3D does not know
    assert len(ours) == len(theirs)
    scale = max(np.abs(theirs).max(), 1e-12)
    assert np.allclose(ours.positions / scale, theirs / scale, atol=1e-6)
    if cloud.has_normals() and ours.normals is not None:
        normals = np.nan_to_num(np.asarray(cloud.normals))
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        assert np.allclose(ours.normals, normals / np.where(lengths > 0.0, lengths, 1.0), atol=1e-3)
