"""tools/message_types.py: the types of the messages in TypeScript."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import pytest

from shapewright.studio.project.preferences import Preferences
from shapewright.studio.wire.values import Slug, Values

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "studio-page" / "src" / "wire" / "messages"


@pytest.fixture(scope="module")
def types() -> Any:
    spec = importlib.util.spec_from_file_location("shapewright_message_types", ROOT / "tools" / "message_types.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_has_the_types_of_now(types: Any) -> None:
    """If this fails: python tools/message_types.py, in the folder of the project."""
    assert {path.name: path.read_text(encoding="utf-8") for path in PAGE.glob("*.ts")} == types.modules()


def test_every_setting_reaches_the_page(types: Any) -> None:
    message = Preferences().message()
    assert set(message.__struct_fields__) == set(Preferences.described())
    text = types.modules()["changes.ts"]
    assert all(f"  {name}: " in text for name in Preferences.described())


@pytest.mark.parametrize(
    ("hint", "text"),
    [
        (float | int | None, "number | null"),
        (list[str | None], "(string | null)[]"),
        (tuple[str, int], "[string, number]"),
        (tuple[Slug, ...], "Slug[]"),
        (dict[Slug, Values], "Record<Slug, Values>"),
        (Any, "unknown"),
    ],
)
def test_types_are_spelled(types: Any, hint: Any, text: str) -> None:
    assert types.spelled(hint) == text


def test_what_has_no_form_in_typescript_is_refused(types: Any) -> None:
    with pytest.raises(TypeError, match="has no form in TypeScript"):
        types.spelled(set[int])
