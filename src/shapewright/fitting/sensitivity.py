"""Parameters that have no effect on the shape, found by changing one at a time."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from shapewright.building import Build
from shapewright.parameters import Parameters, ParameterSpace, Value
from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import render

ALL_AROUND = (Camera(35.0, 25.0), Camera(215.0, 25.0), Camera(125.0, -25.0), Camera(305.0, -25.0))
SIZE = 128  # pixels along the side of these pictures; those of the network have 64 by default
_TRIES = (4, 12)  # shapes on which a parameter is tried: these many first, then more, where it has shown no effect yet
_VISIBLE = 8  # grey levels of 255


def without_effect(
    space: ParameterSpace,
    builds: Sequence[Build],
    build: Callable[[Sequence[Parameters]], Sequence[Build]],
    seed: int = 0,
    threads: int | None = None,
) -> list[str]:
    """Names of the parameters whose change alone changes no picture of any shape tried, scale and place aside.

    builds: shapes of random vectors, of which up to 16 a parameter are tried, each where the parameter matters; build:
    how to build more of them. A parameter that matters in none of the vectors has no effect either.
    """
    rng = np.random.default_rng(seed)
    active = [set(space.active(item.parameters)) for item in builds]
    inert = {p.name: [item for item, names in zip(builds, active, strict=True) if p.name in names] for p in space}
    for start, count in zip((0, _TRIES[0]), _TRIES, strict=True):
        asked = [(name, item) for name, items in inert.items() for item in items[start : start + count]]
        varied = build([_vary(space, name, item.parameters, rng) for name, item in asked])
        for (name, item), other in zip(asked, varied, strict=True):
            if name in inert and _differ(item, other, threads):
                del inert[name]
    return list(inert)


def _vary(space: ParameterSpace, name: str, values: Parameters, rng: np.random.Generator) -> Parameters:
    """The values with this parameter at another of its levels."""
    parameter = space[name]
    spread = [parameter.decode(float(share)) for share in np.linspace(0.0, 1.0, 5)]
    levels: Sequence[Value] = parameter.levels or spread
    others = [level for level in levels if level != values[name]]
    return space.canonical({**values, name: others[int(rng.integers(len(others)))]})


def _differ(one: Build, other: Build, threads: int | None) -> bool:
    """Whether one could be built and the other could not, or both were and look different from somewhere."""
    if one.shape is None or other.shape is None:
        return one.shape is not other.shape
    shapes = [one.shape.normalised(), other.shape.normalised()]
    before, after = render(shapes, ALL_AROUND, SIZE, threads=threads).astype(int)
    return bool((np.abs(after - before) > _VISIBLE).any())
