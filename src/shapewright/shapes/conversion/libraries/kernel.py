"""Shapes of the CAD kernel OpenCASCADE, as CadQuery and build123d hold them: as meshes, or as drawings where flat.

The kernel's Python module is OCP; of its static functions some versions have the name with ``_s`` behind it.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from shapewright.shapes.arrays import Floats, Ints
from shapewright.shapes.conversion.naming import refusal
from shapewright.shapes.conversion.polygons import drawing_of
from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh
from shapewright.shapes.shape import Shape

TESSELLATION = 2e-3
"""Share of the diagonal by which triangles may depart from a surface: a fifth of a pixel of 64."""
ANGLE, ANGLE_DRAWN = 0.4, 0.1
"""Greatest turn from one triangle to the next, and of the outline of a drawing, in radians. The libraries' own .1
makes ten times as many triangles, which pictures of 64 pixels do not show."""
_ONE = 1e-6
"""Share of the diagonal within which corners of neighbouring faces are one vertex: far above the kernel's rounding."""
_FLAT = 1e-6
"""Cosine from 1, and share of the size, by which faces of one drawing may depart from its plane."""


def convert(value: Any) -> Shape:
    """The drawing of faces that lie in one plane and bound nothing; the mesh of anything else that has faces.

    Raises TypeError for edges, wires and points, ValueError for a shape of which nothing is left.
    """
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind

    if not hasattr(value, "ShapeType"):
        raise refusal(value)
    if value.IsNull() or not any(_explored(value, kind) for kind in (Kind.TopAbs_FACE, Kind.TopAbs_VERTEX)):
        raise ValueError("the shape is empty: its operations leave nothing")
    if not (faces := _explored(value, Kind.TopAbs_FACE)):
        raise TypeError("it returned lines or points, which have no area; give lines a width, or extrude their outline")
    if not _explored(value, Kind.TopAbs_SHELL) and (drawing := _drawing(value, faces)):
        return drawing
    return _mesh(value, ANGLE)


def _mesh(shape: Any, angle: float) -> Mesh:
    """Its triangles; faces share the vertices along their edges."""
    diagonal = _tessellate(shape, angle)
    points, faces = _triangles(shape)
    if not len(faces):
        raise ValueError("the shape is empty: its operations leave no surface")
    index = _united(points, _ONE * diagonal)
    faces = index[faces]
    whole = (faces != np.roll(faces, 1, axis=1)).all(axis=1)  # at poles and seams triangles have no area
    used, corners = np.unique(faces[whole], return_inverse=True)
    return Mesh(points[used], corners.reshape(-1, 3))


def _tessellate(shape: Any, angle: float) -> float:
    """Let the kernel make triangles, whatever it made before; returns the diagonal of the bounding box."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepTools import BRepTools

    box = Bnd_Box()
    _static(BRepTools, "Clean")(shape)
    _static(BRepBndLib, "Add")(shape, box, False)
    if box.IsVoid():
        raise ValueError("the shape is empty: its operations leave nothing")
    diagonal = float(np.sqrt(box.SquareExtent()))
    BRepMesh_IncrementalMesh(shape, TESSELLATION * diagonal, False, angle, False)
    return diagonal


def _triangles(shape: Any) -> tuple[Floats, Ints]:
    """Vertices (V, 3), each face's own, and faces (F, 3), counter-clockwise seen from outside."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopLoc import TopLoc_Location

    points: list[Floats] = []
    start = -1  # what is added to the kernel's numbers, which begin at 1
    corners: list[tuple[int, int, int]] = []
    for face in _explored(shape, Kind.TopAbs_FACE):
        place = TopLoc_Location()
        made = _static(BRep_Tool, "Triangulation")(face, place)
        if made is None:
            continue
        nodes = [made.Node(i).Coord() for i in range(1, made.NbNodes() + 1)]
        moved = place.Transformation()
        matrix = np.array([[moved.Value(row, column) for column in range(1, 5)] for row in range(1, 4)])
        points.append(np.array(nodes) @ matrix[:, :3].T + matrix[:, 3])
        turned = face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
        for i in range(1, made.NbTriangles() + 1):
            a, b, c = made.Triangle(i).Get()
            corners.append((start + b, start + a, start + c) if turned else (start + a, start + b, start + c))
        start += len(nodes)
    return np.concatenate([np.zeros((0, 3)), *points]), np.array(corners, dtype=np.int64).reshape(-1, 3)


def _united(points: Floats, near: float) -> Ints:
    """Of each point the first one that lies so near."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(near, output_type="ndarray")
    joined = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(points), len(points)))
    groups = connected_components(joined, directed=False)[1]
    _, first = np.unique(groups, return_index=True)
    return np.asarray(first[groups])


def _drawing(shape: Any, faces: list[Any]) -> Drawing | None:
    """Of faces in one plane; None where they are not."""
    import shapely

    axes = [_plane(face) for face in faces]
    if any(axis is None for axis in axes):
        return None
    normals = np.array([axis[0] for axis in axes if axis])
    normal = normals[0]
    diagonal = _tessellate(shape, ANGLE_DRAWN)
    heights = np.array([axis[1] for axis in axes if axis]) @ normal
    if (np.abs(normals @ normal) < 1.0 - _FLAT).any() or np.ptp(heights) > _FLAT * diagonal:
        return None
    points, corners = _triangles(shape)
    flat = points @ _view(normal)
    edges = np.sort(corners[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    once, counts = np.unique(edges, axis=0, return_counts=True)
    outer = once[counts == 1]
    ends = np.cumsum([0, *(_nodes(face) for face in faces)])  # faces may overlap: each has an outline of its own
    own = [outer[(outer[:, 0] >= low) & (outer[:, 0] < high)] for low, high in pairwise(ends)]
    areas = [shapely.build_area(shapely.MultiLineString(list(flat[edges]))) for edges in own]
    return drawing_of([part for area in areas for part in shapely.get_parts(area)])


def _nodes(face: Any) -> int:
    from OCP.BRep import BRep_Tool
    from OCP.TopLoc import TopLoc_Location

    made = _static(BRep_Tool, "Triangulation")(face, TopLoc_Location())
    return made.NbNodes() if made is not None else 0


def _plane(face: Any) -> tuple[Floats, Floats] | None:
    """Normal and a point of the plane in which a face lies; None for a curved one."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType

    surface = BRepAdaptor_Surface(face)
    if surface.GetType() != GeomAbs_SurfaceType.GeomAbs_Plane:
        return None
    axis = surface.Plane().Axis()
    at, along = axis.Location(), axis.Direction()
    return np.array([along.X(), along.Y(), along.Z()]), np.array([at.X(), at.Y(), at.Z()])


def _view(normal: Floats) -> Floats:
    """(3, 2): right and up of who looks at a plane from above, from the front (-Y) or from the right (+X)."""
    side = int(np.abs(normal).argmax())
    towards = normal * np.sign(normal[side]) * (-1.0 if side == 1 else 1.0)
    up = np.array([0.0, 1.0, 0.0]) if side == 2 else np.array([0.0, 0.0, 1.0])
    up = up - towards * (up @ towards)
    up /= np.linalg.norm(up)
    return np.stack([np.cross(up, towards), up], axis=1)


def _explored(shape: Any, kind: Any) -> list[Any]:
    """Its faces, shells or vertices, in the kernel's order."""
    return list(_walk(shape, kind))


def _walk(shape: Any, kind: Any) -> Iterator[Any]:
    from OCP.TopAbs import TopAbs_ShapeEnum as Kind
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        found = explorer.Current()
        yield _static(TopoDS, "Face")(found) if kind == Kind.TopAbs_FACE else found
        explorer.Next()


def _static(kind: Any, name: str) -> Any:
    return getattr(kind, f"{name}_s", None) or getattr(kind, name)
