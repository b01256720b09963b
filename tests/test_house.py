"""The house as docs/architecture.md tells it: every module has its place there, and no room is crowded."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src" / "shapewright"
MODULES = sorted(
    path.relative_to(PACKAGE) for path in PACKAGE.rglob("*.py") if path.name not in ("__init__.py", "__main__.py")
)
LINES, IN_A_ROOM, AT_THE_TOP = 300, 12, 8


def rooms() -> dict[str, set[str]]:
    """The names of the modules of each room, as the page has them."""
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (?:`(\S+)/`|top) \|.*\|(.*)\|$", page, re.MULTILINE)
    return {room or ".": set(re.findall(r"`(\w+)`", modules)) for room, modules in rows}


def test_the_page_names_every_module_in_its_room_and_no_other():
    there: dict[str, set[str]] = {}
    for module in MODULES:
        there.setdefault(module.parent.as_posix(), set()).add(module.stem)
    assert {room: names for room, names in rooms().items() if names} == there


@pytest.mark.parametrize("module", MODULES, ids=str)
def test_a_module_is_short(module):
    assert len((PACKAGE / module).read_text(encoding="utf-8").splitlines()) <= LINES


def test_no_two_tests_have_one_name():
    names = [path.name for path in Path(__file__).parent.rglob("test_*.py")]
    assert len(names) == len(set(names))


def test_no_room_is_crowded():
    folders = {module.parent for module in MODULES}
    count = {folder.as_posix(): len([m for m in MODULES if m.parent == folder]) for folder in folders}
    assert count.pop(".") <= AT_THE_TOP
    assert max(count.values()) <= IN_A_ROOM
