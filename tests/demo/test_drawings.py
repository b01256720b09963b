import numpy as np
import pytest

import shapewright as sw
from shapewright.comparison.pictures import intersection_over_union
from shapewright.demo import drawings, procedures
from shapewright.references import Collection


def test_fifty_different_drawings_the_same_every_time():
    tables, again = drawings.tables(), drawings.tables()
    assert len(tables) == sum(drawings.COUNTS.values()) == 50
    for name, table in tables.items():
        assert table.geometry.is_valid and table.geometry.geom_type == "Polygon", name
        assert table.geometry.equals(again[name].geometry)
    areas = [round(table.geometry.area, 6) for table in tables.values()]
    assert len(set(areas)) == 50


def test_they_are_written_as_files_that_read_back(tmp_path):
    paths = drawings.write(tmp_path)
    assert {path.suffix for path in paths} == {".svg", ".png"}
    loaded = Collection.load(tmp_path)
    assert len(loaded) == 50 and not loaded.skipped
    for name, table in drawings.tables().items():
        assert intersection_over_union(loaded[name].shape, table) > 0.98, name


@pytest.mark.parametrize("version", [*procedures.VERSIONS, "bench"])
def test_every_version_draws_whatever_the_parameters(version):
    procedure = sw.load_procedure(procedures.path(version, drawn=True))
    for values in procedure.space.sample(150, seed=4):
        shape = procedure(**values)
        assert isinstance(shape, sw.Drawing) and shape.geometry.is_valid
        width, height = np.ptp(shape.bounds, axis=0)
        if version != "bench":
            assert height > values["height"] - 0.02 and 0.99 < width < 2.5
