from types import SimpleNamespace

import numpy as np
import pytest

import shapewright as sw
from scanned import seen
from shapewright.modelling.solids import box
from shapewright.runs.inputs import references_of


@pytest.mark.parametrize("keep", [(), ("floor", "strays")])
def test_references_are_loaded_as_they_were(tmp_path, keep):
    np.savetxt(tmp_path / "stand.xyz", seen(box(1).mesh(), 4000, floor=1.2).positions)
    refs = sw.Collection.load(tmp_path, keep=keep)
    record = {"source": refs.source, "origins": list(refs.origins), "keep": list(refs.keep)}
    again = references_of(SimpleNamespace(collection=record, names=refs.names))
    assert again.keep == keep
    assert [one.digest for one in again] == [one.digest for one in refs]
