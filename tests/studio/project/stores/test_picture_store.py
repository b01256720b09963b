"""Pictures that pages ask for."""

from pathlib import Path

import pytest

from shapewright.studio.project.stores.picture_store import Pictures
from shapewright.studio.project.workspace import Missing


def read(pictures: Pictures, address: str) -> bytes:
    return pictures.read(Path(address).stem)


def test_what_was_shown_a_moment_ago_is_forgotten_the_next_time(tmp_path: Path) -> None:
    pictures = Pictures(tmp_path)
    first, second = pictures.add(b"first"), pictures.add(b"second")
    pictures.keep({second})
    assert read(pictures, first) == b"first"  # a page may be asking for it
    pictures.keep({second})
    assert read(pictures, second) == b"second"
    with pytest.raises(Missing):
        read(pictures, first)
    assert pictures.add(b"first") == first
    pictures.keep(set())
    assert read(pictures, first) == b"first"
    pictures.keep(set())
    with pytest.raises(Missing):
        read(pictures, first)


def test_files_are_read_as_long_as_they_are_there(tmp_path: Path) -> None:
    pictures, file = Pictures(tmp_path), tmp_path / "a.png"
    file.write_bytes(b"kept")
    address = pictures.add_file(file)
    assert address
    pictures.keep(set())
    pictures.keep(set())
    assert read(pictures, address) == b"kept"
    file.unlink()
    with pytest.raises(Missing):
        read(pictures, address)
    assert pictures.add_file(file) is None
