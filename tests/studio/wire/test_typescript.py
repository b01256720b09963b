"""The types of the messages in TypeScript."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from shapewright.studio.project.preferences import Preferences
from shapewright.studio.wire.typescript import modules, spelled
from shapewright.studio.wire.values import Slug, Values

PAGE = Path(__file__).parents[3] / "studio-page" / "src" / "wire" / "messages"


def test_the_page_has_the_types_of_now() -> None:
    """If this fails: python -m shapewright.studio.wire.typescript, in the folder of the project."""
    assert {path.name: path.read_text(encoding="utf-8") for path in PAGE.glob("*.ts")} == modules()


def test_every_setting_reaches_the_page() -> None:
    message = Preferences().message()
    assert set(message.__struct_fields__) == set(Preferences.described())
    text = modules()["changes.ts"]
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
def test_types_are_spelled(hint: Any, text: str) -> None:
    assert spelled(hint) == text


def test_what_has_no_form_in_typescript_is_refused() -> None:
    with pytest.raises(TypeError, match="has no form in TypeScript"):
        spelled(set[int])
