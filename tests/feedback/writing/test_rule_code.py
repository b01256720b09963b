from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import shapewright as sw
from shapewright.feedback.parts.pieces import Piece
from shapewright.feedback.parts.relations import WHOLE
from shapewright.feedback.writing.edit import with_rule
from shapewright.feedback.writing.piece_code import Quantity, number
from shapewright.feedback.writing.rule_code import addition, drawing_in, removal, splaying
from shapewright.feedback.writing.source import free_name

TABLE = """from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box


@procedure
def table(
    height: Annotated[float, Range(0.4, 1.0)] = 0.7,
    depth: Annotated[float, Range(0.3, 1.0)] = 0.6,
):
    top = box((1, 0.05, depth), at=(0, height - 0.025, 0)).label("top")
    leg = box((0.05, height, 0.05), at=(0.475, height / 2, depth / 2 - 0.025)).label("legs")
    return top | leg.mirror("x", keep=True).mirror("z", keep=True)
"""
FREE = partial(free_name, TABLE, "table")


def frames(height, depth):
    half = depth / 2
    return {
        WHOLE: np.array([(-0.5, 0, -half), (0.5, height, half)]),
        "top": np.array([(-0.5, height - 0.05, -half), (0.5, height, half)]),
        "legs": np.array([(-0.5, 0, -half), (0.5, height, half)]),
    }


SIZES = [(0.5, 0.4), (0.7, 0.6), (0.9, 0.5), (0.6, 0.9)]
FRAMES = [frames(*size) for size in SIZES]


def pieces(low_high, kind="box", **more):
    return [Piece(kind, *np.array(low_high(h, d), dtype=float), **more) for h, d in SIZES]


def built(tmp_path, rule):
    ranges = {
        q.name: (min(q.values) * 0.9 - q.whole, max(q.values) * 1.1 + q.whole, float(np.median(q.values)))
        for q in rule.quantities
    }
    path = tmp_path / "table.py"
    path.write_text(with_rule(TABLE, "table", rule.spelled(ranges)), encoding="utf-8")
    return sw.load_procedure(path)


def part(mesh, label):
    faces = mesh.faces[mesh.face_labels == mesh.label_names.index(label)]
    return sw.Mesh(mesh.vertices, faces).bounds


def test_a_shelf_is_told_relative_to_the_table(tmp_path):
    shelf = pieces(lambda h, d: [(-0.5, 0.3 * h - 0.01, -d / 2), (0.5, 0.3 * h + 0.01, d / 2)])
    rule = addition([shelf], FRAMES, [], None, [""], FREE, "A plate.")
    assert [q.name for q in rule.quantities] == ["plate_thickness", "plate_level"]
    assert rule.quantities[1].values == pytest.approx([0.3] * 4)
    assert rule.function.splitlines()[2:] == [
        "    room = within(shape)",
        '    plate = within(room, (None, plate_thickness * room.height, None), y=plate_level).fill(box).label("plate")',
        "    return shape | plate",
    ]
    procedure = built(tmp_path, rule)
    assert procedure.space.names == ("height", "depth", "plate", "plate_thickness", "plate_level")
    assert procedure.space.active(procedure.space.defaults) == ("height", "depth", "plate")
    bounds = part(procedure(height=0.8, depth=0.5, plate=True, plate_level=0.3), "plate")
    assert bounds[:, 1].mean() == pytest.approx(0.24)
    assert procedure(height=0.8).label_names == ("top", "legs")


def test_a_pedestal_reaches_from_its_foot_to_the_top_in_place_of_the_legs(tmp_path):
    foot = pieces(lambda h, d: [(-0.25, 0, -0.25), (0.25, 0.04, 0.25)], "cylinder")
    column = pieces(lambda h, d: [(-0.05, 0.04, -0.05), (0.05, h - 0.05, 0.05)], "cylinder")
    rule = addition([foot, column], FRAMES, ["legs"], None, ["", ""], FREE, "A pedestal.")
    assert [q.name for q in rule.quantities] == ["disc_width", "disc_thickness", "column_thickness"]
    assert rule.function.splitlines()[2:] == [
        "    room = within(shape)",
        '    space = within(room, (disc_width * room.width, disc_thickness * room.height, None), y="bottom")',
        '    disc = space.fill(cylinder).label("disc")',
        '    room = within(shape, y=between(disc, shape.part("top")))',
        "    thickness = column_thickness * room.width",
        '    column = within(room, (thickness, None, thickness)).fill(cylinder).label("column")',
        '    return shape.without("legs") | disc | column',
    ]
    assert rule.imports == ("between", "cylinder", "within")
    mesh = built(tmp_path, rule)(height=0.9, disc_and_column=True)
    assert mesh.label_names == ("top", "disc", "column") and mesh.soundness().sound
    assert part(mesh, "column")[1, 1] == pytest.approx(0.85)
    assert part(mesh, "column")[0, 1] == pytest.approx(part(mesh, "disc")[1, 1])


def test_a_shelf_behind_a_post_is_told_relative_to_the_table_again(tmp_path):
    post = pieces(lambda h, d: [(-0.02, 0, -0.02), (0.02, h - 0.05, 0.02)])
    shelf = pieces(lambda h, d: [(-0.5, 0.3 * h - 0.01, -d / 2), (0.5, 0.3 * h + 0.01, d / 2)])
    rule = addition([post, shelf], FRAMES, [], None, ["", ""], FREE, "A post and a plate.")
    assert rule.quantities[-1].values == pytest.approx([0.3] * 4)
    mesh = built(tmp_path, rule)(height=0.8, post_and_plate=True, plate_level=0.3)
    assert part(mesh, "plate")[:, 1].mean() == pytest.approx(0.24)


def test_bars_in_the_corners_are_mirrored(tmp_path):
    bars = pieces(
        lambda h, d: [(0.45, 0.1 * h, -d / 2), (0.5, 0.1 * h + 0.05, d / 2)], mirrored=(True, False), middle=(0.0, 0.0)
    )
    rule = addition([bars], FRAMES, [], None, [""], FREE, "Bars.")
    bounds = part(built(tmp_path, rule)(bars=True), "bars")
    np.testing.assert_allclose(bounds[:, 0], [-0.5, 0.5], atol=1e-9)
    assert '.mirror("x", keep=True)' in rule.function and len(rule.quantities) <= 3


def test_a_piece_is_called_what_most_are():
    posts = pieces(lambda h, d: [(-0.05, 0, -0.05), (0.05, h - 0.05, 0.05)])
    columns = [replace(piece, kind="cylinder") for piece in posts]
    for several, name in (([posts[0], *columns[1:]], "column"), ([*columns[:1], *posts[1:]], "post")):
        rule = addition([several], FRAMES, [], None, [""], FREE, "One.")
        assert rule.name == f"add_{name}" and (name == "column") == ("fill(cylinder)" in rule.function)


def test_slats_have_a_count(tmp_path):
    several = [
        Piece("slats x", np.array([-0.4, 0.05, -0.01]), np.array([0.4, h - 0.05, 0.01]), count=n, gap=0.1)
        for (h, _), n in zip(SIZES, (3, 4, 5, 5), strict=True)
    ]
    procedure = built(tmp_path, addition([several], FRAMES, [], None, [""], FREE, "Slats."))
    counted = [len(procedure(spindles=True, spindles_count=n).faces) for n in (3, 5)]
    assert counted[0] < counted[1] and procedure(spindles=True, spindles_count=5).soundness().sound


@pytest.mark.parametrize("kind", ["spokes", "sloping spokes"])
@pytest.mark.parametrize(("counts", "turn"), [((3, 5, 5, 5), -90.0), ((4, 4, 4, 4), 45.0)])
def test_spokes_stand_around_the_middle_as_their_pieces_do(tmp_path, kind, counts, turn):
    several = [
        Piece(kind, np.array([-0.4, 0, -0.3 * d]), np.array([0.4, 0.1, 0.3 * d]), count=n, breadth=0.1, turn=turn)
        for (_, d), n in zip(SIZES, counts, strict=True)
    ]
    rule = addition([several], FRAMES, ["legs"], None, [""], FREE, "Spokes.")
    assert rule.quantities[-1].name == "spokes_count" and rule.quantities[-1].whole
    wanted = dict(zip((q.name for q in rule.quantities), (q.values[1] for q in rule.quantities), strict=True))
    wanted["spokes_count"] = counts[1]
    mesh = built(tmp_path, rule)(height=0.7, depth=0.6, spokes=True, **wanted)
    np.testing.assert_allclose(part(mesh, "spokes"), several[1].mesh().bounds, atol=1e-6)
    assert mesh.soundness().closed


def test_a_part_drawn_in_stays_where_it_was_by_default(tmp_path):
    rule = drawing_in("legs", [(0.7, 0.8)], FRAMES[:1], FREE, "Legs, nearer to the middle.")
    path = tmp_path / "table.py"
    path.write_text(with_rule(TABLE, "table", rule.spelled({q.name: (0.5, 1.0, 1.0) for q in rule.quantities})))
    procedure = sw.load_procedure(path)
    np.testing.assert_allclose(part(procedure(), "legs")[:, 0], [-0.5, 0.5])
    np.testing.assert_allclose(part(procedure(legs_inset_x=0.6), "legs")[:, 0], [-0.3, 0.3])


def test_a_shape_off_the_origin_is_drawn_in_about_its_own_middle():
    aside = [{WHOLE: frames(0.5, 0.5)[WHOLE] + np.array([2, 0, 0])}]
    assert "about=shape.bounds.mean(axis=0)" in drawing_in("legs", [(0.7, 0.8)], aside, FREE, "Legs.").function


def test_a_splayed_part_keeps_its_high_end_and_is_left_alone_where_it_is_missing(tmp_path):
    rule = splaying("legs", [(1.4, 1.2)], [], False, FREE, "Legs, wider apart at the floor.")
    path = tmp_path / "table.py"
    path.write_text(with_rule(TABLE, "table", rule.spelled({q.name: (0.8, 2.0, 1.0) for q in rule.quantities})))
    procedure = sw.load_procedure(path)
    np.testing.assert_allclose(part(procedure(), "legs")[:, 0], [-0.5, 0.5])
    wide = procedure(legs_splay_x=1.5)
    np.testing.assert_allclose(part(wide, "legs")[:, 0], [-0.75, 0.75])
    assert wide.vertices[wide.vertices[:, 1] > 0.69, 0].max() == pytest.approx(0.5)
    apron = splaying("apron", [(1.4, 1.2)], [], False, FREE, "An apron.")
    path.write_text(with_rule(TABLE, "table", apron.spelled({q.name: (0.8, 2.0, 1.5) for q in apron.quantities})))
    assert sw.load_procedure(path)(apron_splay_x=2.0).label_names == ("top", "legs")


def test_a_part_that_may_be_missing(tmp_path):
    rule = removal("legs", FREE)
    path = tmp_path / "table.py"
    path.write_text(with_rule(TABLE, "table", rule.spelled({})))
    procedure = sw.load_procedure(path)
    assert procedure().label_names == ("top", "legs")
    assert procedure(with_legs=False).label_names == ("top",)


def test_numbers_as_an_author_writes_them():
    assert [number(value) for value in (0.12345, 1.0, 12.34, 0.000512)] == ["0.12", "1", "12", "0.00051"]
    assert (
        str(Quantity("count", (2.0,), whole=True).parameter(1, 3, 2, None)) == "count: Annotated[int, Range(1, 3)] = 2"
    )
