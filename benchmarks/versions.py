"""Compatible references by version of a procedure: one row a collection, one column a version.

    python benchmarks/versions.py examples/tables demo ../shared/data/references/furniture/table

``demo`` is the bundled collection. Options: --seeds N repeats with other seeds and prints each count.
"""

import argparse
import tempfile
import time
from pathlib import Path

import shapewright as sw
from shapewright.demo import meshes as bundled
from shapewright.storage import cache_folder


def load(source: str) -> sw.Collection:
    if source != "demo":
        return sw.Collection.load(source)
    with tempfile.TemporaryDirectory() as folder:
        bundled.write(Path(folder))
        return sw.Collection.load(folder)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("versions", type=Path, help="folder with v1.py, v2.py, ...")
    parser.add_argument("collections", nargs="+")
    parser.add_argument("--seeds", type=int, default=1)
    arguments = parser.parse_args()
    collections = {source: load(source) for source in arguments.collections}
    versions = sorted(arguments.versions.glob("v*.py"))
    merged = sw.Collection.of(
        {f"{source}|{reference.name}": reference.shape for source, refs in collections.items() for reference in refs}
    )
    print(f"{'version':<8}{'seed':>5}{'seconds':>9}" + "".join(f"{Path(s).name[:18]:>20}" for s in collections))
    for version in versions:
        for seed in range(arguments.seeds):
            started = time.perf_counter()
            iteration = sw.fit(sw.load_procedure(version), merged, sw.Settings(seed=seed), cache=cache_folder())
            seconds = time.perf_counter() - started
            cells = ""
            for source, refs in collections.items():
                results = [iteration[f"{source}|{name}"] for name in refs.names]
                counted = sum(result.compatible for result in results)
                mean_iou = sum(result.iou for result in results) / len(results)
                cells += f"{f'{counted} of {len(refs)} ({mean_iou:.2f})':>20}"
            print(f"{version.stem:<8}{seed:>5}{seconds:>9.0f}{cells}", flush=True)


if __name__ == "__main__":
    main()
