from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import trimesh

from shapewright.comparison.light_field import cache as descriptor_cache
from shapewright.comparison.light_field.cache import described_once
from shapewright.comparison.light_field.description import Descriptor, describe
from shapewright.shapes import Mesh


def box(*size: float) -> Mesh:
    made = trimesh.creation.box(extents=size)
    return Mesh(made.vertices, made.faces)


def same(a: Descriptor, b: Descriptor) -> bool:
    return a.bits == b.bits and np.array_equal(a.coefficients, b.coefficients)


@pytest.fixture
def described(monkeypatch: pytest.MonkeyPatch) -> list[Mesh]:
    """The meshes that were really described."""
    meshes: list[Mesh] = []

    def count(mesh: Mesh, bits: int = 4) -> Descriptor:
        meshes.append(mesh)
        return describe(mesh, bits)

    monkeypatch.setattr(descriptor_cache, "describe", count)
    return meshes


def test_a_mesh_is_described_once(tmp_path: Path, described: list[Mesh]):
    first = described_once(box(1, 2, 3), tmp_path / "new" / "folder")
    again = described_once(box(1, 2, 3), tmp_path / "new" / "folder")
    assert len(described) == 1
    assert same(first, again)
    assert same(first, describe(box(1, 2, 3)))


def test_other_geometry_and_other_bits_are_other_entries(tmp_path: Path, described: list[Mesh]):
    wanted = ((box(1, 2, 3), 4), (box(1, 2, 2.5), 4), (box(1, 2, 3), 8))
    results = [described_once(mesh, tmp_path, bits) for mesh, bits in wanted]
    assert len(described) == 3
    assert [result.bits for result in results] == [4, 4, 8]
    assert same(described_once(box(1, 2, 3), tmp_path, bits=8), results[2])
    assert len(described) == 3


def test_another_format_is_not_read(tmp_path: Path, described: list[Mesh], monkeypatch: pytest.MonkeyPatch):
    described_once(box(1, 2, 3), tmp_path)
    monkeypatch.setattr(descriptor_cache, "FORMAT", descriptor_cache.FORMAT + 1)
    described_once(box(1, 2, 3), tmp_path)
    assert len(described) == 2


@pytest.mark.parametrize("damage", ["empty", "cut", "flipped", "other arrays", "folder"])
def test_a_damaged_file_is_replaced(tmp_path: Path, described: list[Mesh], damage: str):
    expected = described_once(box(1, 2, 3), tmp_path)
    (path,) = tmp_path.iterdir()
    whole = path.read_bytes()
    if damage == "other arrays":
        np.savez(path, coefficients=np.zeros((3, 3)))
    elif damage == "folder":
        path.unlink()
        path.mkdir()
    else:
        middle = len(whole) // 2
        flipped = whole[:middle] + bytes([whole[middle] ^ 255]) + whole[middle + 1 :]
        path.write_bytes({"empty": b"", "cut": whole[:middle], "flipped": flipped}[damage])
    if damage == "folder":
        with pytest.raises(OSError, match=path.name):
            described_once(box(1, 2, 3), tmp_path)
        return
    assert same(described_once(box(1, 2, 3), tmp_path), expected)
    assert path.read_bytes() == whole
    assert len(described) == 2


def test_many_writers_at_once(tmp_path: Path):
    meshes = [box(1, 2, 1 + n % 3) for n in range(24)]
    with ThreadPoolExecutor(8) as pool:
        results = list(pool.map(lambda mesh: described_once(mesh, tmp_path), meshes))
    assert all(same(result, results[n % 3]) for n, result in enumerate(results))
    assert len(list(tmp_path.iterdir())) == 3


def test_a_failed_write_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez", full)
    with pytest.raises(OSError, match="No space left"):
        described_once(box(1, 2, 3), tmp_path)
    assert list(tmp_path.iterdir()) == []
