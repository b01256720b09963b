"""Assets of scene_synthesizer, unedited, with their ranges beside them."""

import sys
from pathlib import Path

import numpy as np
import pytest

import shapewright as sw

pytest.importorskip("scene_synthesizer", reason="needs scene-synthesizer; run `make test-adapters`")

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "generators" / "scene_synthesizer"
SPECS = sorted(FOLDER.glob("*.toml"))


def test_there_are_ten():
    assert len(SPECS) == 10


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_an_asset_is_a_procedure_without_a_change(path):
    asset = sw.load_procedure(path)
    assert asset.facts.stated == {"up": "z", "unit": "m", "size": "given"}
    for values in asset.space.sample(12, seed=3):
        shape = asset(**values)
        assert shape.soundness().closed
    wide = asset(**asset.space.defaults | {"width": 1.3 * asset.space.defaults["width"]})
    assert wide.extent[0] > asset(**asset.space.defaults).extent[0]


def test_parts_keep_their_names_and_the_table_stands_upright():
    table = sw.load_procedure(FOLDER / "table.toml")
    shape = table(**table.space.defaults | {"width": 1.2, "depth": 0.7, "height": 0.75})
    assert set(shape.label_names) == {"top", *(f"leg_{i}" for i in range(4))}
    np.testing.assert_allclose(shape.extent, [1.2, 0.75, 0.7])


def test_the_same_table_comes_from_another_python(tmp_path):
    spec = FOLDER / "table.toml"
    elsewhere = tmp_path / "table.toml"
    elsewhere.write_text(f'python = "{sys.executable}"\n{spec.read_text()}')
    far, near = sw.load_procedure(elsewhere)(width=1.5), sw.load_procedure(spec)(width=1.5)
    assert set(far.label_names) == set(near.label_names) and len(far.faces) == len(near.faces)
    np.testing.assert_allclose(far.bounds, near.bounds, atol=1e-6)


def test_an_asset_that_is_returned_is_a_shape():
    from scene_synthesizer.procedural_assets import MugAsset, TableAsset

    @sw.procedure(up="z")
    def table(tall: bool = False):
        return TableAsset(1.0, 0.5, 0.9 if tall else 0.4)

    assert table(tall=True).extent[1] == pytest.approx(0.9)

    @sw.procedure(up="z")
    def mug(tall: bool = False):
        return MugAsset().scene()

    assert len(mug().faces) == 716
