"""DXF: the areas that closed outlines of a drawing of CAD enclose, through ezdxf."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from io import BytesIO
from typing import Any

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.text import PADDING
from shapewright.shapes import Drawing, Floats

_OUTLINES = ("LINE", "ARC", "CIRCLE", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "SPLINE")
_CHORD, _SEGMENTS = 1e-3, 16
"""How far a segment may be from its curve, as a share of the curve's extent, and segments of a quarter of a circle, at
least."""
_GAP = 1e-5
"""Ends that are so near, as a share of the drawing's extent, meet: programs write six decimals or more."""
_BINARY = b"AutoCAD Binary DXF\r\n\x1a\x00"
_SHOWN = 3


def read_dxf(data: bytes) -> tuple[Drawing, tuple[str, ...], float | None]:
    """What closed outlines in the model space enclose, in the file's units, with notes and the unit in metres.

    An outline within another one is a hole, one within that a region again. What is on layers that are off, frozen or
    not plotted does not count; blocks are taken apart. Raises UnreadableError, with the reason.
    """
    try:
        import ezdxf
        from ezdxf import disassemble, document, recover, units
        from ezdxf.lldxf.tagger import binary_tags_loader
        from ezdxf.path import make_path
    except ImportError as error:
        raise UnreadableError("DXF, which needs ezdxf: pip install 'shapewright[cad]'") from error
    binary = data.startswith(_BINARY)
    if not binary and data.rstrip(PADDING).split()[-2:] != [b"0", b"EOF"]:
        raise UnreadableError("broken: no DXF, or cut short: it does not end with EOF")
    try:
        drawn = document.Drawing.load(binary_tags_loader(data)) if binary else recover.read(BytesIO(data))[0]
    except (ezdxf.DXFError, OSError) as error:
        raise UnreadableError(f"broken: {error}") from error
    hidden = {layer.dxf.name.lower() for layer in drawn.layers if not _shows(layer)}
    others: Counter[str] = Counter()
    curves: list[Floats] = []
    for entity in disassemble.recursive_decompose(drawn.modelspace()):
        kind, layer = entity.dxftype(), entity.dxf.get("layer", "0").lower()
        if entity.dxf.get("invisible", 0) or layer in hidden:
            others["hidden"] += 1
        elif kind not in _OUTLINES or (kind == "POLYLINE" and not entity.is_2d_polyline and not entity.is_3d_polyline):
            others[kind] += 1
        else:
            path = make_path(entity)
            corners = np.array([(x, y) for x, y, _ in path.control_vertices()])
            chord = _CHORD * float(np.ptp(corners, axis=0).max()) if len(corners) else 0.0
            if chord > 0.0:
                curves.append(np.array([(x, y) for x, y, _ in path.flattening(chord, _SEGMENTS)]))
    notes = [f"{count} x {kind} left out" for kind, count in others.most_common()]
    area, loose = _enclosed(curves)
    if area is None:
        raise UnreadableError("; ".join(["no closed outline: its lines enclose nothing", *notes]))
    if loose:
        notes.insert(0, f"{loose} lines left out, which enclose nothing")
    unit = float(units.conversion_factor(drawn.units, units.M)) if drawn.units else None
    return Drawing(area), tuple(notes), unit


def _shows(layer: Any) -> bool:
    plotted = layer.dxf.plot and layer.dxf.name.lower() != "defpoints"
    return bool(plotted and layer.is_on() and not layer.is_frozen())


def _enclosed(curves: Sequence[Floats]) -> tuple[Any, int]:
    """The area within the closed outlines, None where there is none, and the number of lines that are part of none."""
    import shapely

    if not curves:
        return None, 0
    every = np.concatenate(curves)
    extent = float(np.ptp(every, axis=0).max())
    curves = _joined(curves, _GAP * extent)
    closed = [curve for curve in curves if (curve[0] == curve[-1]).all() and len(curve) > 3]
    edges = [shapely.LineString(curve) for curve in curves if not (curve[0] == curve[-1]).all()]
    faces, cuts, dangles, _ = shapely.polygonize_full([shapely.union_all(edges)] if edges else [])
    rings: list[Any] = [shapely.Polygon(curve).buffer(0) for curve in closed]
    rings += [shapely.Polygon(shapely.get_exterior_ring(face)) for face in faces.geoms]
    area: Any = shapely.Polygon()
    seen: set[tuple[float, ...]] = set()
    for ring in rings:
        key = tuple(np.round([*ring.bounds, ring.area / extent], 5 - int(np.floor(np.log10(extent)))))
        if ring.area > (_GAP * extent) ** 2 and key not in seen:  # a line that was drawn twice is one
            seen.add(key)
            area = shapely.symmetric_difference(area, ring)
    parts = [
        part for part in shapely.get_parts(area) if part.geom_type == "Polygon" and part.area > (_GAP * extent) ** 2
    ]
    return (shapely.union_all(parts) if parts else None), len(cuts.geoms) + len(dangles.geoms)


def _joined(curves: Sequence[Floats], gap: float) -> list[Floats]:
    """The curves, with ends that nearly meet at one point."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    ends = np.array([point for curve in curves for point in (curve[0], curve[-1])])
    near = cKDTree(ends).query_pairs(gap, output_type="ndarray")
    graph = coo_array((np.ones(len(near)), (near[:, 0], near[:, 1])), shape=(len(ends), len(ends)))
    _, group = connected_components(graph, directed=False)
    _, first = np.unique(group, return_index=True)
    ends = ends[first[group]]
    starts = zip(curves, ends[::2], ends[1::2], strict=True)
    return [np.concatenate([start[None], curve[1:-1], end[None]]) for curve, start, end in starts]
