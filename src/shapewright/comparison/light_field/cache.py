"""Descriptors on disk, one file each, named by the geometry: a reference is described once, ever."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np

from shapewright.comparison.light_field.description import Descriptor, describe
from shapewright.shapes import Mesh, shape_digest
from shapewright.storage import whole_file

FORMAT = 1
"""Part of every file's name; raise it whenever the same mesh would get another descriptor."""

_DAMAGED = (OSError, EOFError, ValueError, KeyError, zipfile.BadZipFile)
_FORM = (10, 10, 47)


def described_once(mesh: Mesh, folder: Path, bits: int = 4) -> Descriptor:
    """The descriptor from a folder, or a new one that is put there; a damaged file is replaced.

    Any number of processes may use a folder at once: files appear whole, by a rename. Raises ValueError as
    ``description.describe`` does, and OSError when the folder cannot be written.
    """
    descriptor = known(mesh, folder, bits)
    if descriptor is None:
        descriptor = describe(mesh, bits)
        keep(mesh, descriptor, folder)
    return descriptor


def known(mesh: Mesh, folder: Path, bits: int = 4) -> Descriptor | None:
    """The descriptor from a folder, None where it is not there."""
    return _read(_path(mesh, folder, bits), bits)


def keep(mesh: Mesh, descriptor: Descriptor, folder: Path) -> None:
    """Put a descriptor into a folder. Raises OSError when that cannot be written."""
    folder.mkdir(parents=True, exist_ok=True)
    with whole_file(_path(mesh, folder, descriptor.bits)) as partial, partial.open("wb") as file:
        np.savez(file, coefficients=descriptor.coefficients)


def _path(mesh: Mesh, folder: Path, bits: int) -> Path:
    return folder / f"{shape_digest(mesh)}-{bits}bit-v{FORMAT}.npz"


def _read(path: Path, bits: int) -> Descriptor | None:
    """None where there is no whole file; the archive's own checksum finds damage."""
    try:
        with np.load(path, allow_pickle=False) as file:
            coefficients = file["coefficients"]
    except _DAMAGED:
        return None
    whole = coefficients.shape == _FORM and coefficients.dtype == np.uint8
    return Descriptor(coefficients, bits) if whole else None
