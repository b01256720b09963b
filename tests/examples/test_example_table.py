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
    "splayed": {"top", "legs", "apron"},
    "panels": {"top", "panels", "apron"},
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


def test_the_last_version_has_the_kinds_of_parameters_that_the_paper_s_tables_have():
    kinds = [type(parameter).__name__ for parameter in load(VERSIONS[-1]).space]
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
        low, high = table(**parameters).bounds
        np.testing.assert_allclose(high - low, [1, parameters["height"], parameters["depth"]], atol=1e-6)


@pytest.mark.parametrize("base", LABELS)
def test_every_part_is_labelled(base):
    table = load(VERSIONS[-1])
    assert set(table(base=base).labels) == LABELS[base]


def test_further_parts_come_with_their_parameters():
    table = load(VERSIONS[-1])
    assert "shelf" in table(tiers=2).labels
    assert all("stretchers" in table(tiers=1, tier=kind).labels for kind in ("rails", "cross"))
    assert "back" in table(base="panels", back=True).labels
    drawers = [count_faces(table(base="panels", cabinets=count), "drawers") for count in (0, 1, 2)]
    assert drawers[0] == 0 < drawers[1] < drawers[2]


def count_faces(mesh, label: str) -> int:
    return int((mesh.face_labels == mesh.label_names.index(label)).sum()) if label in mesh.labels else 0
