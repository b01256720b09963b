import struct
import sys

import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.las import read_las
from shapewright.references.readers.formats import read


def las(count: int, declared: int | None = None, kind: int = 0) -> bytes:
    """LAS 1.2, format 0, by the specification: the header of 227 bytes, and points of 20."""
    declared = count if declared is None else declared
    head = b"LASF" + bytes(20) + bytes([1, 2]) + bytes(64) + struct.pack("<HHH", 1, 2026, 227)
    head += struct.pack("<IIBHI5I", 227, 0, kind, 20, declared, *[0] * 5)
    head += struct.pack("<12d", 0.01, 0.01, 0.01, 100.0, 0.0, 0.0, *[0.0] * 6)
    points = b"".join(struct.pack("<3iHBBBBH", i, i * i % 1000, i % 7, 0, 9, 1, 0, 0, 1) for i in range(count))
    assert len(head) == 227
    return head + points


def test_a_file_ends_with_the_points_that_it_declares(tmp_path):
    for content, why in (
        (las(200)[:-1], "cut short: it declares 200 points of 20 bytes"),
        (las(200, 100), "broken: 2000 bytes follow the 100 points"),
        (las(200, 4_000_000_000), "cut short: it declares 4000000000 points"),
        (las(200)[:100], "does not begin as LAS does"),
        (b"\x89PNG" * 100, "does not begin as LAS does"),
    ):
        with pytest.raises(UnreadableError, match=why):
            read_las(tmp_path, content)


def test_a_missing_library_is_named_with_the_command_that_installs_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "laspy", None)
    monkeypatch.setitem(sys.modules, "pye57", None)
    (tmp_path / "a.las").write_bytes(las(200))
    whole = b"ASTM-E57" + struct.pack("<IIQ", 1, 0, 48) + bytes(24)
    (tmp_path / "a.e57").write_bytes(whole)
    for name in ("a.las", "a.e57"):
        with pytest.raises(UnreadableError, match=r"pip install 'shapewright\[points\]'"):
            read(tmp_path / name)
