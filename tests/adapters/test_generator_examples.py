"""The examples of docs/generators.md: they build sound shapes, stand up, and keep their names."""

from pathlib import Path

import pytest

from shapewright import load_procedure

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "generators"
NAMES = {"stool": {"seat", "leg 0", "leg 1", "leg 2", "leg 3"}, "enclosure": {"body", "posts", "lid"}}


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.py")), ids=lambda path: path.stem)
def test_an_example_builds_what_its_parameters_say(path):
    for library in ("cadquery", "build123d"):
        if library in path.read_text(encoding="utf-8"):
            pytest.importorskip(library, reason="needs the extras; run `make test-adapters`")
    example = load_procedure(path)
    assert example.facts.stated == {"up": "z", "unit": "mm", "size": "given"}
    mesh = example(**example.space.defaults)
    assert set(mesh.label_names) == NAMES.get(path.stem, set())
    assert mesh.soundness().closed
    taller = (
        example(**example.space.defaults | {"height": 1.2 * example.space.defaults.get("height", 1.0)})
        if ("height" in example.space.names)
        else mesh
    )
    assert (taller.extent[1] > mesh.extent[1]) == ("height" in example.space.names)
