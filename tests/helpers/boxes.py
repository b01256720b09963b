"""A box of 1 x 2 x 3, as files of several formats hold it: 8 vertices, 12 triangles, area 22."""

import numpy as np

CORNERS = [(x, y, z) for x in (0, 1) for y in (0, 2) for z in (0, 3)]
TRIANGLES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)]
TRIANGLES += [(2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]


def spaced(row) -> str:
    return " ".join(map(str, row))


def obj() -> str:
    faces = "".join(f"f {spaced(i + 1 for i in face)}\n" for face in TRIANGLES)
    return "".join(f"v {spaced(corner)}\n" for corner in CORNERS) + faces


def off(header: str = "OFF\n8 12 0\n") -> str:
    return header + "".join(f"{spaced(c)}\n" for c in CORNERS) + "".join(f"3 {spaced(f)}\n" for f in TRIANGLES)


def ply(name: str = "vertex_indices", after: str = "") -> str:
    header = "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    header += f"element face 12\nproperty list uchar int {name}\nend_header\n"
    return header + off("").replace("\n3 ", f"{after}\n3 ").replace(f"3{after}\n3 0 1 3", "3\n3 0 1 3") + ""


def stl(name: str = "box") -> str:
    facets = []
    for face in TRIANGLES:
        loop = "".join(f"  vertex {spaced(CORNERS[i])}\n" for i in face)
        facets.append(f"facet normal 0 0 0\n outer loop\n{loop} endloop\nendfacet\n")
    return f"solid {name}\n{''.join(facets)}endsolid {name}\n"


def is_box(mesh) -> bool:
    """Whether a mesh has the 12 triangles of the box."""
    expected = np.array(CORNERS, float)[np.array(TRIANGLES)]
    return mesh.triangles.shape == expected.shape and np.allclose(mesh.triangles, expected)
