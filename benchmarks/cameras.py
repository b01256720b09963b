"""Fixed against learned cameras: error on held-out samples, and seconds to train.

    python benchmarks/cameras.py examples/tables/v5.py [--views 3] [--seeds 3] [--epochs 20]

One row a seed and kind of cameras: mean absolute error of the scalars (normalised to their Range), mean F1 of the
others, share of true scalars within the predicted 50 % and 90 % intervals, seconds, and where the cameras ended.
"""

import argparse
import time
from collections.abc import Iterable
from pathlib import Path

import numpy as np

import shapewright as sw


def mean(metrics: Iterable[dict], name: str) -> float:
    return float(np.mean([found[name] for found in metrics if name in found] or [np.nan]))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("procedure", type=Path)
    parser.add_argument("--views", type=int, default=3)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--epochs", type=int, default=sw.Settings.epochs)
    parser.add_argument("--rate", type=float, default=sw.Settings.camera_rate)
    arguments = parser.parse_args()
    procedure = sw.load_procedure(arguments.procedure)
    for seed in range(arguments.seeds):
        for cameras in ("fixed", "learned"):
            started = time.perf_counter()
            predictor = sw.train(
                procedure,
                sw.Settings(
                    seed=seed,
                    views=arguments.views,
                    epochs=arguments.epochs,
                    cameras=cameras,
                    camera_rate=arguments.rate,
                ),
            )
            seconds, metrics = time.perf_counter() - started, predictor.metrics.values()
            places = " ".join(f"{c.azimuth:.0f}/{c.elevation:.0f}/{c.distance:.2f}" for c in predictor.cameras)
            print(
                f"seed {seed}  {cameras:7}  MAE {mean(metrics, 'mae'):.4f}  F1 {mean(metrics, 'f1'):.3f}  "
                f"within {mean(metrics, 'within50'):.2f} {mean(metrics, 'within90'):.2f}  {seconds:4.0f} s  {places}",
                flush=True,
            )


if __name__ == "__main__":
    main()
