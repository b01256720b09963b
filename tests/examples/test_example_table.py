"""The table category: its spaces, and that its shapes are sound, labelled and as large as their parameters say."""

from pathlib import Path

import numpy as np
import pytest

from shapewright import load_procedure
from shapewright.modelling.grammar import Derivation

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "categories" / "table"
VERSIONS = [path.stem for path in sorted(FOLDER.glob("v*.py"))]
LABELS = {
    "legs": {"top", "legs", "apron"},
    "panels": {"top", "panels"},
    "sled": {"top", "legs", "runners"},
    "box": {"top", "box"},
    "trestle": {"top", "legs", "foot"},
    "column": {"top", "column", "foot"},
    "star": {"top", "column", "foot"},
}


def load(version: str):
    return load_procedure(FOLDER / f"{version}.py")


def derive(table, parameters) -> Derivation:
    derivation = table.function(**parameters)
    assert isinstance(derivation, Derivation)
    return derivation


def corners(space, count: int, seed: int):
    """Vectors with every scalar at one of its ends."""
    rng = np.random.default_rng(seed)
    for vector in space.sample(count, seed=seed):
        ends = {p.name: (p.low, p.high)[rng.integers(2)] for p in space if p.classes == 0}
        yield space.canonical(vector | ends)


def test_version_3_has_the_kinds_of_parameters_that_the_paper_s_tables_have():
    kinds = [type(parameter).__name__ for parameter in load("v3").space]
    least = {"Scalar": 6, "Integer": 2, "Binary": 1, "Choice": 1}
    assert all(kinds.count(kind) >= count for kind, count in least.items())
    assert len(kinds) <= 14


@pytest.mark.parametrize("version", VERSIONS)
def test_tables_are_sound(version):
    table = load(version)
    vectors = [table.space.defaults, *table.space.sample(25, seed=5), *corners(table.space, 35, seed=6)]
    for parameters in vectors:
        assert table(**parameters).soundness().sound, parameters


@pytest.mark.parametrize("version", VERSIONS)
def test_every_rule_is_used(version):
    table = load(version)
    rules = table.function.__globals__["rules"]
    counts = rules.check(derive(table, parameters) for parameters in table.space.sample(400, seed=7))
    assert sum(counts.values()) > 400


@pytest.mark.parametrize("version", VERSIONS)
def test_a_table_is_as_high_and_deep_as_its_parameters_say(version):
    table = load(version)
    for parameters in table.space.sample(15, seed=8):
        if parameters.get("base") == "splayed":  # the feet may stand out
            parameters = parameters | {"base": "legs"}
        if version == "v4":
            parameters = parameters | {"splay": 0.0}
        low, high = table(**parameters).bounds
        np.testing.assert_allclose(high - low, [1, parameters["height"], parameters["depth"]], atol=1e-6)


@pytest.mark.parametrize("base", LABELS)
def test_every_part_is_labelled(base):
    table = load(VERSIONS[-1])
    assert set(table(base=base).labels) == LABELS[base]


def test_further_parts_come_with_their_parameters():
    table = load(VERSIONS[-1])
    assert all("shelf" in table(base=base, tiered=True).labels for base in ("legs", "panels", "sled"))
    assert all("stretchers" in table(tiered=True, tier=kind).labels for kind in ("rails", "cross"))
    assert all("back" in table(base=base, back=True).labels for base in ("panels", "trestle"))
    assert count_faces(table(base="star", feet=3), "foot") < count_faces(table(base="star", feet=4), "foot")


def test_a_back_reaches_from_the_top_down_to_its_level():
    table = load(VERSIONS[-1])
    for base in ("panels", "trestle"):
        mesh = table(base=base, back=True, height=1.0, thickness=0.1, level=0.5)
        points = mesh.vertices[mesh.faces[mesh.face_labels == mesh.label_names.index("back")]].reshape(-1, 3)
        assert points[:, 1].min() - mesh.bounds[0, 1] == pytest.approx(0.5 * 0.9)


def test_drawers_of_version_3_come_with_cabinets():
    table = load("v3")
    drawers = [count_faces(table(base="panels", cabinets=count), "drawers") for count in (0, 1, 2)]
    assert drawers[0] == 0 < drawers[1] < drawers[2]


def count_faces(mesh, label: str) -> int:
    return int((mesh.face_labels == mesh.label_names.index(label)).sum()) if label in mesh.labels else 0
