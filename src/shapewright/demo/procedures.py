"""Where the table procedures of the demo are: in the examples of a checkout, or bundled with an installed package."""

from __future__ import annotations

from pathlib import Path

VERSIONS = ("v1", "v2", "v3", "v4", "v5")


def path(version: str) -> Path:
    """The file of one of VERSIONS."""
    here = Path(__file__).resolve().parent
    candidates = (here / "tables" / f"{version}.py", here.parents[2] / "examples" / "tables" / f"{version}.py")
    return next(candidate for candidate in candidates if candidate.exists())
