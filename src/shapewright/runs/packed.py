"""Files of large runs, packed in tars with an index: any program unpacks them, and one is read without the others."""

from __future__ import annotations

import io
import tarfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

INDEX = "files.parquet"
"""In a run's folder: where each packed file is. ``path`` in the run, ``tar`` that holds it, ``offset`` and ``size``."""
_HEADER = 512  # bytes of a tar before each file, and what files are padded to


@dataclass(frozen=True)
class Packed:
    """A file in a tar."""

    tar: Path
    offset: int
    size: int

    def read(self) -> bytes:
        """What it holds. Raises OSError."""
        with self.tar.open("rb") as file:
            file.seek(self.offset)
            return file.read(self.size)


class Packer:
    """Packs the files of some folders of a run, each into a tar of the folder's name; see ``packing``."""

    def __init__(self, run: Path) -> None:
        self._run = run
        self._tars: dict[str, tarfile.TarFile] = {}
        self.rows: list[dict[str, Any]] = []

    def add(self, path: str, content: bytes) -> None:
        """Add a file by its path in the run, ``replicas/chair.glb``."""
        folder = path.partition("/")[0]
        if folder not in self._tars:
            self._tars[folder] = tarfile.open(self._run / f"{folder}.tar", "w", format=tarfile.USTAR_FORMAT)  # noqa: SIM115
        tar, entry = self._tars[folder], tarfile.TarInfo(path)
        entry.size = len(content)
        offset = tar.offset + _HEADER
        tar.addfile(entry, io.BytesIO(content))
        self.rows.append({"path": path, "tar": f"{folder}.tar", "offset": offset, "size": len(content)})

    def close(self) -> None:
        for tar in self._tars.values():
            tar.close()


@contextmanager
def packing(run: Path) -> Iterator[Packer]:
    """Pack files into a run. The index is written at the end."""
    import pyarrow
    from pyarrow import parquet

    packer = Packer(run)
    try:
        yield packer
    finally:
        packer.close()
    text, number = pyarrow.string(), pyarrow.int64()
    schema = pyarrow.schema({"path": text, "tar": text, "offset": number, "size": number})
    parquet.write_table(pyarrow.Table.from_pylist(packer.rows, schema), run / INDEX)


def find(run: Path, path: str) -> Path | Packed | None:
    """A file of a run by its path in it, packed or not; None where there is none."""
    if (file := run / path).is_file():
        return file
    index = run / INDEX
    try:
        return _index(index, index.stat().st_mtime_ns).get(path)
    except OSError:
        return None


def is_packed(run: Path, path: str) -> bool:
    """Whether a file of a run is in a tar."""
    return isinstance(find(run, path), Packed)


def read(run: Path, path: str) -> bytes | None:
    """What a file of a run holds, packed or not; None where there is none. Raises OSError."""
    found = find(run, path)
    if found is None:
        return None
    return found.read() if isinstance(found, Packed) else found.read_bytes()


@lru_cache(maxsize=4)
def _index(index: Path, stamp: int) -> Mapping[str, Packed]:
    from pyarrow import parquet

    columns = parquet.read_table(index).to_pydict()
    places = zip(columns["tar"], columns["offset"], columns["size"], strict=True)
    found = (Packed(index.parent / tar, offset, size) for tar, offset, size in places)
    return dict(zip(columns["path"], found, strict=True))
