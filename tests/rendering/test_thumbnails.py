"""Thumbnails: the whole shape in the picture, edges drawn, one answer whatever the threads."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from shapewright.rendering.thumbnails import thumbnail, thumbnails
from shapewright.shapes import Mesh, concatenate

SIDES = ((0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6),
         (1, 3, 5), (3, 7, 5))  # fmt: skip

DARKEST_SHADING = 107  # the grey of a face that the light only grazes


def moved(mesh: Mesh, *by: float) -> Mesh:
    return Mesh(mesh.vertices + np.array(by), mesh.faces)


def cuboid(width: float, height: float, depth: float) -> Mesh:
    corners = [[x * width / 2, y * height / 2, z * depth / 2] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    return Mesh(np.array(corners), np.array(SIDES))


def cylinder(sides: int) -> Mesh:
    """An open wall of height and diameter 1."""
    angles = np.repeat(np.arange(sides), 2) * 2.0 * np.pi / sides
    heights = np.tile([-0.5, 0.5], sides)
    first, last = np.arange(2 * sides), 2 * sides
    walls = np.stack([first, (first + 1) % last, (first + 2) % last], axis=1)
    return Mesh(np.stack([np.cos(angles) / 2.0, heights, np.sin(angles) / 2.0], axis=1), walls)


def decoded(png: bytes) -> np.ndarray:
    image = Image.open(io.BytesIO(png))
    assert (image.format, image.mode) == ("PNG", "LA")
    return np.asarray(image).astype(int)


def darkest_inside(picture: np.ndarray) -> int:
    """The least grey among pixels further than two from the background."""
    inside = np.pad(picture[..., 1] == 255, 2)
    shifts = [np.roll(inside, (i, j), (0, 1)) for i in range(-2, 3) for j in range(-2, 3)]
    core = np.logical_and.reduce(shifts)[2:-2, 2:-2]
    return int(picture[core, 0].min())


def test_the_picture_has_the_size_asked_for_and_a_transparent_ground() -> None:
    picture = decoded(thumbnail(cuboid(1, 1, 1), size=96))
    assert picture.shape == (96, 96, 2)
    assert picture[0, :, 1].max() == 0
    assert picture[48, 48, 1] == 255


def test_the_whole_unit_cube_is_inside_the_picture() -> None:
    covered = decoded(thumbnail(cuboid(1, 1, 1)))[..., 1] > 0
    assert not covered[[0, -1]].any()
    assert not covered[:, [0, -1]].any()


def test_size_and_place_of_the_mesh_do_not_matter() -> None:
    mesh = cuboid(1.0, 0.5, 0.25)
    elsewhere = moved(Mesh(mesh.vertices * 64.0, mesh.faces), 128.0, -32.0, 16.0)
    assert thumbnail(elsewhere, size=64) == thumbnail(mesh, size=64)


def test_the_three_visible_sides_of_a_box_differ_in_grey() -> None:
    greys, counts = np.unique(decoded(thumbnail(cuboid(1, 1, 1)))[..., 0], return_counts=True)
    assert len([grey for grey, count in zip(greys, counts, strict=True) if grey > 0 and count > 1000]) == 3


def test_creases_are_drawn_and_round_walls_are_clean() -> None:
    wall = slice(105, 140)  # rows where only the wall is in sight, not the rims
    assert darkest_inside(decoded(thumbnail(cuboid(1, 1, 1)))[wall]) < 0.8 * DARKEST_SHADING
    assert darkest_inside(decoded(thumbnail(cylinder(24)))[wall]) >= DARKEST_SHADING
    assert darkest_inside(decoded(thumbnail(cylinder(6)))[wall]) < 0.8 * DARKEST_SHADING


def test_a_part_in_front_of_another_is_outlined() -> None:
    back = cuboid(1.0, 1.0, 0.5)

    def dark_pixels(gap: float) -> int:
        """How many pixels are darker than any shading, with a sheet parallel to the front, a gap before it."""
        sheet = moved(cuboid(0.4, 0.4, 0.0), 0.0, 0.0, 0.25 + gap)
        picture = decoded(thumbnail(concatenate([back, sheet])))
        return int(((picture[..., 1] == 255) & (picture[..., 0] < 0.9 * DARKEST_SHADING)).sum())

    assert dark_pixels(0.1) > dark_pixels(0.002) + 100


def test_reversed_faces_look_the_same() -> None:
    mesh = cuboid(1.0, 0.7, 0.4)
    assert thumbnail(Mesh(mesh.vertices, mesh.faces[:, ::-1]), 64) == thumbnail(mesh, 64)


def test_many_thumbnails_are_those_of_each_whatever_the_threads() -> None:
    meshes = [cuboid(1.0, height, 0.5) for height in (0.2, 0.4, 0.6, 0.8)]
    alone = [thumbnail(mesh, 48) for mesh in meshes]
    assert thumbnails(meshes, 48, threads=1) == alone
    assert thumbnails(meshes, 48, threads=3) == alone
    assert thumbnails([], 48) == []


def test_a_furniture_thumbnail_is_a_small_file() -> None:
    legs = [moved(cuboid(0.08, 0.7, 0.08), x, 0.0, z) for x in (-0.45, 0.45) for z in (-0.25, 0.25)]
    table = concatenate([moved(cuboid(1.0, 0.06, 0.6), 0.0, 0.38, 0.0), *legs])
    assert len(thumbnail(table)) < 4096


@pytest.mark.parametrize("vertices", [np.zeros((3, 3)), np.zeros((0, 3))])
def test_what_has_no_size_is_refused(vertices: np.ndarray) -> None:
    with pytest.raises(ValueError, match=r"no size|without faces"):
        thumbnail(Mesh(vertices, np.arange(len(vertices)).reshape(-1, 3)))
