"""The five example tables: their spaces, soundness and labels, and their shapes against another implementation's."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from shapewright import Mesh, load_procedure

ROOT = Path(__file__).resolve().parents[2]
KNOWN = ROOT.parent / "shared" / "data" / "parameters"
VERSIONS = ["v1", "v2", "v3", "v4", "v5"]
LEGS = {"v3": ("basic", "support"), "v4": ("basic", "support", "pedestal")}


def load(version: str):
    return load_procedure(ROOT / "examples" / "tables" / f"{version}.py")


def inside(mesh: Mesh, points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether each point lies in the union of the mesh's closed parts: signed crossings of an upward ray."""
    a, b, c = (mesh.triangles[:, i] for i in range(3))

    def side(p: NDArray[np.float64], q: NDArray[np.float64]) -> NDArray[np.float64]:
        along, to = q - p, points[:, None] - p
        return along[:, 0] * to[..., 2] - along[:, 2] * to[..., 0]

    weights = np.stack([side(b, c), side(c, a), side(a, b)])
    area = weights.sum(axis=0)
    hit = (weights > 0).all(axis=0) | (weights < 0).all(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        height = (weights * np.stack([a[:, 1], b[:, 1], c[:, 1]])[:, None]).sum(axis=0) / area
        above = hit & (height > points[:, None, 1])
    return (above * np.sign(area)).sum(axis=1) != 0


def beside_surface(mesh: Mesh, count: int, rng: np.random.Generator, gap: float = 1e-4) -> NDArray[np.float64]:
    """Random points of the surface, each moved by ``gap`` to either side of it."""
    a, b, c = (mesh.triangles[:, i] for i in range(3))
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    chosen = rng.choice(len(areas), count, p=areas / areas.sum())
    weights = rng.dirichlet((1, 1, 1), count)
    points = np.einsum("nk,nkd->nd", weights, mesh.triangles[chosen])
    step = gap * normals[chosen] / areas[chosen, None]
    return np.concatenate([points + step, points - step])


@pytest.mark.parametrize("version", VERSIONS)
def test_the_space_is_the_one_that_the_versions_promise(version):
    space = load(version).space
    scalars = {p.name: (p.low, p.high, len(p.levels)) for p in space if p.classes == 0}
    assert scalars == {
        "height": (0.5, 1.0, 8),
        "breadth": (0.3, 1.0, 8),
        "top_thickness": (0.05, 0.25, 5),
        "leg_thickness": (0.05, 0.25, 5),
    }
    classes = {p.name: p.levels for p in space if p.classes}
    tops = {} if version == "v1" else {"round_top": (False, True)}
    legs = ("basic", "support", "pedestal", "split")[: VERSIONS.index(version)]
    assert classes == (tops | {"legs": legs} if len(legs) > 1 else tops)


@pytest.mark.parametrize("version", VERSIONS)
def test_every_table_is_closed_and_spans_its_parameters(version):
    table = load(version)
    for parameters in table.space.sample(40, seed=1):
        mesh = table(**parameters)
        edges = np.sort(mesh.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        _, uses = np.unique(edges, axis=0, return_counts=True)
        assert (uses % 2 == 0).all()
        height, breadth, legs = parameters["height"], parameters["breadth"], parameters.get("legs")
        foot = 0.5 if legs == "pedestal" else 0.0
        bar = (
            height / 3 + breadth * parameters["leg_thickness"] / 2 if legs == "support" else 0.0
        )  # thick ones hang low
        low, high = mesh.bounds
        np.testing.assert_allclose(high, [0.5, height / 2, max(breadth, foot) / 2], atol=1e-9)
        np.testing.assert_allclose(low, [-0.5, -max(height / 2, bar), -max(breadth, foot) / 2], atol=1e-9)


@pytest.mark.parametrize("version", VERSIONS[1:])
def test_a_version_still_makes_what_the_version_before_made(version):
    before, after = load(VERSIONS[VERSIONS.index(version) - 1]), load(version)
    for parameters in before.space.sample(20, seed=2):
        old, new = before(**parameters), after(**parameters)
        np.testing.assert_array_equal(old.vertices, new.vertices)
        np.testing.assert_array_equal(old.faces, new.faces)


@pytest.mark.parametrize(
    ("legs", "labels"),
    [
        ("basic", {"top", "legs"}),
        ("support", {"top", "legs", "stretchers"}),
        ("pedestal", {"top", "legs", "foot"}),
        ("split", {"top", "legs", "foot"}),
    ],
)
def test_every_face_is_labelled(legs, labels):
    assert set(load("v5")(legs=legs).labels) == labels
    assert set(load("v5")(legs=legs, round_top=True).labels) == labels


@pytest.mark.parametrize("version", VERSIONS[:3])
@pytest.mark.skipif(not KNOWN.is_dir(), reason="needs ../shared/data/parameters: shapes of another implementation")
def test_tables_equal_those_of_another_implementation(version):
    known = np.load(KNOWN / f"tables_{version}.npz")
    table = load(version)
    rng = np.random.default_rng(0)
    for i in rng.choice(len(known["height"]), 40, replace=False):
        ours = table(**{name: known[name][i].item() for name in table.space.names}).normalised()
        vertices = slice(*known["vertex_offsets"][i : i + 2])
        faces = slice(*known["face_offsets"][i : i + 2])
        theirs = Mesh(known["vertices"][vertices], known["faces"][faces])
        np.testing.assert_allclose(ours.bounds, theirs.bounds, atol=1e-6)
        points = np.concatenate([beside_surface(ours, 300, rng), beside_surface(theirs, 300, rng)])
        np.testing.assert_array_equal(inside(ours, points), inside(theirs, points))
