import numpy as np

from shapewright.references import Orientation
from shapewright.references.sources import Source
from shapewright.studio.project.listing import Origin, kept_picture, listing


def test_a_folder_of_points_is_solid(tmp_path):
    np.savetxt(tmp_path / "scan.xyz", np.eye(3))
    assert listing(Origin(str(tmp_path))).dimension == 3


def test_what_is_kept_of_a_scan_is_part_of_its_pictures_name(tmp_path):
    np.savetxt(tmp_path / "scan.xyz", np.eye(3))
    pictures = []
    for keep in ((), ("floor",)):
        found = listing(Origin(str(tmp_path), keep=keep))
        assert found.sources["scan"].keep == keep
        pictures.append(kept_picture(tmp_path, found.sources["scan"]))
    assert pictures[0] != pictures[1]
    assert pictures[0] == kept_picture(tmp_path, Source("other", tmp_path / "scan.xyz", Orientation.of("y")))


def test_what_a_manifest_leaves_out_is_told_and_not_read(tmp_path):
    for name in "ab":
        np.savetxt(tmp_path / f"{name}.xyz", np.eye(3))
    (tmp_path / "list.csv").write_text("path,leave_out\na.xyz,\nb.xyz,yes\n")
    found = listing(Origin(str(tmp_path / "list.csv")))
    assert [*found.sources] == ["a"] and found.skipped == {tmp_path / "b.xyz": "left out by the manifest"}
