"""How well the parameters of held-out samples are found: by the network, and after a thorough search.

    python benchmarks/recovery.py examples/categories/shelf/v3.py [FILE...]
        [--samples 12000] [--epochs 20] [--refined 200]

Two rows a procedure, of the network on all held-out samples and of refinement on the first --refined of them: mean
absolute error of the scalars (share of their Ranges), then the F1 of every other parameter, and the seconds spent.
"""

import argparse
import time
from pathlib import Path

import numpy as np

import shapewright as sw
from shapewright.fitting.evaluation import evaluate


def row(metrics: dict) -> str:
    errors = [found["mae"] for found in metrics.values() if "mae" in found]
    others = {name: found["f1"] for name, found in metrics.items() if "f1" in found}
    each = "  ".join(f"{name} {f1:.3f}" for name, f1 in others.items())
    return f"MAE {np.mean(errors):.4f}   least F1 {min(others.values(), default=1.0):.3f}   {each}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("procedures", type=Path, nargs="+")
    parser.add_argument("--samples", type=int, default=12_000)
    parser.add_argument("--epochs", type=int, default=20)
    parser.add_argument("--refined", type=int, default=200)
    parser.add_argument("--refine", choices=("quick", "thorough"), default="thorough")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int)
    arguments = parser.parse_args()
    settings = sw.Settings(
        samples=arguments.samples, epochs=arguments.epochs, refine=arguments.refine, workers=arguments.workers
    )
    for path in arguments.procedures:
        started = time.perf_counter()
        trials = evaluate(sw.load_procedure(path), settings, [arguments.seed], refined=arguments.refined)
        for trial in trials:
            print(f"{path}  network  {trial.seconds:.0f} s   {row(trial.metrics)}", flush=True)
            seconds = time.perf_counter() - started - trial.seconds
            print(f"{path}  refined  {seconds:.0f} s   {row(trial.refined)}", flush=True)


if __name__ == "__main__":
    main()
