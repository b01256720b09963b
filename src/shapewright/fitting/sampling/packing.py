"""How samples lie in their folder: a file for each, or as WebDataset keeps them, a thousand to a tar."""

from __future__ import annotations

import io
import json
import tarfile
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from shapewright.fitting.sampling.formats import FileFormat
from shapewright.fitting.sampling.making import Form, Made
from shapewright.storage import whole_file
from shapewright.threads import in_threads

Named: TypeAlias = Sequence[tuple[str, Made]]
"""Samples and the names of their files, without extensions."""


@dataclass(frozen=True)
class Packing:
    """How the files of samples are written.

    size: samples that are written together. They begin at multiples of it, counted over all shards.
    write: writes some into a folder, in tars of this stem, those of the number-th such lot; returns a path for each,
        empty where there is no shape.
    whole: whether such a lot is one file, which is written anew where samples are added to it.
    """

    size: int
    write: Callable[[Path, str, int, Form, Named], list[str]]
    whole: bool


def packing(format: FileFormat) -> Packing:
    """The packing of a format."""
    return TARS if format == "wds" else FILES


def _write_files(folder: Path, stem: str, number: int, form: Form, samples: Named) -> list[str]:
    def write(named: tuple[str, Made]) -> str:
        name, sample = named
        if sample.data is None:
            return ""
        path = f"{name}.{sample.extension}"
        with whole_file(folder / path) as partial:
            partial.write_bytes(sample.data)
        return path

    return in_threads(write, samples)


def _write_tar(folder: Path, stem: str, number: int, form: Form, samples: Named) -> list[str]:
    tar = f"{stem}-{number:05d}.tar"
    paths = [f"{tar}/{_key(name)}.{sample.extension}" if sample.data is not None else "" for name, sample in samples]
    if any(paths):
        with whole_file(folder / tar) as partial, tarfile.open(partial, "w", format=tarfile.USTAR_FORMAT) as archive:
            for name, sample in samples:
                if sample.data is not None:
                    about = {**form.origin, "parameters": sample.parameters, **sample.measures}
                    _add(archive, f"{_key(name)}.{sample.extension}", sample.data)
                    _add(archive, f"{_key(name)}.json", json.dumps(about).encode())
    return paths


def join_tars(parts: Iterable[Path], tar: Path) -> None:
    """Write what several tars hold into one, in order: what ``_write_tar`` would write of all their samples."""
    with tarfile.open(tar, "w", format=tarfile.USTAR_FORMAT) as joined:
        for part in parts:
            with tarfile.open(part) as archive:
                for member in archive:
                    joined.addfile(member, archive.extractfile(member))


def _add(archive: tarfile.TarFile, name: str, data: bytes) -> None:
    """Add a file that has no date and no owner, so that the same samples are the same bytes."""
    member = tarfile.TarInfo(name)
    member.size = len(data)
    archive.addfile(member, io.BytesIO(data))


def _key(name: str) -> str:
    """The key of a sample: WebDataset ends it at the first dot."""
    return name.replace(".", "-")


FILES = Packing(256, _write_files, whole=False)
TARS = Packing(1000, _write_tar, whole=True)
