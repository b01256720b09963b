"""Random shapes of a procedure, written as files."""

from __future__ import annotations

import csv
from pathlib import Path

from shapewright.building import build_all, describe_failures
from shapewright.procedure import Procedure
from shapewright.shapes import Drawing, Mesh
from shapewright.workspace import new_folder


def write_samples(
    procedure: Procedure, count: int, folder: Path, format: str = "glb", seed: int = 0, workers: int | None = None
) -> tuple[int, str]:
    """Write shapes at ``count`` random parameter vectors and a manifest.csv of these; all of it or nothing.

    Meshes are written in ``format`` (glb, ply, obj, stl, off), drawings as SVG. Returns how many shapes were written
    and what failed, in words. Raises RunError when the folder holds something or cannot be written, ProcedureError
    when the procedure is broken.
    """
    builds = build_all(procedure, procedure.space.sample(count, seed=seed), workers)
    good = [build for build in builds if build.shape is not None]
    failed = [build for build in builds if build.failure]
    digits = len(str(max(len(good) - 1, 0)))
    with new_folder(folder) as partial, (partial / "manifest.csv").open("w", newline="", encoding="utf-8") as file:
        manifest = csv.writer(file)
        manifest.writerow(["path", *procedure.space.names])
        for i, build in enumerate(good):
            assert build.shape is not None
            name = f"{procedure.name}-{i:0{digits}d}.{'svg' if isinstance(build.shape, Drawing) else format}"
            (partial / name).write_bytes(_encode(build.shape, format))
            manifest.writerow([name, *build.parameters.values()])
    return len(good), describe_failures(failed) if failed else ""


def _encode(shape: Mesh | Drawing, format: str) -> bytes:
    if isinstance(shape, Drawing):
        return _svg(shape)
    import trimesh

    exported = trimesh.Trimesh(shape.vertices, shape.faces, process=False).export(file_type=format)
    return exported.encode() if isinstance(exported, str) else bytes(exported)


def _svg(drawing: Drawing) -> bytes:
    (left, low), (right, high) = drawing.bounds
    margin = 0.02 * max(right - left, high - low)
    box = f"{left - margin} {-high - margin} {right - left + 2 * margin} {high - low + 2 * margin}"
    shape = drawing.geometry.svg(scale_factor=0.0, fill_color="black", opacity=1.0)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}"><g transform="scale(1 -1)">{shape}</g></svg>'.encode()
    )
