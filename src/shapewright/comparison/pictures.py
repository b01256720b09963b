"""How alike two drawings are as pictures: overlap and visual information fidelity."""

from __future__ import annotations

import numpy as np

from shapewright.comparison.outline import silhouette
from shapewright.shapes import Drawing


def intersection_over_union(a: Drawing, b: Drawing) -> float:
    """Area in common over area of both, each drawing normalised: 0 to 1. It is exact, no matter how thin the lines."""
    first, second = a.normalised().geometry, b.normalised().geometry
    common = float(first.intersection(second).area)
    return common / (first.area + second.area - common)


def visual_information_fidelity(reference: Drawing, replica: Drawing) -> float:
    """Share of the reference's visual information that the replica keeps, black on white at 256 x 256 pixels.

    Sheikh and Bovik, "Image information and visual quality", 2006, in the pixel domain: 1 for the same picture, about
    0 for an unrelated one. It is not symmetric.
    """
    import torch
    from torchmetrics.functional.image import visual_information_fidelity as fidelity

    target, image = (torch.from_numpy(255.0 * (1.0 - silhouette(d).astype(np.float32))) for d in (reference, replica))
    return float(fidelity(image[None, None], target[None, None]))
