"""Solids to write procedures with: primitives, sweeps, furniture's details, anchors, moves, booleans, deformations.

Space is Y up with the front towards +Z, in units of your own. Every primitive takes its ``size`` (width along x, height
along y, depth along z; one number for three equal ones), which it fills, and ``at``, where its centre goes:

    top = cylinder((1, 0.05, 0.6), at=(0, 0.7, 0)).label("top")
    leg = box((0.06, 0.7, 0.06), at=(0.3, 0.35, 0.2))
    table = top | leg.mirror("x", keep=True).mirror("z", keep=True).label("legs")

Angles are degrees, counter-clockwise when the axis points at you. A Solid never changes: each verb returns a new one.
The booleans are those of manifold3d, which evaluates them when a mesh, a volume, bounds or a label is asked for;
coordinates are double precision throughout. docs/modelling.md shows everything here in pictures.
"""

from shapewright.modelling.anchors import Space, between, face, on, under, within
from shapewright.modelling.arguments import Axis, Direction, Vector
from shapewright.modelling.curves import bezier, spline
from shapewright.modelling.solid.details import chamfered_box, cushion, rounded_box, slats, tapered_leg, turned_leg
from shapewright.modelling.solid.primitives import box, cone, cylinder, prism, sphere
from shapewright.modelling.solid.sections import Polygon, ellipse, rectangle
from shapewright.modelling.solid.solid import Solid, hull, union
from shapewright.modelling.solid.sweeps import extrude, loft, revolve, sweep

__all__ = ["Axis", "Direction", "Polygon", "Solid", "Space", "Vector", "hull", "union"]
__all__ += ["box", "cone", "cylinder", "prism", "sphere"]
__all__ += ["bezier", "ellipse", "extrude", "loft", "rectangle", "revolve", "spline", "sweep"]
__all__ += ["chamfered_box", "cushion", "rounded_box", "slats", "tapered_leg", "turned_leg"]
__all__ += ["between", "face", "on", "under", "within"]
