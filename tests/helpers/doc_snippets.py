"""The Python of a page of docs/: each block is a whole file with one procedure, as a reader would copy it."""

import re
from pathlib import Path

PAGES = Path(__file__).resolve().parents[2] / "docs"


def snippets(page: str) -> list[str]:
    """The text of each block of Python."""
    return re.findall(r"^```python\n(.*?)^```", (PAGES / page).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


def library_of(text: str) -> str | None:
    """The library of an extra that a block imports."""
    found = re.search(
        r"^(?:import|from) (cadquery|build123d|bpy|scene_synthesizer|pyvista|meshio)\b", text, re.MULTILINE
    )
    return found[1] if found else None


def build_all(text: str, folder: Path) -> None:
    """Load the block and build its defaults and some samples."""
    from shapewright import load_procedure
    from shapewright.building import Workers

    path = folder / "snippet.py"
    path.write_text(text, encoding="utf-8")
    procedure = load_procedure(path)
    with Workers(procedure, 1) as crew:
        builds = crew.build([procedure.space.defaults, *procedure.space.sample(6, seed=0)])
    failures = [str(build.failure) for build in builds if build.failure]
    assert not failures, failures[0]
