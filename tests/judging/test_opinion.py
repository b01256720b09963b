"""What the judge calls the same: by what a person sees, never by one number that a soup or a pose fools."""

import numpy as np
import pytest

import shapewright as sw
from shapewright.judging.differences import Look, compare, regions
from shapewright.judging.opinion import opinion
from shapewright.modelling.solids import box, cone, cylinder, sphere
from shapewright.shapes import Mesh
from shapewright.shapes.mesh import concatenate

CUBE, BALL = box(1).mesh(), sphere(1).mesh()
CAN = cylinder((1, 1.4, 1)).mesh()
OPEN_CAN = (cylinder((1, 1.4, 1)) - cylinder((0.9, 1.4, 0.9), at=(0, 0.1, 0))).mesh()
_CUP = cone((1, 1.2, 1), top=0.6).rotate(180, "x")
GLASS = (_CUP | cylinder((0.1, 1, 0.1), at=(0, -1, 0)) | cylinder((0.8, 0.06, 0.8), at=(0, -1.5, 0))).mesh()
LEG, RAIL = box((0.06, 0.7, 0.06), at=(0.45, 0.35, 0.3)), box((0.9, 0.03, 0.03), at=(0, 0.2, 0.3))
TOP = box((1, 0.05, 0.7), at=(0, 0.72, 0))
TABLE = (TOP | LEG.mirror("x", keep=True).mirror("z", keep=True)).mesh()
WITH_STRETCHER = (TOP | LEG.mirror("x", keep=True).mirror("z", keep=True) | RAIL).mesh()


def value(replica: Mesh, reference: Mesh) -> float:
    return opinion(compare(Look.of(reference), Look.of(replica))[0])


def stretched(mesh: Mesh, *scale: float) -> Mesh:
    return mesh.transformed(np.diag(scale))


@pytest.mark.parametrize(
    ("replica", "reference"),
    [(BALL, CUBE), (CUBE, BALL), (OPEN_CAN, CAN), (CAN, OPEN_CAN)]
    + [(stretched(mesh, 1, 1.25, 1), mesh) for mesh in (CUBE, GLASS, TABLE, CAN)]
    + [(stretched(mesh, 1.25, 1, 1), mesh) for mesh in (CUBE, GLASS, TABLE, CAN)]
    + [(stretched(mesh, 1, -1, 1), mesh) for mesh in (GLASS, TABLE, OPEN_CAN)],
)
def test_what_a_person_never_confuses_is_different(replica, reference):
    assert value(replica, reference) < sw.Settings().close


def test_a_stretcher_too_few_or_too_many_is_not_replicated():
    for pair in ((TABLE, WITH_STRETCHER), (WITH_STRETCHER, TABLE)):
        assert value(*pair) < sw.Settings().replicated < value(pair[0], pair[0])


def test_the_missing_stretcher_is_told_as_a_region_of_its_length():
    looks = Look.of(WITH_STRETCHER), Look.of(TABLE)
    missing, surplus = regions(*looks, compare(*looks)[1])
    assert missing[0].size == pytest.approx(0.8, abs=0.05) and not surplus
    assert missing[0].high[1] - missing[0].low[1] < 0.08


def soups(mesh: Mesh) -> dict[str, Mesh]:
    rng, vertices, faces = np.random.default_rng(0), mesh.normalised().vertices, mesh.faces
    inner = concatenate([mesh, box(0.01, at=tuple(mesh.triangles[0].mean(axis=0) * 0.98)).mesh()])
    return {
        "doubled": Mesh(vertices, np.concatenate([faces, faces[:, ::-1]])),
        "inverted": Mesh(vertices, np.where(rng.random((len(faces), 1)) < 0.5, faces[:, ::-1], faces)),
        "noise": Mesh(vertices + rng.normal(0, 0.003 / np.sqrt(3), vertices.shape), faces),
        "inner": inner,
    }


@pytest.mark.parametrize("flaw", ["doubled", "inverted", "noise", "inner"])
@pytest.mark.parametrize("mesh", [TABLE, GLASS, OPEN_CAN, WITH_STRETCHER], ids=["table", "glass", "can", "stretcher"])
def test_flaws_of_soups_change_no_grade(mesh, flaw):
    assert value(soups(mesh)[flaw], mesh) >= sw.Settings().replicated
    assert value(mesh, soups(mesh)[flaw]) >= sw.Settings().replicated


def test_a_fidelity_rises_as_what_differs_goes():
    values = [value(stretched(GLASS, 1, scale, 1), GLASS) for scale in (1.3, 1.15, 1.1, 1.05, 1.02, 1.0)]
    assert values == sorted(values) and values[-1] > 0.95
