import struct

import numpy as np
import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.pcd import read_pcd

PLACES = np.array([[0.5, 0, 0], [1, 2, 3], [-4, 5, np.nan]])
NORMALS = np.array([[0, 0, 1], [0, 1, 0], [1, 0, 0]], dtype=float)


def header(data: str, points: int = 3, **lines: str) -> str:
    """As the page of the Point Cloud Library gives it; lines replace its own, an empty one is left out."""
    usual = {
        "VERSION": ".7",
        "FIELDS": "x y z",
        "SIZE": "4 4 4",
        "TYPE": "F F F",
        "COUNT": "1 1 1",
        "WIDTH": f"{points}",
        "HEIGHT": "1",
        "VIEWPOINT": "0 0 0 1 0 0 0",
        "POINTS": f"{points}",
    } | lines
    kept = [f"{key} {value}\n" for key, value in usual.items() if value]
    return "# .PCD v.7 - Point Cloud Data file format\n" + "".join(kept) + f"DATA {data}\n"


def literals(data: bytes) -> bytes:
    return b"".join(bytes([len(data[i : i + 32]) - 1]) + data[i : i + 32] for i in range(0, len(data), 32))


def packed(data: bytes, size: int | None = None) -> bytes:
    small = literals(data)
    return struct.pack("<II", len(small), len(data) if size is None else size) + small


def as_text(table: np.ndarray) -> bytes:
    return "\n".join(" ".join(f"{x:g}" for x in row) for row in table).encode() + b"\n"


ENCODED = {
    "ascii": as_text(PLACES),
    "binary": PLACES.astype("<f4").tobytes(),
    "binary_compressed": packed(PLACES.T.astype("<f4").tobytes()),
}


@pytest.mark.parametrize("encoding", ENCODED)
def test_the_points_of_each_encoding(encoding):
    cloud = read_pcd(header(encoding).encode() + ENCODED[encoding])
    assert np.array_equal(cloud.positions, PLACES, equal_nan=True)
    assert cloud.normals is None and cloud.seen_from is None and cloud.notes == ()


@pytest.mark.parametrize("encoding", ENCODED)
def test_fields_of_any_type_and_count_stand_between(encoding):
    row = np.dtype([("rgb", "<u4"), ("z", "<f8"), ("vfh", "<i2", (3,)), ("y", "<f4"), ("x", "<f4"), ("ring", "u1")])
    table = np.zeros(3, dtype=row)
    table["x"], table["y"], table["z"] = PLACES.T
    table["rgb"], table["vfh"], table["ring"] = 7, [1, 2, 3], 9
    names = list(row.names)
    says = {"FIELDS": " ".join(names), "SIZE": "4 8 2 4 4 1", "TYPE": "U F I F F U", "COUNT": "1 1 3 1 1 1"}
    flat = np.column_stack([table[name].reshape(3, -1).astype(float) for name in names])
    body = {
        "ascii": as_text(flat),
        "binary": table.tobytes(),
        "binary_compressed": packed(b"".join(table[name].reshape(3, -1).T.tobytes() for name in names)),
    }[encoding]
    cloud = read_pcd(header(encoding, **says).encode() + body)
    assert np.array_equal(cloud.positions, PLACES, equal_nan=True)
    assert cloud.notes == ("1 fields left out, such as 'vfh'",)


def test_normals_and_where_the_sensor_stood_are_kept():
    says = {"FIELDS": "x y z normal_x normal_y normal_z", "SIZE": "4 " * 6, "TYPE": "F " * 6, "COUNT": "1 " * 6}
    says["VIEWPOINT"] = "1 2 3 1 0 0 0"
    cloud = read_pcd(header("ascii", **says).encode() + as_text(np.hstack([PLACES, NORMALS])))
    assert (cloud.normals == NORMALS).all()
    assert (cloud.seen_from == [1, 2, 3]).all()


def test_a_picture_of_depths_has_rows_and_columns():
    assert len(read_pcd(header("ascii", WIDTH="1", HEIGHT="3").encode() + ENCODED["ascii"]).positions) == 3


def test_files_of_older_versions_say_less():
    old = "VERSION .5\nFIELDS x y z\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n"
    assert len(read_pcd(old.encode() + ENCODED["ascii"]).positions) == 3
    assert len(read_pcd(b"COLUMNS x y z\nWIDTH 3\nDATA ascii\n" + ENCODED["ascii"]).positions) == 3


@pytest.mark.parametrize("encoding", ENCODED)
def test_a_file_has_to_be_used_up(encoding):
    whole = header(encoding).encode() + ENCODED[encoding]
    assert len(read_pcd(whole + b"\0\n").positions) == 3
    with pytest.raises(UnreadableError, match=r"cut short|broken"):
        read_pcd(whole[:-5])
    with pytest.raises(UnreadableError, match="broken"):
        read_pcd(whole + b"1 2 3\n")
    with pytest.raises(UnreadableError, match=r"cut short|broken"):
        read_pcd(header(encoding, points=2_000_000_000).encode() + ENCODED[encoding])


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (header("ascii", FIELDS="x y i").encode() + b"1 2 3\n" * 3, "no field 'z', only x, y, i"),
        (header("ascii", TYPE="F F Q").encode() + b"1 2 3\n" * 3, "'z' is of a type that is not known"),
        (header("ascii", COUNT="1 1 0").encode() + b"1 2\n" * 3, "fields without size, type or count"),
        (header("ascii", SIZE="4 4").encode() + b"1 2\n" * 3, "fields without size, type or count"),
        (header("ascii", COUNT="1 1 1000000000").encode() + b"1 2\n" * 3, "fields without size, type or count"),
        (header("ascii", POINTS="4").encode() + ENCODED["ascii"], "declares 4 points, and 3 x 1 of them"),
        (header("ascii", WIDTH="").encode() + ENCODED["ascii"], "says nothing of 'WIDTH'"),
        (header("zip").encode() + ENCODED["ascii"], "'zip', which is not known"),
        (header("ascii").encode() + b"1 2 3\n1 2 3\n1 2 3 4\n", "point 3 has 4 values, and its header 3 fields"),
        (header("ascii").encode() + b"1 2 3\n1 2 3\n1 2 x\n", "'x' is no number"),
        (header("binary_compressed").encode() + packed(b"abc", 36), "cannot be unpacked"),
        (header("binary_compressed").encode() + packed(b"abc", 35), "3 points cannot be packed as 35 bytes in 4"),
        (header("binary_compressed", points=100_000).encode() + packed(b"abc", 1_200_000), "cannot be packed"),
        (header("binary_compressed").encode() + b"\0\0\0", "cut short"),
        (b"FIELDS x y z\n1 2 3\n", "cannot understand the line '1 2 3'"),
        (b"FIELDS x y z\nFIELDS x y\n", "cannot understand the line 'FIELDS x y'"),
        (b"# .PCD v.7\nFIELDS x y z", "no PCD header"),
        (b"\x89PNG", "no PCD header"),
    ],
)
def test_what_is_not_understood_is_refused(content, why):
    with pytest.raises(UnreadableError, match=why):
        read_pcd(content)
