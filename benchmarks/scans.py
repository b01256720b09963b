"""Whether a scan is fitted like the mesh that it was made of.

    python benchmarks/scans.py table chair shelf bed [--count 20] [--seed 0] [--json FILE] [--sheets FOLDER]

Of each category the final procedure builds ``count`` shapes at parameters that it does not learn from. Each becomes a
scan: 10,000 points that three sides see, a little from above, moved by noise of 0.5 % of the largest extent. One fit
has the meshes as its references, another the scans, both with the default settings. Told are the shares that are
replicated by the fit's own judge, and by the judge of meshes: of the scan's replica and the mesh that was scanned.

--sides gives other azimuths in degrees, --points, --noise, --holes and --uneven other scans; see ``Scanner``.
--outliers adds a share of points anywhere in the bounding box, --floor a plane under the shape; these scans are written
as files first, since reading takes both off. --sensors says from where each point was seen. --samples: to learn from.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from dataclasses import asdict, dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

import shapewright as sw
from known_pairs import _built
from shapewright.judging.fidelity import Fidelity
from shapewright.judging.verdict import grade_of
from shapewright.prediction.scanning import Scanner, side_cameras
from shapewright.rendering.cameras import THUMBNAIL
from shapewright.rendering.raster import render
from shapewright.rendering.thumbnails import thumbnail
from shapewright.runs.iteration import Iteration
from shapewright.settings import Settings
from shapewright.shapes import Mesh, Points

ROOT = Path(__file__).resolve().parents[1]
HELD_OUT = 7919  # added to the seed of the fits, whose samples others are learned from
ELEVATIONS = (12.0, 38.0)  # of the sides, in degrees, least and most
ASIDE = 12.0  # degrees by which a side may be elsewhere


@dataclass(frozen=True)
class Share:
    """Of one category."""

    category: str
    references: int
    meshes: int  # replicated, of the meshes
    meshes_close: int
    meshes_fidelity: float  # the mean
    scans: int  # replicated, of the scans, by the fit's own judge
    scans_close: int
    scans_fidelity: float
    truly: int  # replicated, of the scans, by the judge of meshes
    truly_close: int
    truly_fidelity: float
    alike: float  # share of the scans that both judges call replicated, or both not
    seconds_meshes: float
    seconds_scans: float


def held_out(procedure: sw.Procedure, count: int, seed: int) -> dict[str, Mesh]:
    built = [_built(procedure, values) for values in procedure.space.sample(2 * count, seed=seed + HELD_OUT)]
    meshes = [mesh for mesh in built if mesh is not None and len(mesh.faces)]
    return {f"{number:03d}": mesh.normalised() for number, mesh in enumerate(meshes[:count])}


def scan(mesh: Mesh, options: argparse.Namespace, rng: np.random.Generator) -> Points:
    azimuths = np.array(options.sides) + rng.uniform(-ASIDE, ASIDE, len(options.sides))
    cameras = side_cameras(azimuths.tolist(), rng.uniform(*ELEVATIONS, len(azimuths)).tolist())
    scanner = Scanner(cameras, options.points, options.noise, options.holes, options.uneven)
    points = scanner.scan(mesh, rng)
    more = []
    if options.outliers:
        box = points.bounds + 0.1 * np.array([-points.extent, points.extent])
        more.append(rng.uniform(*box, size=(round(options.outliers * len(points)), 3)))
    if options.floor:
        x, z = rng.uniform(-0.9, 0.9, size=(2, round(options.floor * len(points))))
        floor = np.stack([x, np.full_like(x, mesh.bounds[0, 1]), z], axis=1)
        more.append(floor + rng.normal(scale=options.noise, size=floor.shape))
    if more:
        return Points(np.concatenate([points.positions, *more]))
    return points if options.sensors else Points(points.positions)


def collection(scans: dict[str, Points], folder: Path | None) -> sw.Collection:
    if folder is None:
        return sw.Collection.of(scans)
    for name, points in scans.items():
        lines = "\n".join(" ".join(f"{value:.6f}" for value in row) for row in points.positions)
        (folder / f"{name}.xyz").write_text(lines + "\n", encoding="utf-8")
    return sw.Collection.load(folder)


def measured(category: str, options: argparse.Namespace) -> Share:
    path = sorted((ROOT / "examples" / "categories" / category).glob("v*.py"))[-1]
    procedure, rng = sw.load_procedure(path), np.random.default_rng([options.seed, 11])
    settings = Settings(seed=options.seed, samples=options.samples, workers=options.workers)
    meshes = held_out(procedure, options.count, options.seed)
    scans = {name: scan(mesh, options, rng) for name, mesh in meshes.items()}
    started = time.perf_counter()
    whole = None if options.scans_only else sw.fit(procedure, sw.Collection.of(meshes), settings)
    between = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        given = collection(scans, Path(folder) if options.outliers or options.floor else None)
        found = sw.fit(procedure, given, settings)
    ended = time.perf_counter()
    by_name = {result.name: result for result in found}
    truth = [Fidelity(mesh).value(by_name[name].replica) if name in by_name else 0.0 for name, mesh in meshes.items()]
    own = [by_name[name].measured.fidelity if name in by_name else 0.0 for name in meshes]
    if options.sheets:
        options.sheets.mkdir(parents=True, exist_ok=True)
        sheet(options.sheets / f"{category}.png", meshes, scans, whole, found, own, truth)
    counts = [_counts(values, settings) for values in ([r.measured.fidelity for r in whole or ()], own, truth)]
    alike = np.mean([(a >= settings.replicated) == (b >= settings.replicated) for a, b in zip(own, truth, strict=True)])
    return Share(
        category, len(meshes), *counts[0], *counts[1], *counts[2], float(alike), between - started, ended - between
    )


def _counts(values: list[float], settings: Settings) -> tuple[int, int, float]:
    grades = [grade_of(value, settings) for value in values]
    return grades.count("replicated"), grades.count("close"), float(np.nanmean(values)) if values else float("nan")


def sheet(
    path: Path,
    meshes: dict[str, Mesh],
    scans: dict[str, Points],
    whole: Iteration | None,
    found: Iteration,
    own: list[float],
    truth: list[float],
) -> None:
    """Rows of: mesh, scan, the scan's replica, the mesh's replica; a bar for what either judge says of the third."""
    side, columns = 128, 4
    tiles = []
    for number, (name, mesh) in enumerate(meshes.items()):
        replicas = [next((r.replica for r in each or () if r.name == name), None) for each in (found, whole)]
        tile = np.concatenate([_grey(shape, side) for shape in (mesh, scans[name], *replicas)], axis=1)
        for row, value in ((0, own[number]), (4, truth[number])):
            tile[row : row + 3, : int(4 * side * min(max(value, 0.0), 1.0))] = 90 if row else 0
        tiles.append(np.pad(tile, 4, constant_values=255))
    tiles += [np.full_like(tiles[0], 255)] * (-len(tiles) % columns)
    per = len(tiles) // columns
    whole_sheet = np.concatenate([np.concatenate(tiles[i * per : (i + 1) * per]) for i in range(columns)], axis=1)
    Image.fromarray(whole_sheet).save(path)


def _grey(shape: Any, side: int) -> np.ndarray:
    if shape is None:
        return np.full((side, side), 255, dtype=np.uint8)
    if isinstance(shape, Points):
        shade = render([shape.normalised()], [THUMBNAIL], side)[0, 0, 0]
        return np.where(shade > 0, shade // 2 + 60, 255).astype(np.uint8)
    picture = Image.open(BytesIO(thumbnail(shape, side))).convert("LA")
    ground = Image.new("LA", picture.size, (255, 255))
    return np.asarray(Image.alpha_composite(ground.convert("RGBA"), picture.convert("RGBA")).convert("L")).copy()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("categories", nargs="+", choices=("table", "chair", "shelf", "bed"))
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--sheets", type=Path)
    parser.add_argument("--samples", type=int, default=Settings.samples)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--scans-only", action="store_true")
    parser.add_argument("--sides", type=lambda text: tuple(map(float, text.split(","))), default=(-75.0, 0.0, 75.0))
    parser.add_argument("--points", type=int, default=10_000)
    parser.add_argument("--noise", type=float, default=0.005)
    parser.add_argument("--holes", type=int, default=0)
    parser.add_argument("--uneven", type=float, default=0.0)
    parser.add_argument("--outliers", type=float, default=0.0)
    parser.add_argument("--floor", type=float, default=0.0)
    parser.add_argument("--sensors", action="store_true")
    options = parser.parse_args()
    rows = [measured(category, options) for category in options.categories]
    for row in rows:
        print(", ".join(f"{n}: {round(v, 3) if isinstance(v, float) else v}" for n, v in asdict(row).items()))
    total = sum(row.references for row in rows)
    for title in ("meshes", "scans", "truly"):
        print(f"{title}: {sum(getattr(row, title) for row in rows) / total:.3f} of {total} replicated")
    if options.json:
        options.json.write_text(json.dumps([asdict(row) for row in rows], indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
