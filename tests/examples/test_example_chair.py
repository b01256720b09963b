"""The chair category: its spaces, and that its shapes are sound, labelled and as large as their parameters say."""

from pathlib import Path

import numpy as np
import pytest

from shapewright import load_procedure
from shapewright.modelling.grammar import Derivation

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "categories" / "chair"
VERSIONS = [path.stem for path in sorted(FOLDER.glob("v*.py"))]
BASES = {
    "legs": {"leg"},
    "sled": {"leg", "runner"},
    "pedestal": {"column", "foot"},
    "plinth": set(),
}


def load(version: str):
    return load_procedure(FOLDER / f"{version}.py")


def derive(chair, parameters) -> Derivation:
    derivation = chair.function(**parameters)
    assert isinstance(derivation, Derivation)
    return derivation


def corners(space, count: int, seed: int):
    """Vectors with every scalar at one of its ends."""
    rng = np.random.default_rng(seed)
    for vector in space.sample(count, seed=seed):
        ends = {p.name: (p.low, p.high)[rng.integers(2)] for p in space if p.classes == 0}
        yield space.canonical(vector | ends)


def test_version_3_has_the_kinds_of_parameters_that_the_paper_s_chairs_have():
    kinds = [type(parameter).__name__ for parameter in load("v3").space]
    assert kinds.count("Scalar") >= 4 and kinds.count("Integer") >= 4


@pytest.mark.parametrize("version", VERSIONS)
def test_chairs_are_sound(version):
    chair = load(version)
    for parameters in [chair.space.defaults, *chair.space.sample(25, seed=5), *corners(chair.space, 40, seed=6)]:
        assert chair(**parameters).soundness().sound, parameters


@pytest.mark.parametrize("version", VERSIONS)
def test_every_rule_is_used(version):
    chair = load(version)
    grammar = chair.function.__globals__["grammar"]
    counts = grammar.check(derive(chair, parameters) for parameters in chair.space.sample(300, seed=7))
    assert sum(counts.values()) > 300


@pytest.mark.parametrize("version", VERSIONS)
def test_a_chair_is_as_wide_high_and_deep_as_its_parameters_say(version):
    chair = load(version)
    upright = {"base": "legs", "splay": 0.0, "lean": 0.0, "curve": 0.0}
    for parameters in chair.space.sample(15, seed=8):
        parameters |= {name: value for name, value in upright.items() if name in parameters}
        low, high = chair(**parameters).bounds
        np.testing.assert_allclose(high - low, [parameters["width"], 1, parameters["depth"]], atol=1e-6)


def test_every_part_is_labelled():
    chair = load(VERSIONS[-1])
    for base, labels in BASES.items():
        assert set(chair(base=base).labels) == labels | {"seat", "back"}
    assert set(chair(base="plinth", back="rails").labels) == {"seat", "post", "rail"}
    assert set(chair(base="plinth", back="slats").labels) == {"seat", "post", "rail", "slat"}
    assert set(chair(base="plinth", arms="open").labels) == {"seat", "back", "arm", "arm post"}
    assert set(chair(base="plinth", arms="solid").labels) == {"seat", "back", "arm"}


def test_stretchers_join_the_legs():
    chair = load(VERSIONS[-1])
    faces = [chair(stretchers=count).labels.count("stretcher") for count in range(3)]
    assert faces[0] == 0 < faces[1] < faces[2]
    assert all(chair(stretchers=count).soundness().components == 1 for count in range(3))


def top_of(mesh):
    return mesh.vertices[mesh.vertices[:, 1] > 0.999]


def test_the_back_leans():
    chair = load(VERSIONS[-1])
    upright, leaning = (chair(base="plinth", lean=lean) for lean in (0.0, 0.3))
    assert upright.bounds[0, 2] - leaning.bounds[0, 2] == pytest.approx(0.3 * (1 - 0.48))


def test_the_back_of_version_3_curves():
    chair = load("v3")
    plain = {"base": "plinth", "rails": 0, "back_thickness": 0.05, "lean": 0.0}
    front = [top_of(chair(**plain, curve=curve))[:, 2].max() for curve in (0.0, 0.13)]
    assert front[1] - front[0] == pytest.approx(0.13 * 0.5, rel=0.2)


def part(mesh, label: str):
    """The corners of the faces that have the label, (N, 3)."""
    return mesh.vertices[mesh.faces[mesh.face_labels == mesh.label_names.index(label)]].reshape(-1, 3)


def test_the_seat_overhangs_its_legs():
    legs = part(load(VERSIONS[-1])(overhang=0.1, width=0.5, depth=0.8), "leg")
    np.testing.assert_allclose(np.ptp(legs[:, [0, 2]], axis=0), [0.4, 0.64])


def test_rails_leave_open_what_is_below_them():
    chair = load(VERSIONS[-1])
    mesh = chair(base="plinth", back="rails", rails=1, opening=0.6, lean=0.0)
    assert part(mesh, "rail")[:, 1].min() - mesh.bounds[0, 1] == pytest.approx(0.48 + 0.6 * 0.52)
