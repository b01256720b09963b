"""tools/kit_names.py: the kit's names for completion in the page."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_the_page_has_the_names_of_now() -> None:
    """If this fails: python tools/kit_names.py, in the folder of the project."""
    spec = importlib.util.spec_from_file_location("shapewright_kit_names", ROOT / "tools" / "kit_names.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    kept = (ROOT / "studio-page" / "src" / "loop" / "kit.json").read_text(encoding="utf-8")
    assert kept == module.text()
    names = {(entry["of"], entry["name"]): entry for entry in json.loads(kept)}
    assert names["shapewright.modelling.solids", "box"]["call"].startswith("(size")
    assert ("Solid", "mirror") in names and ("shapewright", "Range") in names
