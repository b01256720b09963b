"""Scans that are made of meshes: points of what a few cameras see, with noise, gaps and stray points.

A predictor that is to read scans learns from these. benchmarks/scans.py measures with them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapewright.prediction.dataset import Dataset
from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import render, view
from shapewright.shapes import Floats, Mesh, Points
from shapewright.threads import in_threads

SHARE = 0.75
"""Of the samples that a predictor of points learns from as scans; the others stay meshes."""
_DISTANCE, _FIELD = 4.0, 2.0 * math.degrees(math.asin(0.87 / 4.0))  # of a scanner: all of a normalised mesh fits
_SIDE = 96  # pixels along the side of a depth picture in training: three of them hold 6,000 points of a chair
_POINTS = (3000, 12000)  # of a scan in training, least and most
_NOISE = (0.0, 0.008)  # standard deviation of each coordinate, in units of the largest extent
_HOLES = 3  # most holes in training
_SEED = 0x5CA1  # of all that is random here, beside that of the fit


@dataclass(frozen=True)
class Scanner:
    """How a mesh is scanned.

    cameras: the sides that it is seen from.
    count: points at most.
    noise: standard deviation of each coordinate, in units of the largest extent.
    holes: balls without points, of .05 to .15 of the largest extent.
    uneven: how much the density varies from one place to another, 0 to 1.
    side: pixels along the side of each depth picture.
    """

    cameras: tuple[Camera, ...]
    count: int = 10_000
    noise: float = 0.005
    holes: int = 0
    uneven: float = 0.0
    side: int = 256

    def scan(self, mesh: Mesh, rng: np.random.Generator) -> Points:
        """The points, in the frame of the normalised mesh; with where each was seen from.

        Raises ValueError where no camera shows the mesh.
        """
        normal = mesh.normalised()
        seen = [_points(normal, camera, self.side) for camera in self.cameras]
        positions, places = np.concatenate(seen), np.repeat(_places(self.cameras), [len(s) for s in seen], axis=0)
        if not len(positions):
            raise ValueError("no camera shows the mesh")
        chance = np.ones(len(positions))
        for centre in positions[rng.integers(len(positions), size=self.holes)]:
            away = np.linalg.norm(positions - centre, axis=1)
            chance[away < rng.uniform(0.05, 0.15)] = 0.0
        if self.uneven:
            slope = positions @ _direction(rng)
            chance *= 1.0 - self.uneven * (slope - slope.min()) / max(float(np.ptp(slope)), 1e-9)
        order = np.argsort(rng.random(len(chance)) ** (1.0 / np.maximum(chance, 1e-9)))[
            ::-1
        ]  # Efraimidis, Spirakis 2006
        rows = order[: max(1, min(self.count, np.count_nonzero(chance)))]
        moved = positions[rows] + rng.normal(scale=self.noise, size=(len(rows), 3))
        return Points(moved, seen_from=places[rows])


def random_scanner(rng: np.random.Generator) -> Scanner:
    """One to learn from: two to five sides of any height above the ground, of any number of points and noise."""
    count, step = int(rng.integers(2, 6)), rng.uniform(40.0, 130.0)
    first = rng.uniform(0.0, 360.0)
    cameras = [
        Camera(first + step * i + rng.normal(scale=12.0), rng.uniform(0.0, 60.0), _DISTANCE, _FIELD)
        for i in range(count)
    ]
    noise = float(rng.uniform(*_NOISE))
    uneven = float(rng.uniform(0.0, 0.8)) if rng.random() < 0.5 else 0.0
    holes = int(rng.integers(_HOLES + 1)) if rng.random() < 0.3 else 0
    return Scanner(tuple(cameras), int(rng.integers(*_POINTS)), noise, holes, uneven, _SIDE)


def side_cameras(azimuths: Sequence[float], elevations: Sequence[float]) -> tuple[Camera, ...]:
    """Scanners around a normalised shape, in degrees."""
    pairs = zip(azimuths, elevations, strict=True)
    return tuple(Camera(azimuth, elevation, _DISTANCE, _FIELD) for azimuth, elevation in pairs)


def scanned(data: Dataset, seed: int, threads: int | None = None, share: float = SHARE) -> Dataset:
    """The same parameters with a share of the meshes as scans, each by a scanner of its own; normalised."""
    rng = np.random.default_rng([_SEED, seed, len(data)])
    chosen = rng.random(len(data)) < share
    seeds = rng.integers(1 << 62, size=len(data))

    def one(row: int) -> Mesh | Points:
        mesh, own = data.shapes[row], np.random.default_rng(seeds[row])
        assert isinstance(mesh, Mesh)
        if not chosen[row]:
            return mesh
        try:
            return random_scanner(own).scan(mesh, own).normalised()
        except ValueError:  # nothing to see, or all at one place
            return mesh

    shapes = in_threads(one, range(len(data)), threads)
    return replace(data, shapes=list(shapes), images=render(shapes, data.cameras, data.size, threads=threads))


def _points(mesh: Mesh, camera: Camera, side: int) -> Floats:
    """(N, 3): what each pixel shows in its middle."""
    inverse = view(mesh, camera, side)[1]
    row, column = np.nonzero(inverse)
    away = 1.0 / inverse[row, column].astype(np.float64)
    half = side / 2.0
    right, up = (column + 0.5 - half) / half * away, (half - row - 0.5) / half * away
    places = np.stack([right / camera.focal_length, up / camera.focal_length, camera.distance - away], axis=1)
    return np.asarray(places @ camera.frame())


def _places(cameras: Sequence[Camera]) -> Floats:
    return np.array([camera.distance * camera.frame()[2] for camera in cameras])


def _direction(rng: np.random.Generator) -> Floats:
    vector = rng.normal(size=3)
    return np.asarray(vector / np.linalg.norm(vector))
