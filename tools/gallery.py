"""Draw the random shapes of the example categories.

    python tools/gallery.py                  hundreds, of the last version of each: docs/pictures/gallery.png
    python tools/gallery.py table            of each version: docs/pictures/categories/table/v1.png and so on
    python tools/gallery.py table --run DIR  the replicas of a run, if compatible: .../table/DIR-replicas.png

Options: --seed N. A category that is not in examples/ yet is left out.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.ndimage import gaussian_filter

from shapewright import Infeasible, Iteration, Mesh, load_procedure
from shapewright.rendering import raster
from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import LIGHT
from shapewright.threads import in_threads

Floats: TypeAlias = NDArray[np.float64]
Tile: TypeAlias = tuple[Floats, Floats, Floats]
"""Of one shape: the light that its shadow leaves (TILE, TILE), its colour times its cover (..., 3), and its cover."""

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "docs" / "pictures"
TINTS = {
    "bed": ("#8fb4cf", "#6f9dbf", "#b3cbdc"),
    "chair": ("#e2a06f", "#d98a5f", "#ecbd95"),
    "shelf": ("#9dbf8a", "#83ad78", "#bdd3aa"),
    "table": ("#d9b984", "#caa46c", "#e6cfa5"),
}
COLUMNS, ROWS = 24, 4
STEP, TILE = 80, 128  # pixels from shape to shape, and of a shape's own picture, in which its shadow has room
SUPERSAMPLE = 3
CAMERA = Camera(35.0, 25.0, distance=4.5, field_of_view=22.0)
EXTENT = 0.92  # of a shape in the picture, on the scale on which a normalised shape has 1
GROUND = (250.0, 249.0, 247.0)
SHADOW, CREVICES = 0.28, 1.6


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("category", nargs="?", choices=TINTS)
    parser.add_argument("--run", type=Path)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    versions = {name: sorted((ROOT / "examples" / "categories" / name).glob("v*.py")) for name in TINTS}
    if not arguments.category:
        last = {name: paths[-1] for name, paths in versions.items() if paths}
        shapes = [(mesh, name) for name, path in last.items() for mesh in samples(path, ROWS * COLUMNS, arguments.seed)]
        draw(shapes, COLUMNS, arguments.seed).save(PICTURES / "gallery.png", optimize=True)
        return
    folder = PICTURES / "categories" / arguments.category
    folder.mkdir(parents=True, exist_ok=True)
    if arguments.run:
        replicas = [result.replica for result in Iteration.load(arguments.run) if result.compatible and result.replica]
        pictures = {f"{arguments.run.name}-replicas": replicas}
    else:
        pictures = {path.stem: samples(path, 36, arguments.seed) for path in versions[arguments.category]}
    for name, meshes in pictures.items():
        sheet = draw([(mesh, arguments.category) for mesh in meshes], 12, arguments.seed)
        sheet.save(folder / f"{name}.png", optimize=True)


def samples(path: Path, count: int, seed: int) -> list[Mesh]:
    """Shapes from random parameters, of those that are feasible."""
    procedure, found = load_procedure(path), []
    for parameters in procedure.space.sample(2 * count, seed=seed):
        if len(found) == count:
            break
        try:
            found.append(procedure(**parameters))
        except Infeasible:
            continue
    return [shape for shape in found if isinstance(shape, Mesh)]


def draw(shapes: Sequence[tuple[Mesh, str]], columns: int, seed: int) -> Image.Image:
    """The shapes row by row, each in a tint of its category, on one ground."""
    rng = np.random.default_rng(seed)
    tinted = [(mesh, rgb(TINTS[name][int(rng.integers(3))])) for mesh, name in shapes]
    rows = -(-len(shapes) // columns)
    border = TILE - STEP
    canvas = np.tile(np.array(GROUND), (rows * STEP + border, columns * STEP + border, 1))
    tiles = in_threads(lambda pair: tile(*pair), tinted)
    for (shadow, _, _), area in zip(tiles, areas(canvas, columns), strict=False):
        area *= shadow[..., None]  # all shadows lie below all shapes
    for (_, colour, cover), area in zip(tiles, areas(canvas, columns), strict=False):
        area += colour - area * cover[..., None]
    inner = canvas[border // 4 : -border // 4, border // 4 : -border // 4]
    return Image.fromarray(inner.round().astype(np.uint8)).quantize(256)


def areas(canvas: Floats, columns: int) -> Iterator[Floats]:
    """The places of the tiles on the canvas, row by row; they overlap."""
    for top in range(0, len(canvas) - TILE + 1, STEP):
        for column in range(columns):
            yield canvas[top : top + TILE, column * STEP : column * STEP + TILE]


def tile(mesh: Mesh, tint: Floats) -> Tile:
    vertices = mesh.normalised().vertices
    across = np.ptp(vertices @ CAMERA.frame()[:2].T, axis=0)
    vertices = vertices * EXTENT / across.max()
    shade, depth = view(vertices, mesh.faces)
    cover = depth > 0.0
    # A surface that lies behind its surroundings is darker: a blurred picture of the distance tells.
    away = np.where(cover, 1.0 / np.where(cover, depth, 1.0), 0.0)
    blur = STEP * SUPERSAMPLE / 24
    around = gaussian_filter(away, blur) / np.maximum(gaussian_filter(cover.astype(float), blur), 1e-6)
    light = np.clip(0.5 + 0.55 * shade - CREVICES * np.clip(away - around, 0.0, 0.12), 0.0, 1.05)
    colour = np.minimum(light[..., None] * tint, 255.0) * cover[..., None]
    _, dark = view(cast(vertices), mesh.faces)
    shadow = 1.0 - SHADOW * gaussian_filter((dark > 0.0).astype(float), 1.6 * SUPERSAMPLE)
    return resolved(shadow), resolved(colour), resolved(cover.astype(float))


def view(vertices: Floats, faces: NDArray[np.int64]) -> tuple[Floats, Floats]:
    side = TILE * SUPERSAMPLE
    shade, depth = raster.view(Mesh(vertices, faces), CAMERA, side)
    return shade.astype(np.float64), depth.astype(np.float64)


def cast(vertices: Floats) -> Floats:
    """The vertices moved along the light onto the ground that the shape stands on."""
    light = np.array(LIGHT) @ CAMERA.frame()
    above = vertices[:, 1:2] - vertices[:, 1].min()
    return np.asarray(vertices - above * light / light[1])


def resolved(samples: NDArray[Any]) -> Floats:
    """The mean of each pixel's samples."""
    shape = (TILE, SUPERSAMPLE, TILE, SUPERSAMPLE, *samples.shape[2:])
    return np.asarray(samples.reshape(shape).mean(axis=(1, 3)))


def rgb(colour: str) -> Floats:
    return np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)], dtype=np.float64)


if __name__ == "__main__":
    main()
