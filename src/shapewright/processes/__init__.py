"""Processes of our own that may die, hang or eat memory: only the work in hand is lost with them."""

from shapewright.processes.limits import Limits, Loss

__all__ = ["Limits", "Loss"]
