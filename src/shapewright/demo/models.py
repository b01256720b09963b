"""The tables of the demo collection, drawn in centimetres, standing on the floor: a plan each, and builders of parts.

The parts overlap and are never united. Three fifths of the tables suit the example versions v1 to v5, give or take
proportions between and beyond the sampled ones; the others are of kinds that no version makes.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from shapewright.modelling.solids import Solid, box, cone, cylinder, extrude, prism


@dataclass(frozen=True)
class Plan:
    """Sizes of a table. Its legs stand in the corners of so much of the width and depth as ``spread`` says."""

    width: float
    height: float
    depth: float
    top: float
    leg: float
    spread: float = 1.0

    @property
    def corner(self) -> tuple[float, float]:
        """(x, z) of the axis of a corner leg."""
        return (self.width * self.spread - self.leg) / 2, (self.depth * self.spread - self.leg) / 2

    @property
    def under(self) -> float:
        """Height of the underside of the top."""
        return self.height - self.top


Builder = Callable[[Plan], list[Solid]]


def four(part: Solid) -> Solid:
    return part.mirror("x", keep=True).mirror("z", keep=True)


def slab(p: Plan) -> list[Solid]:
    return [box((p.width, p.top, p.depth), at=(0, p.under + p.top / 2, 0))]


def disc(p: Plan) -> list[Solid]:
    return [cylinder((p.width, p.top, p.depth), at=(0, p.under + p.top / 2, 0), segments=48)]


def octagon(p: Plan) -> list[Solid]:
    return [prism((p.width, p.top, p.depth), at=(0, p.under + p.top / 2, 0), sides=8)]


def stadium(p: Plan) -> list[Solid]:
    turn = np.linspace(-np.pi / 2, np.pi / 2, 17)
    end = np.stack([np.cos(turn), np.sin(turn)], axis=1) * p.depth / 2 + [(p.width - p.depth) / 2, 0]
    return [extrude(np.concatenate([end, -end]), p.top, at=(0, p.under + p.top / 2, 0))]


def legs(p: Plan) -> list[Solid]:
    x, z = p.corner
    return [four(box((p.leg, p.height, p.leg), at=(x, p.height / 2, z)))]


def turned_legs(p: Plan) -> list[Solid]:
    x, z = p.corner
    return [four(cone((p.leg, p.under, p.leg), at=(x, p.under / 2, z), top=1, bottom=0.6, segments=16))]


def splayed_legs(p: Plan, degrees: float = 12) -> list[Solid]:
    x, z = p.corner
    leg = cone((p.leg, p.under * 1.04, p.leg), at=(x, p.under / 2, z), top=1, bottom=0.5, segments=12)
    hip = (x, p.under, z)
    return [four(leg.rotate(degrees, "z", about=hip).rotate(-degrees, "x", about=hip))]


def bars(p: Plan, level: float, section: float) -> list[Solid]:
    """A frame of four bars between the legs, at a part of the height."""
    x, z = p.corner
    side = box((section, section, 2 * z), at=(x, level * p.height, 0)).mirror("x", keep=True)
    front = box((2 * x, section, section), at=(0, level * p.height, z)).mirror("z", keep=True)
    return [side, front]


def stretchers(p: Plan) -> list[Solid]:
    """Joined like an H, low between the legs."""
    x, z = p.corner
    across = box((p.leg * 0.9, p.leg, 2 * z), at=(x, p.height / 6, 0)).mirror("x", keep=True)
    return [across, box((2 * x, p.leg, p.leg * 0.9), at=(0, p.height / 6, 0))]


def cross(p: Plan) -> list[Solid]:
    """Two diagonal bars between the feet of the legs."""
    x, z = p.corner
    bar = box((2 * np.hypot(x, z), p.leg * 0.7, p.leg * 0.7), at=(0, p.height / 5, 0))
    return [bar.rotate(turn) for turn in (np.degrees(np.arctan2(z, x)), -np.degrees(np.arctan2(z, x)))]


def pedestal(p: Plan) -> list[Solid]:
    foot = max(p.width, p.depth) / 2
    return [
        cylinder((p.leg, p.height - 1, p.leg), at=(0, (p.height - 1) / 2, 0), segments=20),
        cylinder((foot, p.height / 22, foot), at=(0, p.height / 44, 0)),
    ]


def tripod(p: Plan, feet: int = 3) -> list[Solid]:
    column = cone((p.leg, p.under * 0.85, p.leg), at=(0, p.under * 0.575, 0), top=0.7, segments=16)
    foot = box((p.width * 0.38, p.leg * 0.6, p.leg * 0.5), at=(p.width * 0.17, p.height * 0.1, 0))
    foot = foot.rotate(-18, "z")
    return [column, foot.translate((0, -foot.bounds[0, 1], 0)).polar_array(feet)]


def trestle(p: Plan) -> list[Solid]:
    x = p.corner[0]
    post = box((p.leg, p.height, p.leg), at=(x, p.height / 2, 0))
    return [end.mirror("x", keep=True) for end in (post, box((p.leg, p.leg, p.depth), at=(x, p.leg / 2, 0)))]


def sawbuck(p: Plan) -> list[Solid]:
    """Legs crossed like an X under each end, and a beam between them."""
    x = p.corner[0]
    spread = p.depth - 2 * p.leg
    leg = box((p.leg, np.hypot(p.under, spread), p.leg), at=(x, p.under / 2, 0))
    lean = np.degrees(np.arctan2(spread, p.under))
    crossed = [leg.rotate(turn, "x", about=(x, p.under / 2, 0)).mirror("x", keep=True) for turn in (lean, -lean)]
    return [*crossed, box((2 * x, p.leg, p.leg), at=(0, p.under / 2, 0))]


def shelf(p: Plan, level: float = 0.25) -> list[Solid]:
    x, z = p.corner
    return [box((2 * x + p.leg, p.top * 0.8, 2 * z + p.leg), at=(0, level * p.height, 0))]


def apron(p: Plan, deep: float = 0.12) -> list[Solid]:
    """Boards between the legs under the top."""
    x, z = p.corner
    at, size = p.under - deep * p.height / 2, deep * p.height
    front = box((2 * x, size, 2), at=(0, at, z)).mirror("z", keep=True)
    return [front, box((2, size, 2 * z), at=(x, at, 0)).mirror("x", keep=True)]


def drawers(p: Plan, sides: Sequence[int] = (-1, 1), part: float = 0.3) -> list[Solid]:
    """A block of three drawers with fronts and knobs under one end of the top or both."""
    width, tall = p.width * part, p.under - 3
    parts = []
    for side in sides:
        x = side * (p.width - width) / 2
        parts.append(box((width, tall, p.depth - 4), at=(x, 3 + tall / 2, 0)))
        front = box((width - 4, tall / 3 - 3, 2), at=(x, 3 + tall / 6, p.depth / 2 - 2))
        knob = cylinder(3, segments=8).rotate(90, "x").translate((x, 3 + tall / 6, p.depth / 2))
        parts += [part.array(3, (0, tall / 3, 0)) for part in (front, knob)]
    return parts


def panels(p: Plan, back: float = 0.0) -> list[Solid]:
    """Boards instead of legs, and one at the back of so much of the height."""
    side = box((p.leg, p.under, p.depth), at=(p.corner[0], p.under / 2, 0)).mirror("x", keep=True)
    tall = back * p.under
    return [side] if not back else [side, box((p.width, tall, 2), at=(0, p.under - tall / 2, -p.depth / 2 + 3))]


def block(p: Plan) -> list[Solid]:
    """A closed body under the top."""
    return [box((p.width * p.spread, p.under, p.depth * p.spread), at=(0, p.under / 2, 0))]


def table(plan: Plan, *builders: Builder) -> list[Solid]:
    return [part for builder in builders for part in builder(plan)]


def tables() -> dict[str, list[Solid]]:
    """The parts of every table, whole and in centimetres, by name."""
    return {
        "kitchen": table(Plan(120, 74, 80, top=5, leg=7), slab, legs),
        "dining": table(Plan(148, 76, 90, top=4.5, leg=9), slab, legs),
        "square": table(Plan(92, 74, 92, top=5, leg=6), slab, legs),
        "parsons": table(Plan(100, 62, 84, top=13, leg=17), slab, legs),
        "lamp": table(Plan(55, 45, 55, top=6, leg=6), slab, legs),
        "desk": table(Plan(140, 72, 70, top=4, leg=5), slab, legs, apron),
        "hallway": table(Plan(110, 78, 36, top=6, leg=6), slab, legs),
        "butcher-block": table(Plan(104, 88, 70, top=20, leg=12), slab, legs),
        "coffee-low": table(Plan(118, 42, 62, top=5, leg=6), slab, legs),
        "round": table(Plan(104, 74, 104, top=5, leg=7, spread=0.7), disc, legs),
        "round-chunky": table(Plan(90, 58, 90, top=12, leg=16, spread=0.7), disc, legs),
        "oval": table(Plan(140, 74, 92, top=5, leg=7, spread=0.7), disc, legs),
        "oval-narrow": table(Plan(120, 80, 55, top=6, leg=6, spread=0.7), disc, legs),
        "workbench": table(Plan(140, 86, 70, top=8, leg=9), slab, legs, stretchers),
        "refectory": table(Plan(150, 80, 76, top=5, leg=8), slab, legs, stretchers),
        "counter": table(Plan(100, 95, 62, top=6, leg=6), slab, legs, stretchers),
        "side-stretchers": table(Plan(60, 52, 48, top=4, leg=4.5), slab, legs, stretchers),
        "round-stretchers": table(Plan(96, 76, 96, top=6, leg=8, spread=0.7), disc, legs, stretchers),
        "bistro": table(Plan(78, 74, 78, top=4, leg=8), disc, pedestal),
        "cafe": table(Plan(76, 72, 76, top=5, leg=7), slab, pedestal),
        "tulip": table(Plan(120, 73, 88, top=4.5, leg=10), disc, pedestal),
        "column": table(Plan(100, 76, 100, top=9, leg=22), disc, pedestal),
        "hotel": table(Plan(110, 75, 70, top=6, leg=9), slab, pedestal),
        "trestle": table(Plan(148, 75, 76, top=5, leg=8), slab, trestle),
        "sit-stand": table(Plan(130, 88, 68, top=5, leg=6), slab, trestle),
        "altar": table(Plan(110, 84, 42, top=8, leg=9), slab, trestle),
        "refectory-trestle": table(Plan(140, 76, 80, top=7, leg=13, spread=0.92), slab, trestle),
        "mid-century": table(Plan(96, 72, 96, top=4, leg=8, spread=0.5), disc, splayed_legs),
        "peg-legs": table(Plan(90, 48, 60, top=4, leg=6, spread=0.6), stadium, partial(splayed_legs, degrees=18)),
        "cross-stretchers": table(Plan(100, 74, 76, top=5, leg=6), slab, legs, cross),
        "octagon-cross": table(Plan(90, 70, 90, top=5, leg=6, spread=0.62), octagon, turned_legs, cross),
        "shelf": table(Plan(110, 55, 60, top=5, leg=6), slab, legs, shelf),
        "shelf-tiers": table(Plan(60, 58, 44, top=4, leg=4), slab, legs, shelf, partial(shelf, level=0.55)),
        "twin-drawers": table(Plan(150, 75, 72, top=4, leg=5), slab, drawers),
        "partners-desk": table(Plan(140, 76, 84, top=6, leg=5), slab, partial(drawers, part=0.34)),
        "drawers-right": table(Plan(125, 74, 62, top=4, leg=5), slab, legs, partial(drawers, sides=(1,), part=0.36)),
        "panel-desk": table(Plan(130, 74, 70, top=4, leg=4), slab, partial(panels, back=0.5)),
        "waterfall": table(Plan(110, 60, 50, top=5, leg=5), slab, panels),
        "bench": table(Plan(125, 46, 38, top=5, leg=5, spread=0.88), slab, panels, partial(shelf, level=0.35)),
        "chest": table(Plan(100, 50, 56, top=5, leg=5, spread=0.94), slab, block),
        "cube": table(Plan(50, 48, 50, top=4, leg=4), slab, block),
        "sawbuck": table(Plan(140, 76, 80, top=5, leg=7, spread=0.8), slab, sawbuck),
        "picnic": table(Plan(124, 74, 88, top=6, leg=9, spread=0.9), slab, sawbuck),
        "tripod": table(Plan(80, 74, 80, top=4, leg=10), disc, tripod),
        "claw-foot": table(Plan(100, 75, 100, top=5, leg=13), disc, partial(tripod, feet=4)),
    }
