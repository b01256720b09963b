import numpy as np
import pytest

import shapewright as sw
from scanned import sampled, seen, strewn
from shapewright.modelling.solids import box
from shapewright.references import CollectionError
from shapewright.references.scans.cleaning import MOST, cleaned
from shapewright.references.scans.steps import KEPT, kept

STAND = box((0.8, 0.06, 0.6), at=(0, 0.4, 0)) | box((0.1, 0.8, 0.1)) | box((0.5, 0.05, 0.5), at=(0, -0.4, 0))
SCAN = strewn(seen(STAND.mesh(), 30_000, floor=1.2), 150)


def test_each_step_says_what_it_did():
    points, notes = cleaned(SCAN)
    assert [note.split(":")[0] for note in notes] == [
        f"a floor left out, {notes[0].split()[4]} of the points",
        notes[1],
        "normals estimated, outwards",
    ]
    assert notes[1].endswith("stray points left out")
    assert np.allclose(points.extent, [0.94, 1.0, 0.7], atol=0.06)
    assert points.normals is not None


@pytest.mark.parametrize("step", KEPT)
def test_each_step_can_be_left_out(step):
    said = {"floor": "floor", "strays": "stray", "density": "uneven"}[step]
    scan = SCAN.positions
    uneven = sw.Points(np.concatenate([scan, *[scan[scan[:, 1] > 0.3]] * 12]) + np.tile(1e-3, 3))
    jitter = np.random.default_rng(0).normal(scale=3e-3, size=uneven.positions.shape)
    uneven = sw.Points(uneven.positions + jitter)
    assert any(said in note for note in cleaned(uneven)[1])
    assert not any(said in note for note in cleaned(uneven, (step,))[1])


def test_clean_points_lose_nothing():
    points = sampled(STAND.mesh())
    found, notes = cleaned(points)
    assert found is points
    assert notes == ()


def test_many_points_are_thinned_and_keep_what_is_known_of_them():
    points = sampled(STAND.mesh(), 100_000)
    points = sw.Points(points.positions, points.normals, points.positions + points.normals)
    found, notes = cleaned(points)
    assert 0.9 * MOST < len(found) <= MOST
    assert np.allclose(found.seen_from - found.positions, found.normals)
    assert notes == (f"thinned evenly: {len(found):,} of 100,000 points are used",)


def test_the_same_points_give_the_same_result():
    assert (cleaned(SCAN)[0].positions == cleaned(SCAN)[0].positions).all()


def test_words_of_steps():
    assert kept([]) == () and kept(["strays", "floor", "floor"]) == ("floor", "strays") and kept("floor") == ("floor",)
    with pytest.raises(CollectionError, match="keep='walls' is nothing that is taken from a scan; use floor, strays"):
        kept(["walls"])


class TestReference:
    def test_a_scan_in_a_collection_stands_on_the_floor_that_was_found(self):
        turned = sw.Points(SCAN.positions @ np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]))  # Z up
        (reference,) = sw.Collection.of({"stand": turned})
        assert reference.notes[0] == "z points up: the floor says so"
        assert reference.orientation.up == "z" and reference.axes_by == "floor"
        assert reference.shape.extent.argmax() == 1
        back = reference.to_original(reference.shape.positions)
        low, high = turned.bounds
        assert (back > low - 1e-9).all() and (back < high + 1e-9).all()

    def test_the_authors_word_for_what_is_up_wins(self):
        (reference,) = sw.Collection.of({"stand": SCAN}, up="z")
        assert reference.orientation.up == "z" and reference.axes_by == "author"

    def test_a_floor_can_be_kept(self):
        (reference,) = sw.Collection.of({"stand": SCAN}, keep=["floor"])
        assert reference.shape.extent.argmin() == 1
        assert not any("floor" in note for note in reference.notes)

    def test_files_are_cleaned_as_well_and_the_collection_knows_what_was_kept(self, tmp_path):
        np.savetxt(tmp_path / "stand.xyz", SCAN.positions, fmt="%.5f")
        (reference,) = sw.Collection.load(tmp_path)
        assert any("floor" in note for note in reference.notes)
        refs = sw.Collection.load(tmp_path, keep=["floor", "strays"])
        assert refs.keep == ("floor", "strays")
        assert not any("floor" in note or "stray" in note for note in refs.references[0].notes)
        with pytest.raises(CollectionError, match="keep='wall'"):
            sw.Collection.load(tmp_path, keep="wall")
