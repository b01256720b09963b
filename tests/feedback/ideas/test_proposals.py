from dataclasses import replace

import numpy as np
import pytest

import shapewright as sw
from shapewright.feedback.case import Replica
from shapewright.feedback.ideas.hypothesis import ALL_OTHERS, Hypothesis
from shapewright.feedback.ideas.needed_ranges import narrowed
from shapewright.feedback.ideas.proposal import Misfit
from shapewright.feedback.ideas.proposals import frames_of, proposals
from shapewright.feedback.ideas.wider_ranges import of_longer
from shapewright.feedback.parts.attachment import separate
from shapewright.feedback.parts.pieces import Piece
from shapewright.feedback.parts.supports import bounds_of
from shapewright.rules.library import bundled_rules, library

TABLE = """from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box


@procedure
def table(
    height: Annotated[float, Range(0.4, 0.8, steps=5)] = 0.6,
    drawers: Annotated[int, Range(0, 2)] = 0,
    overhang: Annotated[float, Range(0.0, 0.1)] = 0.05,
):
    top = box((1, 0.06, 0.7), at=(0, height, 0)).label("top")
    leg = box((0.06, height, 0.06), at=(0.47 - overhang, height / 2, 0.32)).label("legs")
    return top | leg.mirror("x", keep=True).mirror("z", keep=True)
"""


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "table.py"
    path.write_text(TABLE)
    return sw.load_procedure(path)


def misfit(table, row, *hypotheses, **parameters):
    values = {**table.space.defaults, **parameters}
    replica = Replica(row, values, table(**values), 0.3)
    return Misfit(replica, replica, replica, hypotheses)


def made(table, misfits):
    return proposals(TABLE, "table", table.space, misfits, ["top", "legs"])


def loads(tmp_path, proposal, ranges=None):
    path = tmp_path / "changed.py"
    path.write_text(proposal.write(ranges or proposal.ranges))
    return sw.load_procedure(path)


def test_ends_that_several_misfits_rest_on_are_moved_alone_and_together(table, tmp_path):
    misfits = [misfit(table, i, height=0.8, drawers=2) for i in range(3)] + [misfit(table, 9, overhang=0.1)]
    ranges = [each for each in made(table, misfits) if each.kind == "range"]
    assert {each.title for each in ranges} >= {
        "A wider Range of height",
        "A wider Range of drawers",
        "A wider Range of drawers and height",
    }
    assert not any("overhang" in each.title for each in ranges)
    (height,) = [each for each in ranges if each.title == "A wider Range of height"]
    assert set(height.starts) == {0, 1, 2}
    wide = loads(tmp_path, height).space["height"]
    assert wide.low == 0.4 and wide.high == pytest.approx(1.6) and wide.steps == 13
    needed = narrowed(height, table.space, [{"height": 0.93}, {"height": 1.07}])
    assert needed["height"] == pytest.approx((0.4, 1.1, 0.6))
    assert loads(tmp_path, height, needed).space["height"].steps == 8
    assert narrowed(height, table.space, [{"height": 1.59}])["height"][1] <= 1.6
    (both,) = [each for each in ranges if each.title == "A wider Range of drawers and height"]
    shorter, longer = of_longer(both, table.space, {"drawers": (0, 2, 0), "height": (0.4, 0.9, 0.6)})
    assert (
        shorter.title == "A wider Range of height" and shorter.ends == (("height", "high"),) and [*longer] == ["height"]
    )
    assert of_longer(both, table.space, {"drawers": (0, 2, 0), "height": (0.4, 0.8001, 0.6)})[1] == {}
    (drawers,) = [each for each in ranges if each.title == "A wider Range of drawers"]
    assert loads(tmp_path, drawers).space["drawers"].high == 4


def shelf(level, width=0.9):
    return Piece("box", np.array([-width / 2, level - 0.02, -0.3]), np.array([width / 2, level + 0.02, 0.3]))


def test_pieces_that_hypotheses_share_become_one_rule(table, tmp_path):
    misfits = [
        misfit(table, i, Hypothesis(pieces=(shelf(level),), cost=1000.0, before=4000.0))
        for i, level in enumerate((0.1, 0.2, 0.3))
    ]
    (plate,) = [each for each in made(table, misfits) if each.kind == "new part"]
    assert plate.title == "A plate" and set(plate.starts) == {0, 1, 2}
    procedure = loads(tmp_path, plate)
    for each in misfits:
        start = plate.candidates(each)[0]
        assert start["plate"] is True and procedure(**start).label_names == ("top", "legs", "plate")
        assert plate.uses(start) and not plate.uses({**start, "plate": False})
    other = misfit(table, 7)
    assert plate.candidates(other)[0]["plate_level"] == pytest.approx(plate.ranges["plate_level"][2])
    needed = narrowed(plate, table.space, [plate.candidates(each)[0] for each in misfits])
    assert needed["plate_level"][1] < plate.ranges["plate_level"][1]


def test_what_a_proposal_adds_is_made_alone_of_the_same_parameters(table, tmp_path):
    (rule,) = [rule for rule in bundled_rules("supports") if rule.name == "tapered_legs"]
    piece = Piece("rule", np.array([-0.5, 0.02, -0.35]), np.array([0.5, 0.57, 0.35]), rule=rule)
    piece = replace(piece, arguments={"thickness": 0.1, "foot": 0.5})
    change = Hypothesis(removed=("legs",), pieces=(piece,), cost=900.0, before=3000.0)
    legs = [each for each in made(table, [misfit(table, 0, change), misfit(table, 1, change)]) if each.rule.alone]
    longer = [each for each in made(table, [misfit(table, i, height=0.8) for i in (0, 1)]) if each.kind == "range"]
    for proposal in legs:
        text = proposal.adding(proposal.change(proposal.ranges))
        (tmp_path / "alone.py").write_text(text)
        whole, alone = loads(tmp_path, proposal), sw.load_procedure(tmp_path / "alone.py")
        (values,) = proposal.candidates(misfit(table, 0))
        assert "top" in whole(**values).label_names and alone(**values).label_names == ("legs",)
        assert np.allclose(alone(**values).bounds, [(-0.45, 0, -0.35), (0.45, 0.6, 0.35)])  # the whole: up to the top
    assert legs and longer[0].adding(longer[0].change(longer[0].ranges)) is None


def test_parts_that_go_or_stand_further_in(table, tmp_path):
    drawn = Hypothesis(inset=("legs",), scale=(0.7, 0.7), cost=1000.0, before=3000.0)
    gone = Hypothesis(removed=("legs",), cost=900.0, before=3000.0)
    block = Hypothesis(removed=("legs",), pieces=(shelf(0.3),), cost=900.0, before=3000.0)
    disc = Piece("cylinder", np.array([-0.5, 0.57, -0.35]), np.array([0.5, 0.63, 0.35]))
    rounded = Hypothesis(("top",), (ALL_OTHERS,), scale=(0.7, 0.7), pieces=(disc,), cost=900.0, before=3000.0)
    found = made(table, [misfit(table, i, each) for i, each in enumerate((drawn, gone, block, rounded))])
    assert {each.kind for each in found} == {"moved part", "part removed", "part replaced"}
    for each in found:
        changed = loads(tmp_path, each)
        assert len(changed().faces) == len(table().faces)
        (row,) = each.starts
        assert changed(**each.candidates(misfit(table, row))[0]).extent.max() > 0
    (removed,) = [each for each in found if each.kind == "part removed"]
    assert removed.uses({"with_legs": False}) and not removed.uses({"with_legs": True})
    (moved,) = [each for each in found if each.kind == "moved part"]
    assert moved.flag is None and moved.uses({})
    round_top = next(each for each in found if "disc" in each.title)
    assert round_top.title.endswith("the rest drawn in")
    mesh = loads(tmp_path, round_top)(**round_top.candidates(misfit(table, 3))[0])
    assert frames_of(mesh, ["legs"])["legs"][1, 0] == pytest.approx(0.7 * 0.45, abs=0.01)


def test_parts_that_are_splayed_alone_and_where_another_goes(table, tmp_path):
    legs = Hypothesis(splayed=("legs",), scale=(1.4, 1.0), cost=1000.0, before=3000.0)
    bare = Hypothesis(("top",), splayed=("legs",), scale=(1.4, 1.4), cost=900.0, before=3000.0)
    alone, instead = made(table, [misfit(table, 0, legs), misfit(table, 1, bare)])
    if alone.rule.flag:
        alone, instead = instead, alone
    assert alone.title == "The legs splayed" and instead.title == "The legs splayed, without the top"
    assert {each.kind for each in (alone, instead)} == {"moved part"}
    width = table().extent[0]
    unchanged, splayed = (loads(tmp_path, alone)(**values) for values in ({}, alone.candidates(misfit(table, 0))[0]))
    assert unchanged.extent[0] == pytest.approx(width) and unchanged.label_names == ("top", "legs")
    np.testing.assert_allclose(frames_of(splayed, ["legs"])["legs"][:, 0], [-0.45 * 1.4, 0.45 * 1.4])
    mesh = loads(tmp_path, instead)(**instead.candidates(misfit(table, 1))[0])
    assert mesh.label_names == ("legs",) and mesh.extent[0] == pytest.approx(1.26)


def test_nothing_in_common_is_no_proposal(table):
    assert made(table, [misfit(table, 0)]) == []


def test_a_rule_of_the_library_takes_the_box_of_the_part_in_whose_place_it_comes(table):
    (rule,) = [rule for rule in bundled_rules("supports") if rule.name == "tapered_legs"]
    several = []
    for row, height in enumerate((0.6, 0.7)):
        low, high = np.array([-0.5, 0.02, -0.35]), np.array([0.5, height - 0.03, 0.35])
        piece = Piece("rule", low, high, rule=rule, arguments={"thickness": 0.1 + 0.02 * row, "foot": 0.5})
        change = Hypothesis(removed=("legs",), pieces=(piece,), cost=900.0, before=3000.0)
        several.append(misfit(table, row, change, height=height))
    (found,) = proposals(TABLE, "table", table.space, several, ["top", "legs"])
    assert found.title == "Tapered legs in place of the legs"
    source = found.write(found.ranges)
    assert 'space = within(shape.part("legs"))' in source and "space.fill(tapered_legs, thickness=" in source
    assert "def tapered_legs(size, thickness=0.12, foot=0.5):" in source and "with_tapered_legs: bool = False" in source
    assert found.ranges["tapered_legs_thickness"][:2] == (0.05, 0.3)  # as the rule says, whatever two misfits need
    assert {q.name for q in found.rule.quantities} == {"tapered_legs_thickness", "tapered_legs_foot"}


def test_a_rule_that_is_deeper_than_the_part_it_replaces_stands_as_high_as_the_part(tmp_path):
    chair = """from shapewright.modelling.solids import box


@procedure
def chair(seat: Annotated[float, Range(0.3, 0.6)] = 0.45):
    plate = box((0.5, 0.06, 0.5), at=(0, seat - 0.03, 0)).label("seat")
    back = box((0.5, 1 - seat, 0.04), at=(0, (1 + seat) / 2, -0.23)).label("back")
    return plate | back | box((0.4, seat - 0.06, 0.4), at=(0, (seat - 0.06) / 2, 0)).label("legs")
"""
    path = tmp_path / "chair.py"
    path.write_text("from typing import Annotated\n\nfrom shapewright import Range, procedure\n" + chair)
    procedure = sw.load_procedure(path)
    (rule,) = [rule for rule in bundled_rules("plans") if rule.name == "leaning_panel"]
    several = []
    for row, (seat, depth) in enumerate(((0.45, 0.12), (0.5, 0.14))):
        low, high = np.array([-0.25, seat + 0.1, -0.25]), np.array([0.25, 1.0, -0.25 + depth])
        piece = Piece("rule", low, high, rule=rule, arguments={"thickness": 0.2 + 0.1 * row})
        change = Hypothesis(removed=("back",), pieces=(piece,), cost=900.0, before=3000.0)
        several.append(misfit(procedure, row, change, seat=seat))
    labels = ["seat", "back", "legs"]
    (found,) = proposals(path.read_text(), "chair", procedure.space, several, labels)
    names = [q.name for q in found.rule.quantities]
    assert names == ["leaning_panel_thickness", "leaning_panel_part_thickness"]  # of the space, and of the rule
    changed = loads(tmp_path, found)
    for row in (0, 1):
        (values,) = found.candidates(several[row])
        made = changed(**changed.space.carry(values))
        assert separate(made) == 1
        low, high = bounds_of(made, "leaning panel")
        assert low[1] == pytest.approx(values["seat"], abs=1e-6) and high[1] == pytest.approx(1.0, abs=1e-6)
        assert high[2] - low[2] == pytest.approx((0.12, 0.14)[row], rel=0.05)


@pytest.mark.parametrize("size", [(0.5, 0.4, 0.08), (0.1, 0.5, 0.1)])
def test_every_rule_of_the_library_can_be_written_and_built_in_any_space(table, tmp_path, size):
    for rule in library():
        several = []
        for row, grown in enumerate((1.0, 1.2)):
            low = np.array([-0.4, 0.1 + 0.03 * row, -0.2])
            values = {parameter.name: parameter.default for parameter in rule.space}
            piece = Piece("rule", low, low + grown * np.array(size), rule=rule, arguments=values)
            several.append(misfit(table, row, Hypothesis(pieces=(piece,), cost=900.0, before=3000.0)))
        (found,) = made(table, several)
        changed = loads(tmp_path, found)
        (values,) = found.candidates(several[0])
        assert len(changed(**changed.space.carry(values)).label_names) == 3, rule.name
