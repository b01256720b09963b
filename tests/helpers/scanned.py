"""Points of meshes: sampled all over, or as a scanner sees them from three sides, with a floor and strays if wanted."""

import numpy as np

from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import view
from shapewright.shapes import Mesh, Points, concatenate

SIDES = (Camera(35.0, 25.0, 3.0), Camera(155.0, 30.0, 3.0), Camera(275.0, 20.0, 3.0))


def sampled(mesh: Mesh, count: int = 10_000, seed: int = 0) -> Points:
    """As many points on any area as on another of the same size, with normals."""
    rng = np.random.default_rng(seed)
    a, b, c = np.moveaxis(mesh.triangles, 1, 0)
    across = np.cross(b - a, c - a)
    areas = np.linalg.norm(across, axis=1)
    face = rng.choice(len(areas), count, p=areas / areas.sum())
    u, v = np.sort(rng.random((2, count)), axis=0)[:, :, None]
    return Points(a[face] * u + b[face] * (v - u) + c[face] * (1.0 - v), across[face])


def seen(mesh: Mesh, count: int = 10_000, noise: float = 0.005, floor: float = 0.0, seed: int = 0) -> Points:
    """What three sides see of the normalised mesh, with where each point was seen from; floor: half its width."""
    rng = np.random.default_rng(seed)
    mesh = mesh.normalised()
    if floor:
        low = mesh.bounds[0, 1] - 1e-4
        corners = [[x * floor, low, z * floor] for x, z in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        mesh = concatenate([mesh, Mesh(np.array(corners), np.array([[0, 2, 1], [0, 3, 2]]))])
    scale = max(1.0, 1.45 * floor)  # the whole floor is in the picture
    places, sensors = [], []
    for camera in SIDES:
        inverse = view(mesh.transformed(np.eye(3) / scale), camera, 256)[1]
        row, column = np.nonzero(inverse)
        depth = 1.0 / inverse[row, column]
        right, up = ((side + 0.5) / 128.0 / camera.focal_length * depth for side in (column - 128, 127 - row))
        places.append(scale * np.stack([right, up, camera.distance - depth], axis=1) @ camera.frame())
        sensors.append(np.tile(scale * camera.distance * camera.frame()[2], (len(row), 1)))
    rows = rng.permutation(sum(map(len, places)))[:count]
    found = np.concatenate(places)[rows]
    return Points(found + rng.normal(scale=noise, size=found.shape), seen_from=np.concatenate(sensors)[rows])


def strewn(points: Points, count: int, seed: int = 0) -> Points:
    """With stray points all over a box a tenth larger."""
    low, high = points.bounds + np.array([[-0.1], [0.1]])
    strays = np.random.default_rng(seed).uniform(low, high, size=(count, 3))
    return Points(np.concatenate([points.positions, strays]))
