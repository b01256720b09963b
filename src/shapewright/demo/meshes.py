"""The bundled demo collection: some forty tables, written as the flawed triangle soups that real files are."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from shapewright.demo.flaws import FLAWS, Parts
from shapewright.demo.models import tables
from shapewright.shapes.files import FORMATS

BROKEN = "truncated-on-purpose.ply"
_UNITS = (1.0, 0.01, 10.0, 1 / 2.54)  # centimetres written as centimetres, metres, millimetres, inches


def write(folder: Path) -> list[Path]:
    """Write the collection into a folder, made if it is not there; the same files every time.

    PLY, OBJ, STL, OFF and GLB in turn, each in units and at a place of its own, with flaws drawn from FLAWS. One more
    file, BROKEN, cannot be read, to show what becomes of such. Returns the paths of all of them.
    """
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(2023)
    paths = []
    for i, (name, solids) in enumerate(tables().items()):
        parts = [solid.mesh() for solid in solids]
        for flaw, likelihood in FLAWS.items():
            if rng.random() < likelihood:
                parts = flaw(parts, rng)
        unit, offset = rng.choice(_UNITS), rng.uniform(-200, 200, 3)
        placed = [replace(part, vertices=(part.vertices + offset) * unit) for part in parts]
        paths.append(folder / f"{name}.{FORMATS[(i + 1) % len(FORMATS)]}")
        _export(placed, paths[-1])
    whole = paths[0].read_bytes()
    paths.append(folder / BROKEN)
    paths[-1].write_bytes(whole[: len(whole) // 2])
    return paths


def _export(parts: Parts, path: Path) -> None:
    pieces = [trimesh.Trimesh(part.vertices, part.faces, process=False) for part in parts]
    shape: Any = trimesh.Scene(pieces) if path.suffix == ".glb" else trimesh.util.concatenate(pieces)
    shape.export(path)
