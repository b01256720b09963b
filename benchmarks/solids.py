"""How long solids take to build, mesh included: python benchmarks/solids.py

The best of several rounds on one thread, so that what else runs on the machine matters little.
"""

import timeit
from collections.abc import Callable
from pathlib import Path
from typing import Any

from shapewright import load_procedure
from shapewright.modelling.solids import box, cone, cylinder, extrude, prism, revolve, sphere

TABLES = Path(__file__).resolve().parents[1] / "examples" / "tables"
STAR = [(0, 0), (3, 1), (4, 4), (1, 3)]


def main() -> None:
    a, b, far = box(1).label("a"), box(1, at=(0.5, 0.4, 0.3)).label("b"), box(1, at=(3, 0, 0))
    solids: dict[str, Callable[[], Any]] = {
        "box": lambda: box((1, 2, 3)),
        "cylinder": lambda: cylinder((1, 2, 3)),
        "cone": lambda: cone((1, 2, 3), top=0.5),
        "sphere": lambda: sphere((1, 2, 3)),
        "prism": lambda: prism((1, 2, 3)),
        "extrude": lambda: extrude(STAR, 2),
        "extrude, twisted": lambda: extrude(STAR, 2, twist=90),
        "revolve": lambda: revolve(STAR),
        "a | b, apart": lambda: a | far,
        "a | b": lambda: a | b,
        "a & b": lambda: a & b,
        "a - b": lambda: a - b,
        "array of 4": lambda: a.array(4, (2, 0, 0)),
        "label, rotated": lambda: box(1).label("a").rotate(30),
    }
    for name, build in solids.items():
        show(name, lambda build=build: build().mesh())
    for path in sorted(TABLES.glob("v*.py")):
        table = load_procedure(path)
        legs = table.space["legs"].levels if "legs" in table.space.names else [None]
        for kind in legs:
            parameters = {} if kind is None else {"legs": kind}
            show(f"table {path.stem} {kind or ''}", lambda table=table, parameters=parameters: table(**parameters))


def show(name: str, build: Callable[[], Any], rounds: int = 7, repeats: int = 100) -> None:
    build()
    seconds = min(timeit.repeat(build, number=repeats, repeat=rounds)) / repeats
    print(f"{name:22} {seconds * 1e6:8.1f} us")


if __name__ == "__main__":
    main()
