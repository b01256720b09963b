"""The board of a collection: what is told once stays told once, and only what helps is told as an alarm."""

import json
from pathlib import Path

from shapewright.references.orientation import Orientation
from shapewright.references.sources import Source
from shapewright.runs.folder import FORMAT, RECORD
from shapewright.settings import Settings
from shapewright.studio.project.listing import Listing
from shapewright.studio.project.stores.picture_store import Pictures
from shapewright.studio.session.board import lay_out
from shapewright.studio.session.standard import Standard


def a_run(folder: Path, **record: object) -> Path:
    (folder / "runs" / "001").mkdir(parents=True)
    whole = {
        "format": FORMAT, "settings": Settings().record(), "references": [], "groups": [],
        "collection": {"skipped": {}}, "threshold": 0.18, **record,
    }  # fmt: skip
    (folder / "runs" / "001" / RECORD).write_text(json.dumps(whole))
    return folder / "runs" / "001"


def listed(folder: Path, *names: str) -> Listing:
    sources = [Source(name, folder / "references" / name, Orientation.of("y", None)) for name in names]
    return Listing({f"s{i}": source for i, source in enumerate(sources)}, {})


def test_a_file_that_was_skipped_under_another_path_is_told_once(tmp_path):
    listing = listed(tmp_path, "a.obj", "sub/a.obj", "b.obj")
    told = {"references/sub/a.obj": "no triangles", "/elsewhere/references/b.obj": "cut short", "gone.obj": "no file"}
    run = a_run(tmp_path, collection={"skipped": told})
    board = lay_out(listing, Pictures(tmp_path), {}, run, None, Standard.of(Settings(), 3))
    here = tmp_path / "references"
    assert board.skipped == {str(here / "sub" / "a.obj"): "no triangles", str(here / "b.obj"): "cut short"}
    again = board.without("s2", str(here / "b.obj"), "cut short in line 3")
    assert len(again.skipped) == 2 and again.skipped[str(here / "b.obj")] == "cut short in line 3"


def test_a_range_is_told_only_where_a_longer_one_would_bring_something(tmp_path):
    board = lay_out(listed(tmp_path, "a.obj", "b.obj"), Pictures(tmp_path), {}, None, None, Standard.of(Settings(), 3))
    board = board.with_reference("s0", at_limit=["height"]).with_reference("s1", at_limit=["height", "leg"])
    assert [tile.longer for tile in board.collection().tiles] == [[], []]
    wish = {"parameter": "height", "value": 1.4, "end": 1.2, "side": "high"}
    causes = [{"kind": "missing part", "evidence": {}}, {"kind": "out of range", "evidence": {"wishes": [wish]}}]
    told = board.explained_by({"references": {"b.obj": {"causes": causes}, "a.obj": {"causes": []}}})
    assert [tile.longer for tile in told.collection().tiles] == [[], ["height"]]
