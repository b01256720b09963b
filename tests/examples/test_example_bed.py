"""The example beds: spaces, soundness at random and at the corners of the space, sizes, labels, every rule in use."""

from pathlib import Path

import numpy as np
import pytest

from shapewright import load_procedure
from shapewright.modelling.grammar import Grammar

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "categories" / "bed"
VERSIONS = ("v1", "v2", "v3")
PROCEDURES = {version: load_procedure(FOLDER / f"{version}.py") for version in VERSIONS}


def corners(space, count, seed=0):
    """Parameters at the ends of their ranges, chosen at random."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        yield {p.name: p.decode(rng.integers(p.classes) if p.classes else rng.integers(2)) for p in space}


def test_the_last_version_has_the_parameters_of_the_paper_and_more():
    kinds = [type(parameter).__name__ for parameter in PROCEDURES["v3"].space]
    assert kinds.count("Scalar") >= 6
    assert kinds.count("Integer") >= 1


@pytest.mark.parametrize("version", VERSIONS)
def test_beds_are_sound(version):
    procedure = PROCEDURES[version]
    for values in [procedure.space.defaults, *procedure.space.sample(25, seed=1), *corners(procedure.space, 40)]:
        state = procedure(**values).soundness()
        assert state.sound, (values, str(state))


@pytest.mark.parametrize("version", VERSIONS)
def test_parameters_say_how_large_a_bed_is(version):
    procedure = PROCEDURES[version]
    constants = procedure.function.__globals__
    for values in procedure.space.sample(25, seed=2):
        low, high = procedure(**values).bounds
        width = values["width"] - (2 * constants["BLANKET"] if values.get("blanket") else 0)
        head = values["head"] + values.get("arch", 0) * width
        foot = values["foot"] + values.get("arch", 0) * width / 2
        rails = max(constants["RAIL"], values["foot"]) if values.get("rails") else 0
        rails = min(rails, 0.8 * values["headroom"]) if values.get("bunk") else rails
        storey = values["headroom"] + (1 - values["clearance"]) * values["height"] if values.get("bunk") else 0
        top = values["height"] + storey + max(head, foot, rails)
        np.testing.assert_allclose(low, [-values["width"] / 2, 0, -0.5], atol=1e-6)
        np.testing.assert_allclose(high, [values["width"] / 2, top, 0.5], atol=1e-6)


def test_the_last_version_still_makes_what_the_version_before_made():
    before, after = PROCEDURES["v2"], PROCEDURES["v3"]
    for values in before.space.sample(10, seed=3):
        old, new = before(**values), after(**values)
        np.testing.assert_allclose(old.bounds, new.bounds, atol=1e-9)
        assert len(old.faces) == len(new.faces)


def test_labels_tell_what_a_bed_is_made_of():
    beds = PROCEDURES["v3"]
    assert set(beds().labels) == {"post", "panel", "arch", "frame", "mattress", "pillow"}
    assert {"spindle", "rail", "blanket"} <= set(beds(ends="spindles", blanket=True, rails=True).labels)
    assert "pillow" not in beds(pillows=0).labels


@pytest.mark.parametrize("version", VERSIONS)
def test_every_rule_is_used(version):
    procedure = PROCEDURES[version]
    grammar = next(v for v in procedure.function.__globals__.values() if isinstance(v, Grammar))
    counts = grammar.check(procedure.function(**values) for values in procedure.space.sample(60, seed=4))
    assert min(counts.values()) > 0
