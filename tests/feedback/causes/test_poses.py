"""References that stand another way than the procedure's shapes."""

from typing import Annotated

import numpy as np
import pytest

import shapewright as sw
from shapewright import Range
from shapewright.building import Workers
from shapewright.feedback.case import Case, Replica
from shapewright.feedback.causes.poses import AS_GIVEN, OTHERS, Pose, standings
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.modelling.solids import box


@sw.procedure
def seat(height: Annotated[float, Range(0.4, 0.6)] = 0.5, arm: bool = False):
    legs = box((0.06, height, 0.06), at=(0.27, height / 2, 0.27)).mirror("x", keep=True).mirror("z", keep=True)
    chair = (
        box((0.6, 0.06, 0.6), at=(0, height, 0))
        | legs
        | box((0.6, 1.1 - height, 0.06), at=(0, (1.1 + height) / 2, -0.27))
    )
    return chair | box((0.08, 0.25, 0.6), at=(0.26, height + 0.12, 0)) if arm else chair


def case(reference, **values):
    made = seat(**values)
    where = residuals(reference, made)
    return Case.of("one", reference, False, Replica(0, {**seat.space.defaults, **values}, made, 0.3), where)


def standing(reference, **values):
    with Workers(seat, 1) as crew:
        (found,) = standings([case(reference, **values)], None, crew, 1, [None])
    return found


@pytest.mark.parametrize("quarters", [1, 2, 3])
def test_a_reference_that_faces_another_way_is_told_with_the_turn_that_helps(quarters):
    turned = Pose(quarters).of(seat(0.5))
    found = standing(turned).cause(turned)
    assert found.kind == "another pose" and found.evidence["turned"] == (360 - 90 * quarters) % 360
    assert f"turned by {360 - 90 * quarters} degrees it fits better" in found.text and "--facing found" in found.text


def test_a_reference_on_its_head_is_told():
    turned = Pose(on_its_head=True).of(seat(0.5))
    found = standing(turned).cause(turned)
    assert found.evidence["on_its_head"] and found.text.startswith("stands on its head") and "--up" in found.text


def test_a_mirrored_reference_is_told():
    turned = Pose(mirrored=True).of(seat(0.5, True))
    assert standing(turned, arm=True).told
    found = standing(turned, arm=True).cause(turned)
    assert found.evidence["mirrored"] and not found.evidence["turned"]


def test_a_reference_that_stands_as_the_replica_is_not_told():
    assert standing(seat(0.5)).pose == AS_GIVEN and not standing(seat(0.5)).told
    assert not standing(seat(0.5, True)).told  # an arm is missing: no pose helps
    assert not standing(box((0.3, 1.0, 0.3)).mesh()).told  # a block is the same in every pose


def test_poses_are_rotations_but_for_mirrored_ones():
    for pose in OTHERS:
        assert np.linalg.det(pose.matrix) == pytest.approx(-1.0 if pose.mirrored else 1.0)
        volume = np.einsum("ij,ij->i", *(lambda t: (t[:, 0], np.cross(t[:, 1], t[:, 2])))(pose.of(seat(0.5)).triangles))
        assert volume.sum() > 0.0
