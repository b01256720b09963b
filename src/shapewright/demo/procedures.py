"""Where the demo's procedures are, solid and drawn: in the examples of a checkout, or bundled with the package."""

from __future__ import annotations

from pathlib import Path

VERSIONS = ("v1", "v2", "v3", "v4", "v5")


def path(version: str, drawn: bool = False) -> Path:
    """The file of one of VERSIONS, of solid tables or of drawn ones."""
    here = Path(__file__).resolve().parent
    bundled, example = ("drawn", "drawings") if drawn else ("tables", "tables")
    candidates = (here / bundled / f"{version}.py", here.parents[2] / "examples" / example / f"{version}.py")
    return next(candidate for candidate in candidates if candidate.exists())
