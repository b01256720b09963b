"""A map of a collection: its references, and random shapes of the procedure among them."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from shapewright.parameters import Parameters
from shapewright.shapes import Bytes
from shapewright.studio.bench.exploring.layout import layout
from shapewright.studio.bench.exploring.looks import Looks, look_at
from shapewright.studio.bench.workshop import Broken, Workshop
from shapewright.studio.wire.detail import CollectionMap, MappedReference, MappedSample

SAMPLES = 80
_SECONDS = 4.0
"""For which samples are built: the map waits for them."""


@dataclass(frozen=True, eq=False)
class Mapping:
    """The making of one map."""

    looks: Looks
    left: int  # references that are not looked at yet
    workshop: Workshop
    seed: int
    send: Callable[[CollectionMap], None]

    def run(self) -> Iterator[None]:
        """One sample a step; the map is sent at the end, without samples where the procedure makes none."""
        samples: list[tuple[Parameters, Bytes]] = []
        end = time.monotonic() + _SECONDS
        try:
            for values in self.workshop.sample(SAMPLES, self.seed) if self.workshop.open else ():
                built = self.workshop.build(values)
                if built is None or time.monotonic() > end:
                    break
                if built.build.shape is not None:
                    samples.append((built.build.parameters, look_at(built.build.shape.normalised())))
                yield
        except (Broken, ValueError):  # whoever builds the next shape is told
            pass
        self.send(self._made(samples))

    def _made(self, samples: list[tuple[Parameters, Bytes]]) -> CollectionMap:
        slugs, seen = self.looks.together()
        like = [(values, each) for values, each in samples if not slugs or each.shape == seen.shape[1:]]
        every = [*seen, *(each for _, each in like)]
        places = layout(np.stack(every)) if every else np.zeros((0, 2))
        at = [(round(float(x), 4), round(float(y), 4)) for x, y in places]
        return CollectionMap(
            references=[MappedReference(slug=slug, x=x, y=y) for slug, (x, y) in zip(slugs, at, strict=False)],
            samples=[
                MappedSample(parameters=values, x=x, y=y)
                for (values, _), (x, y) in zip(like, at[len(slugs) :], strict=True)
            ],
            left=self.left,
        )
