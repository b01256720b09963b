from pathlib import Path

import pytest

from shapewright.references.archives import is_archive
from shapewright.references.other_kinds import _BY_EXTENSION, _KINDS, refusal
from shapewright.references.readers.formats import EXTENSIONS


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("a.blend", "a Blender file, which is not read: open it in Blender"),
        ("a.SLDPRT", "a CAD model, which is not read: export it from a CAD program"),
        ("a.ptx", "a point cloud, which is not read: open it in CloudCompare"),
        ("a.obj.gz", "an archive, which is not read: unpack it"),
        ("a.skp", "SketchUp, which is not read: export it from its own program"),
        ("a.3ds", "3D Studio, which is not read: open it in Blender"),
        ("a.wrl", "VRML, which is not read: open it in Blender"),
        ("a.kmz", "unpack it as ZIP"),
        ("a.b3dm", "take the GLB out of it"),
        ("a.obj.dvc", "fetch the file with `dvc pull`"),
    ],
)
def test_a_known_kind_is_named_with_the_way_out(name, said):
    assert said in refusal(Path(name))


@pytest.mark.parametrize("name", ["wood.tga", "a.mtl", "list.json", "readme", "a.bin"])
def test_what_lies_beside_shapes_is_no_kind_of_shapes(name):
    assert refusal(Path(name)) is None


def test_no_kind_that_is_read_is_refused():
    assert not set(EXTENSIONS) & set(_BY_EXTENSION)
    assert is_archive(Path("a.tar.gz")) and not is_archive(Path("a.obj.gz"))


def test_no_extension_is_named_twice():
    ends = [end for ends in _KINDS.values() for end in ends.split()]
    assert len(set(ends)) == len(ends)
