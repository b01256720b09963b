import numpy as np
import pytest
import shapely

import shapewright as sw
from broken_disk import full_after
from shapewright.modelling.solids import box
from shapewright.references import Collection
from shapewright.references.silhouette_drawings import write_silhouettes
from shapewright.shapes import Drawing, Mesh, concatenate

TOP, LEG = box((1, 0.1, 0.6), at=(0, 0.65, 0)), box((0.1, 0.6, 0.1), at=(0.4, 0.3, 0.2))
TABLE = concatenate([TOP.mesh(), LEG.mirror("x", keep=True).mirror("z", keep=True).mesh()])
FRONT = shapely.union_all(
    [shapely.box(-0.5, 0.6, 0.5, 0.7), *(shapely.box(x - 0.05, 0, x + 0.05, 0.6) for x in (-0.4, 0.4))]
)


def overlap(drawing, geometry):
    ours, theirs = drawing.normalised().geometry, Drawing(geometry).normalised().geometry
    return ours.intersection(theirs).area / ours.union(theirs).area


@pytest.mark.parametrize("format", ["svg", "png"])
def test_written_silhouettes_are_references(tmp_path, format):
    sheet = Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, 1]]), np.array([[0, 1, 2]]))
    meshes = Collection.of({"a table": TABLE, "sheet": sheet})
    paths, unseen = write_silhouettes(meshes, tmp_path / "out", format=format)
    assert [path.name for path in paths] == [f"a-table.{format}"] and "no area" in unseen["sheet"]
    drawings = Collection.load(tmp_path / "out")
    assert overlap(drawings["a-table"].shape, FRONT) > 0.99
    with pytest.raises(FileExistsError, match="already"):
        write_silhouettes(meshes, tmp_path / "out")
    with pytest.raises(sw.CollectionError, match="drawings already"):
        write_silhouettes(drawings, tmp_path / "other")


def test_a_full_disk_leaves_no_drawings(tmp_path):
    with pytest.raises(OSError, match="File too large"), full_after(100):
        write_silhouettes(Collection.of({"table": TABLE}), tmp_path / "out", threads=1)
    assert not list(tmp_path.iterdir())
