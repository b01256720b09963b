"""What torch computes on: the device, its precision, and its threads."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext

import torch

from shapewright.settings import Device
from shapewright.threads import cores


def available() -> list[str]:
    """Devices of this machine, the fastest first."""
    found = {"cuda": torch.cuda.is_available(), "mps": torch.backends.mps.is_available(), "cpu": True}
    return [name for name, there in found.items() if there]


def pick(name: Device = "auto") -> torch.device:
    """The device of that name; "auto" is the fastest there is. Raises ValueError when this machine has no such."""
    if name == "auto":
        return torch.device(available()[0])
    if name not in available():
        raise ValueError(f"device={name!r}: torch finds none here; available: {', '.join(available())}")
    return torch.device(name)


def autocast(device: torch.device) -> AbstractContextManager[object]:
    """Multiply in bfloat16 where the device does so in hardware; elsewhere it would only slow training down."""
    return torch.autocast(device.type, torch.bfloat16) if _fast_bfloat16(device) else nullcontext()


@contextmanager
def torch_threads(threads: int | None) -> Iterator[None]:
    """Run torch on this many threads (all cores by default), and put the number back afterwards."""
    before = torch.get_num_threads()
    torch.set_num_threads(threads or cores())
    try:
        yield
    finally:
        torch.set_num_threads(before)


def _fast_bfloat16(device: torch.device) -> bool:
    if device.type == "cuda":
        return torch.cuda.get_device_capability(device) >= (8, 0)
    supported = getattr(torch.cpu, "_is_avx512_bf16_supported", lambda: False)
    return device.type == "cpu" and bool(supported())
