"""Messages of large meshes that are kept."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from shapewright.studio.project.stores import shape_store
from shapewright.studio.project.stores.shape_store import LARGE, keep_message, kept_message


def test_large_messages_are_kept_and_small_ones_are_not(tmp_path: Path) -> None:
    keep_message(tmp_path / "shapes" / "a.mesh", b"x" * LARGE)
    keep_message(tmp_path / "shapes" / "b.mesh", b"x")
    keep_message(None, b"x" * LARGE)
    assert kept_message(tmp_path / "shapes" / "a.mesh") == b"x" * LARGE
    assert kept_message(tmp_path / "shapes" / "b.mesh") is None
    assert kept_message(None) is None


def test_the_oldest_make_room(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shape_store, "_MOST", 2 * LARGE)
    for age, name in enumerate("abc"):
        keep_message(tmp_path / f"{name}.mesh", name.encode() * LARGE)
        os.utime(tmp_path / f"{name}.mesh", (age, age))
    keep_message(tmp_path / "d.mesh", b"d" * LARGE)
    assert sorted(path.stem for path in tmp_path.glob("*.mesh")) == ["c", "d"]


def test_a_cache_that_cannot_be_written_is_done_without(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    keep_message(tmp_path / "file" / "a.mesh", b"x" * LARGE)
