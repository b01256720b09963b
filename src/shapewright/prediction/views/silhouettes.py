"""What a network sees of an object in a picture, and of samples to learn from: silhouettes from anywhere.

Nobody knows where the camera of a picture stood. So each sample is seen from a place drawn at random, and from another
one in each epoch.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from shapewright.parameters import Parameters, ParameterSpace, Prediction
from shapewright.prediction.dataset import Dataset, encoded
from shapewright.rendering.anywhere import random_places
from shapewright.rendering.cameras import ANYWHERE
from shapewright.rendering.framed import framed, pictures_of
from shapewright.shapes import Bytes, Floats, Mesh, ReferenceShape, Shape, Views
from shapewright.threads import in_threads

_PLACES, _COARSE = 8, 16
"""Places from which each sample is seen, and pixels along the side of a picture, where similar ones are looked for."""
_SIMILAR = 4  # samples that are told for each object


def pictures_from(shapes: Sequence[ReferenceShape], places: Floats, size: int, threads: int | None) -> Bytes:
    """(N, 1, 2, size, size): the same of normalised meshes, each from a place (3,) of its own."""

    def draw(pair: tuple[ReferenceShape, Floats]) -> Bytes:
        shape, place = pair
        assert isinstance(shape, Mesh)
        return np.stack([framed(shape, place[None], size, 2, stretched) for stretched in (False, True)], axis=1)

    return np.stack(in_threads(draw, list(zip(shapes, places, strict=True)), threads))


def view_dataset(
    space: ParameterSpace,
    parameters: Sequence[Parameters],
    shapes: Sequence[Shape],
    size: int,
    seed: int,
    threads: int | None = None,
) -> Dataset:
    """Normalised meshes with their parameters, each seen once from somewhere."""
    places = random_places(len(shapes), np.random.default_rng([seed, len(shapes)]))
    images = pictures_from(shapes, places, size, threads)
    return Dataset(list(parameters), *encoded(space, parameters), images, list(shapes), (ANYWHERE,))


def redrawn(data: Dataset, rng: np.random.Generator, threads: int | None = None) -> Dataset:
    """The same samples, each seen from another place."""
    return replace(data, images=pictures_from(data.shapes, random_places(len(data), rng), data.size, threads))


def most_similar(
    objects: Sequence[Views], data: Dataset, seed: int, threads: int | None = None
) -> list[list[Parameters]]:
    """For each object the parameters of the samples that look most like its first view, from somewhere."""
    rng = np.random.default_rng([seed, len(data), 2])
    places = random_places(_PLACES * len(data), rng).reshape(len(data), _PLACES, 3)

    def draw(pair: tuple[ReferenceShape, Floats]) -> NDArray[np.float32]:
        shape, several = pair
        assert isinstance(shape, Mesh)
        return (framed(shape, several, _COARSE).reshape(len(several), -1) / 255.0).astype(np.float32)

    bank = np.concatenate(in_threads(draw, list(zip(data.shapes, places, strict=True)), threads))
    squares = (bank**2).sum(axis=1)
    found = []
    for shown in objects:
        coarse = pictures_of(shown.views[0], _COARSE)[0, 0].ravel() / np.float32(255.0)
        order = np.argsort(squares - 2.0 * bank @ coarse, kind="stable")[: _PLACES * _SIMILAR] // _PLACES
        found.append([data.parameters[row] for row in dict.fromkeys(order.tolist())][:_SIMILAR])
    return found


def joined(prediction: Prediction, counts: Sequence[int]) -> Prediction:
    """Of views one after the other what they say together of their objects, ``counts`` views each.

    Views are taken as independent: chances are multiplied; scalars are averaged by how sure they are.
    """
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.int64)
    columns: list[NDArray[np.float32]] = []
    spreads: list[NDArray[np.float32] | None] = []
    for column, spread in zip(prediction.columns, prediction.spreads, strict=True):
        if spread is None:
            logs = np.add.reduceat(np.log(np.maximum(column, 1e-6)), starts, axis=0)
            chances = np.exp(logs - logs.max(axis=1, keepdims=True))
            columns.append((chances / chances.sum(axis=1, keepdims=True)).astype(np.float32))
            spreads.append(None)
        else:
            weights = 1.0 / np.maximum(spread, 1e-6)
            total = np.add.reduceat(weights, starts)
            columns.append((np.add.reduceat(weights * column, starts) / total).astype(np.float32))
            spreads.append((np.array(counts) / total).astype(np.float32))
    return replace(prediction, columns=tuple(columns), spreads=tuple(spreads))
