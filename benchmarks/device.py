"""Seconds of a training step of each network on each device of this machine.

    python benchmarks/device.py [--steps 8] [--networks compact vgg19] [--size 64] [--batch 64] [--learned]

Boxes and cylinders, three parameters, three views. One row a network and device: seconds a step, the fastest of
three epochs; what 50 epochs of 2,400 samples would take; and whether two trainings gave the same weights to the bit.
The paper's network at the paper's size is `--networks vgg19 --size 256 --batch 32 --learned`.
"""

import argparse
import time
from typing import Annotated, Literal

import numpy as np
import torch

import shapewright as sw
from shapewright import Range
from shapewright.modelling.solids import box, cylinder
from shapewright.prediction import devices
from shapewright.prediction.dataset import Dataset, make_dataset
from shapewright.prediction.training import Schedule, train_network


@sw.procedure
def block(
    height: Annotated[float, Range(0.2, 1.0)] = 0.5,
    depth: Annotated[float, Range(0.2, 1.0)] = 0.5,
    kind: Literal["box", "cylinder"] = "box",
):
    return (cylinder if kind == "cylinder" else box)((1, height, depth))


SPACE = block.space


def blocks(count: int, size: int) -> Dataset:
    rows = SPACE.sample(count, seed=0)
    return make_dataset(SPACE, rows, [block(**values).normalised() for values in rows], size=size)


def train(data: Dataset, schedule: Schedule) -> tuple[float, torch.nn.Module]:
    """Seconds of the fastest of three epochs after the first, and the network."""
    ends: list[float] = []
    few = data.take(np.arange(4))
    network = train_network(SPACE, data, few, schedule, lambda _: ends.append(time.perf_counter())).network
    return float(np.diff(ends).min()), network


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--networks", nargs="+", choices=["compact", "vgg19"], default=["compact", "vgg19"])
    parser.add_argument("--devices", nargs="+", choices=["cuda", "mps", "cpu"], default=devices.available())
    parser.add_argument("--steps", type=int, default=8, help="in an epoch")
    parser.add_argument("--size", type=int, default=64)
    parser.add_argument("--batch", type=int, default=64)
    parser.add_argument("--learned", action="store_true", help="cameras that are learned with the network")
    arguments = parser.parse_args()
    data = blocks(arguments.steps * arguments.batch, arguments.size)
    print(f"{arguments.size} px, batches of {arguments.batch}, cameras {'learned' if arguments.learned else 'fixed'}")
    for network in arguments.networks:
        for device in arguments.devices:
            schedule = Schedule(
                epochs=4,
                batch=arguments.batch,
                optimiser="adam",
                learning_rate=1e-5,
                camera_rate=5e-4 if arguments.learned else 0.0,
                network=network,
                device=device,
            )
            (seconds, one), (_, other) = train(data, schedule), train(data, schedule)
            step = seconds / arguments.steps
            pairs = zip(one.parameters(), other.parameters(), strict=True)
            same = all(torch.equal(mine, theirs) for mine, theirs in pairs)
            print(
                f"{network:8} {device:5} {step:8.3f} s a step, {50 * 2400 / arguments.batch * step / 60:8.1f} min for "
                f"50 epochs of 2,400, {'the same' if same else 'NOT the same'} weights twice",
                flush=True,
            )


if __name__ == "__main__":
    main()
