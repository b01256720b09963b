"""docs/modelling.md: every snippet runs, prints what the page says, and has the pictures that it shows."""

import contextlib
import importlib.util
import io
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from shapewright.modelling.drawing import Sketch
from shapewright.modelling.grammar import Derivation
from shapewright.modelling.grammar.boxes import Box
from shapewright.modelling.solids import Solid
from shapewright.shapes import Mesh
from shapewright.shapes.conversion import as_shape

DOCS = Path(__file__).resolve().parents[2] / "docs"


@pytest.fixture(scope="module")
def drawing():
    spec = importlib.util.spec_from_file_location("shapewright_pictures", DOCS.with_name("tools") / "pictures.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def page():
    return (DOCS / "modelling.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def variables(drawing, page):
    return drawing.run(page)


def test_every_snippet_prints_what_the_page_says(drawing, page):
    found = {}
    for code, printed in drawing.blocks(page):
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(compile(code, "modelling.md", "exec"), found)
        assert output.getvalue() == printed


def test_every_picture_is_there_small_and_of_a_sound_shape(drawing, page, variables):
    pictures = drawing.pictures(page)
    assert len(pictures) > 50 and len({path for _, path in pictures}) == len(pictures)
    for name, path in pictures:
        assert path.stat().st_size < 12_000, name
        shape = as_shape(variables[name])
        state = shape.soundness() if isinstance(shape, Mesh) else shape.geometry
        assert state.sound if isinstance(shape, Mesh) else state.is_valid, f"{name}: {state}"


def test_every_shape_of_the_page_has_a_picture(drawing, page, variables):
    shown = {name for name, _ in drawing.pictures(page)}
    ingredients = {"post", "plank", "peg", "ladder", "derivation", "bar", "hole"}
    kinds = Solid | Derivation | Sketch
    made = {name for name, value in variables.items() if isinstance(value, kinds) and name[0] != "_"}
    assert made - ingredients <= shown


def test_every_verb_is_on_the_page(page):
    for kind in (Box, Solid, Sketch):
        inner = {"within", "mesh", "deformed", "checked", "simplified", "volume", "bounds", "manifold", "labels"}
        inner |= {"area", "drawing", "geometry"}
        fields = set(getattr(kind, "_fields", None) or kind.__dataclass_fields__)
        for verb in {name for name in vars(kind) if name[0] != "_"} - inner - fields:
            assert re.search(rf"\b{verb}\b", page), f"{kind.__name__}.{verb}"


def test_a_picture_is_drawn_as_it_is_kept(drawing, page, variables):
    """One of each way of drawing, within what another processor rounds otherwise."""
    for name, path in drawing.pictures(page):
        if name in ("bracket", "drilled", "split", "desk", "park_bench"):
            drawn = np.asarray(drawing.draw(variables[name]).convert("RGB"), dtype=float)
            kept = np.asarray(Image.open(path).convert("RGB"), dtype=float)
            assert np.abs(drawn - kept).mean() < 1.0, f"{name} has changed: run python tools/pictures.py {name}"
