"""A z-buffer rasteriser for many small pictures: shading and depth, two-sided, without a GL context."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from shapewright.rendering import point_pictures
from shapewright.rendering.cameras import THREE_VIEWS, Camera, pack
from shapewright.rendering.framed import pictures_of
from shapewright.rendering.ink import picture
from shapewright.shapes import Bytes, Floats, Ints, Mesh, Points, ReferenceShape, Views
from shapewright.threads import in_threads

Singles = NDArray[np.float32]

AMBIENT = 0.25  # shading of a face that the light only grazes; 1 is a face that looks into it
LIGHT = (0.35, 0.5, 0.79)  # direction to the light, right, up and towards the camera; of length 1
DEPTH_RADIUS = 0.87
"""Of the ball about the origin whose depths pictures tell apart: half the diagonal of a cube of side 1, rounded up."""
_NEAR = 0.05  # vertices nearer to the camera than this, in units of the largest extent, are not drawn


def render(
    shapes: Sequence[ReferenceShape],
    cameras: Sequence[Camera] = THREE_VIEWS,
    size: int = 64,
    supersample: int = 2,
    threads: int | None = None,
) -> Bytes:
    """Pictures of normalised shapes: (N, C, 2, size, size), row 0 at the top.

    Channel 0 is shading (0 background, a face 64 to 255 by its angle to a light that rides on the camera, both sides
    alike), channel 1 depth (0 background; 255 nearest, DEPTH_RADIUS before the origin, to 1 as far behind it). Each
    pixel is the mean of supersample x supersample samples. Points are drawn as discs, see ``point_pictures``. A drawing
    looks the same to every camera, see ``ink.picture``.
    """
    packed = pack(cameras)
    images = np.zeros((len(shapes), len(cameras), 2, size, size), dtype=np.uint8)

    def draw(i: int) -> None:
        shape = shapes[i]
        if isinstance(shape, Mesh):
            _draw(shape.vertices, shape.faces, packed, size, supersample, images[i])
        elif isinstance(shape, Points):
            images[i] = point_pictures.pictures(shape, cameras, size, supersample)
        elif isinstance(shape, Views):
            images[i] = pictures_of(shape.views[0], size)
        else:
            images[i] = picture(shape, size, supersample)

    in_threads(draw, range(len(shapes)), threads)
    return images


def view(mesh: Mesh, camera: Camera, size: int) -> tuple[Singles, Singles]:
    """One view of a normalised mesh: shading and inverse depth, (size, size) each, row 0 at the top, 0 where empty.

    Shading is AMBIENT to 1, inverse depth one over the distance along the view.
    """
    shade, inverse_depth = np.empty((2, size, size), dtype=np.float32)
    _draw_view(mesh.vertices, mesh.faces, pack([camera])[0], np.empty_like(mesh.vertices), shade, inverse_depth)
    return shade, inverse_depth


@njit(nogil=True, cache=True)
def _draw(vertices: Floats, faces: Ints, cameras: Floats, size: int, supersample: int, images: Bytes) -> None:
    side = size * supersample
    shade = np.empty((side, side), dtype=np.float32)
    inverse_depth = np.empty((side, side), dtype=np.float32)
    projected = np.empty((len(vertices), 3))
    for c in range(len(cameras)):
        _draw_view(vertices, faces, cameras[c], projected, shade, inverse_depth)
        _resolve(shade, inverse_depth, cameras[c, 9], supersample, images[c])


@njit(nogil=True, cache=True)
def _draw_view(
    vertices: Floats, faces: Ints, camera: Floats, projected: Floats, shade: Singles, inverse_depth: Singles
) -> None:
    """One view into buffers (S, S): shading, AMBIENT to 1, and one over the distance along the view; 0 where empty.

    camera: a row of ``cameras.pack``. projected: (V, 3), room to work in.
    """
    shade[:] = 0.0
    inverse_depth[:] = 0.0
    _project(vertices, camera, len(shade), projected)
    for f in range(len(faces)):
        _triangle(vertices, projected, faces[f, 0], faces[f, 1], faces[f, 2], camera, shade, inverse_depth)


@njit(nogil=True, cache=True)
def _project(vertices: Any, camera: Any, side: int, projected: Any) -> None:
    """Pixel coordinates (column, row) and the inverse of the distance along the view; that is 0 for one too near."""
    half = side / 2.0
    for v in range(len(vertices)):
        x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
        right = camera[0] * x + camera[1] * y + camera[2] * z
        up = camera[3] * x + camera[4] * y + camera[5] * z
        away = camera[9] - (camera[6] * x + camera[7] * y + camera[8] * z)
        if away < _NEAR:
            projected[v, 2] = 0.0
            continue
        projected[v, 0] = half + half * camera[10] * right / away
        projected[v, 1] = half - half * camera[10] * up / away
        projected[v, 2] = 1.0 / away


@njit(nogil=True, cache=True)
def _triangle(vertices: Any, projected: Any, a: int, b: int, c: int, camera: Any, shade: Any, inverse: Any) -> None:
    side = shade.shape[0]
    ax, ay, az = projected[a, 0], projected[a, 1], projected[a, 2]
    bx, by, bz = projected[b, 0], projected[b, 1], projected[b, 2]
    cx, cy, cz = projected[c, 0], projected[c, 1], projected[c, 2]
    if az == 0.0 or bz == 0.0 or cz == 0.0:
        return
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if area == 0.0:
        return
    left, right = max(0, int(np.ceil(min(ax, bx, cx) - 0.5))), min(side - 1, int(np.floor(max(ax, bx, cx) - 0.5)))
    top, bottom = max(0, int(np.ceil(min(ay, by, cy) - 0.5))), min(side - 1, int(np.floor(max(ay, by, cy) - 0.5)))
    if left > right or top > bottom:
        return
    light = _face_shade(vertices, a, b, c, camera)
    # Barycentric weights and inverse depth are linear in the picture; they are stepped along each row.
    scale = 1.0 / area
    step_b, step_c = (cy - ay) * scale, -(by - ay) * scale
    step_z = step_b * (bz - az) + step_c * (cz - az)
    for row in range(top, bottom + 1):
        px, py = left + 0.5 - ax, row + 0.5 - ay
        weight_b = (px * (cy - ay) - py * (cx - ax)) * scale
        weight_c = (py * (bx - ax) - px * (by - ay)) * scale
        z = az + weight_b * (bz - az) + weight_c * (cz - az)
        for column in range(left, right + 1):
            if weight_b >= 0.0 and weight_c >= 0.0 and weight_b + weight_c <= 1.0 and z > inverse[row, column]:
                inverse[row, column] = z
                shade[row, column] = light
            weight_b += step_b
            weight_c += step_c
            z += step_z


@njit(nogil=True, cache=True)
def _face_shade(vertices: Any, a: int, b: int, c: int, camera: Any) -> float:
    ux, uy, uz = (vertices[b, 0] - vertices[a, 0], vertices[b, 1] - vertices[a, 1], vertices[b, 2] - vertices[a, 2])
    vx, vy, vz = (vertices[c, 0] - vertices[a, 0], vertices[c, 1] - vertices[a, 1], vertices[c, 2] - vertices[a, 2])
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    length = np.sqrt(nx * nx + ny * ny + nz * nz)
    if length == 0.0:
        return 1.0
    right = camera[0] * nx + camera[1] * ny + camera[2] * nz
    up = camera[3] * nx + camera[4] * ny + camera[5] * nz
    back = camera[6] * nx + camera[7] * ny + camera[8] * nz
    cosine = abs(right * LIGHT[0] + up * LIGHT[1] + back * LIGHT[2]) / length
    return float(AMBIENT + (1.0 - AMBIENT) * min(cosine, 1.0))


@njit(nogil=True, cache=True)
def _resolve(shade: Any, inverse: Any, distance: float, supersample: int, image: Any) -> None:
    """Mean of the samples of each pixel, as bytes."""
    size = image.shape[1]
    samples = supersample * supersample
    for row in range(size):
        for column in range(size):
            light, depth = 0.0, 0.0
            for i in range(row * supersample, (row + 1) * supersample):
                for j in range(column * supersample, (column + 1) * supersample):
                    if inverse[i, j] > 0.0:
                        light += shade[i, j]
                        behind = (1.0 / inverse[i, j] - distance) / DEPTH_RADIUS
                        depth += min(max(0.5 - 0.5 * behind, 0.0), 1.0) * (254.0 / 255.0) + 1.0 / 255.0
            image[0, row, column] = np.uint8(light / samples * 255.0 + 0.5)
            image[1, row, column] = np.uint8(depth / samples * 255.0 + 0.5)
