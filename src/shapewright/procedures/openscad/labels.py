"""Labels and colours of an evaluated OpenSCAD file: the modules that made each face, and what ``color()`` says."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.shapes import Mesh


def meshed(solid: Any, evaluator: Any) -> Mesh:
    """The mesh of a Manifold of an Evaluator.

    The label of a face is the module that made it. Where one module makes all, as ``main();`` does, those that it calls
    are the labels, and so on. What no module made has no label.
    """
    mesh = solid.to_mesh64()
    originals = np.asarray(mesh.run_original_id)
    owners = np.repeat(np.arange(len(originals)), np.diff(np.asarray(mesh.run_index)) // 3)
    names = _names([_modules(evaluator.id_to_call_chain.get(int(one), ())) for one in originals])
    colours = [_colour(evaluator.id_to_color, int(one)) for one in originals]
    labels = tuple(dict.fromkeys(name for name in names if name))
    index = np.array([labels.index(name) if name else -1 for name in names])
    return Mesh(
        np.asarray(mesh.vert_properties)[:, :3],
        np.asarray(mesh.tri_verts),
        index[owners] if labels else None,
        labels,
        face_colours=np.array(colours, dtype=np.uint8)[owners] if any(map(any, colours)) else None,
    )


def _names(chains: Sequence[Sequence[tuple[Any, str]]]) -> list[str | None]:
    """The first module that is not the same call for all; chains go from the outermost call inwards."""
    level = 0
    while chains and len({chain[level][0] if len(chain) > level else None for chain in chains}) == 1:
        if len(chains[0]) <= level:
            break
        level += 1
    return [chain[level][1] if len(chain) > level else None for chain in chains]


def _modules(chain: Sequence[tuple[Any, bool]]) -> list[tuple[Any, str]]:
    """The calls of modules that led to a solid, the outermost first: where each stands, and whose it is."""
    calls = [place for place, module in reversed(chain) if module and place is not None]
    return [((place.origin, place.start_offset), _called(place.origin, place.start_offset)) for place in calls]


@lru_cache(maxsize=1024)
def _called(file: str, start: int) -> str:
    try:
        found = re.match(r"\s*[!#%*]?\s*(\w+)", Path(file).read_text("utf-8")[start:])
    except (OSError, UnicodeDecodeError):
        return ""
    return found[1] if found else ""


def _colour(colours: Mapping[int, Any], original: int) -> tuple[int, ...]:
    given = colours.get(original)
    return tuple(round(255 * min(max(part, 0.0), 1.0)) for part in given) if given else (0, 0, 0, 0)
