"""What training on less clean shapes brings for real references.

    python benchmarks/augmentation.py examples/tables/v5.py FOLDER... [--seeds 0]

A row with and one without augmentation: mean scalar error on clean held-out samples; compatible references and mean
distance by the network alone, and after quick refinement.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

import shapewright as sw


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("procedure")
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--seeds", nargs="+", type=int, default=[0])
    parser.add_argument("--workers", type=int)
    arguments = parser.parse_args()
    procedure = sw.load_procedure(arguments.procedure)
    found = {f"{d.parent.name}-{one.name}": one.shape for d in arguments.folders for one in sw.Collection.load(d)}
    references = sw.Collection.of(found)
    print(f"{len(references)} references")
    with tempfile.TemporaryDirectory() as cache:
        for seed in arguments.seeds:
            for augment in (False, True):
                cells = []
                for refine in ("off", "quick"):
                    settings = sw.Settings(seed=seed, augment=augment, refine=refine, workers=arguments.workers)
                    iteration = sw.fit(procedure, references, settings, cache=Path(cache))
                    errors = [m["mae"] for m in iteration.metrics["validation"].values() if "mae" in m]
                    distance = np.nanmean([result.distance for result in iteration])
                    cells.append(f"{refine}: {len(iteration.compatible)} compatible, mean {distance:.4f}")
                row = "augmented" if augment else "clean"
                print(f"seed {seed}  {row:10} error {np.mean(errors):.4f}  {'   '.join(cells)}", flush=True)


if __name__ == "__main__":
    main()
