"""The grammar: which rules apply, what they are given, what comes out, and what errors say."""

from typing import Annotated

import numpy as np
import pytest

from shapewright import Mesh, Range, procedure
from shapewright.modelling.grammar import Grammar, GrammarError, share
from shapewright.modelling.solids import box as block
from shapewright.modelling.solids import cylinder
from shapewright.shapes import concatenate

SIZE = (1.2, 0.7, 0.8)


def table():
    grammar = Grammar()

    @grammar.rule("table")
    def parts(box, thickness):
        below, top = box.split("y", ..., thickness)
        yield below.tag("base")
        yield top.tag("top")

    @grammar.rule("base", when=lambda p: p.kind == "pedestal")
    def pedestal(box):
        return box.sub((0.1, None, 0.1)).tag("column")

    @grammar.rule("base", when=lambda p: p.kind == "legs")
    def legs(box, leg=0.06):
        return [corner.tag("leg") for corner in box.corners(leg)]

    return grammar


def shape_of(rule, size=(1, 1, 1), **parameters):
    grammar = Grammar()
    grammar.rule("box")(rule)
    return grammar.derive(size, **parameters)


def test_rules_apply_by_tag_and_condition():
    derivation = table().derive(SIZE, thickness=0.05, kind="legs")
    assert [leaf.label for leaf in derivation.leaves] == ["leg"] * 4 + ["top"]
    assert derivation.counts == {"parts": 1, "legs": 1}
    assert [leaf.label for leaf in table().derive(SIZE, thickness=0.05, kind="pedestal").leaves] == ["column", "top"]


def test_the_shape_is_sound_and_stands_on_the_ground():
    mesh = table().derive(SIZE, thickness=0.05, kind="legs").mesh()
    assert mesh.soundness().sound
    np.testing.assert_allclose(mesh.bounds, [[-0.6, 0, -0.4], [0.6, 0.7, 0.4]])


def test_every_face_knows_its_label_and_its_rule():
    derivation = table().derive(SIZE, thickness=0.05, kind="legs", leg=0.1)
    by_label, by_rule = derivation.mesh(), derivation.mesh("rule")
    np.testing.assert_array_equal(by_label.vertices[by_label.faces].sum(), by_rule.vertices[by_rule.faces].sum())
    assert set(by_label.labels) == {"leg", "top"} and set(by_rule.labels) == {"legs", "parts"}
    assert by_label.rules == by_rule.labels and set(zip(by_label.labels, by_label.rules, strict=True)) == {
        ("leg", "legs"),
        ("top", "parts"),
    }
    top = by_label.triangles[[label == "top" for label in by_label.labels]]
    assert top[..., 1].min() == pytest.approx(0.65)


def test_parameters_are_handed_over_by_name_and_defaults_hold():
    assert shape_of(lambda box, *, w: box.sub((w, None, None)), w=0.5).leaves[0].box.width == 0.5
    thin = table().derive(SIZE, thickness=0.05, kind="legs").leaves[0].box
    assert thin.width == pytest.approx(0.06)
    with pytest.raises(GrammarError, match=r"rule parts\(\) on the box 'table' .*asks for thickness, which derive\(\)"):
        table().derive(SIZE, kind="legs")


def test_a_derivation_is_a_shape_of_a_procedure():
    grammar = table()

    @procedure
    def model(leg: Annotated[float, Range(0.05, 0.2)] = 0.1):
        return grammar.derive(SIZE, thickness=0.05, kind="legs", leg=leg)

    assert isinstance(model(), Mesh) and model(leg=0.2).soundness().sound


def test_labels_are_tags_unless_said_otherwise():
    grammar = Grammar()

    @grammar.rule("box")
    def first(box):
        left, middle, right = box.split("x", ..., ..., ...)
        yield left.tag("plain")
        yield middle.label("named").tag("divided")
        yield right

    @grammar.rule("divided")
    def second(box):
        low, high = box.split("y", ..., ...)
        yield low.tag("low")
        yield high.label("other").tag("high")

    assert [leaf.label for leaf in grammar.derive(1).leaves] == ["plain", "named", "other", "box"]


def test_sides_have_labels_of_their_own():
    mesh = shape_of(lambda box: box.label("seat").label("cloth", "top").label("trim", "front", "back")).mesh()
    normals = np.cross(*(mesh.triangles[:, i] - mesh.triangles[:, 0] for i in (1, 2)))
    for label, expected in (("cloth", {(0, 1, 0)}), ("trim", {(0, 0, 1), (0, 0, -1)})):
        assert {tuple(n) for n in normals[[found == label for found in mesh.labels]].round(9)} == expected
    round_ = shape_of(lambda box: box.round().label("cloth", "top")).mesh()
    assert set(round_.labels) == {"box", "cloth"}


def test_recursion_ends_where_a_rule_says_so():
    grammar = Grammar()

    @grammar.rule("step")
    def stairs(box, height):
        if box.height <= height:
            return box
        low, rest = box.split("y", height, ...)
        return [low, rest.inset(z=(0, height)).tag("step")]

    derivation = grammar.derive((1, 1, 2), height=0.2)
    assert derivation.counts["stairs"] == 5 and len(derivation.leaves) == 5
    assert derivation.mesh().soundness().sound


def test_voids_are_cut_out_of_what_their_rule_makes():
    def wall(box):
        yield box
        yield box.sub((0.4, 0.4, None)).void()

    window = shape_of(wall, (1, 1, 0.2))
    assert window.solid().volume == pytest.approx(0.2 * (1 - 0.16))
    assert window.mesh().soundness().sound
    with pytest.raises(ValueError, match="voids can only be cut out when boxes are joined"):
        window.mesh(join=False)

    grammar = Grammar()

    @grammar.rule("box")
    def both(box):
        left, right = box.split("x", ..., ...)
        yield left.tag("pierced")
        yield right

    @grammar.rule("pierced")
    def pierced(box):
        yield box
        yield box.inset(y=0.4).move((0.3, 0, 0)).void().tag("hole")

    @grammar.rule("hole")
    def hole(box):
        yield from box.split("z", 0.5, ...)

    assert grammar.derive(1).solid().volume == pytest.approx(1 - 0.2 * 0.2)  # the right half is not cut


def test_what_is_made_in_a_deformed_box_is_one_piece_and_deformed_with_it():
    def back(box):
        bent = box.bend(60, "x", towards="z", fixed=0.5)
        posts, rail = bent.ends("x", 0.1), bent.split("y", ..., 0.2)[1]
        return [*posts, rail]

    derivation = shape_of(back, (1, 0.8, 0.05))
    mesh = derivation.mesh()
    assert mesh.soundness().sound and mesh.soundness().components == 1
    assert mesh.bounds[1, 2] > 0.1
    apart = derivation.mesh(join=False)
    assert apart.soundness().components == 3
    np.testing.assert_allclose(apart.bounds, mesh.bounds, atol=2 * derivation.tolerance)


def test_boxes_in_a_leaning_box_are_united_and_stay_as_plain_as_they_were():
    def leaning(box):
        return [piece.label(name) for piece, name in zip(box.split("x", 0.3, ...), ("left", "right"), strict=True)]

    grammar = Grammar()
    grammar.rule("box")(lambda box: box.path((0, 0, 0), (0.2, 0, 0.1)).tag("inner"))
    grammar.rule("inner")(leaning)
    mesh = grammar.derive((1, 1, 1)).mesh()
    assert mesh.soundness().sound and set(mesh.labels) == {"left", "right"}
    assert len(mesh.faces) == len(shape_of(leaning).mesh().faces)
    np.testing.assert_allclose(mesh.bounds, [[-0.5, 0, -0.5], [0.7, 1, 0.6]])
    assert len(shape_of(lambda box: box.path((0, 0, 0), (0.2, 0, 0.1))).mesh().faces) == 12


def test_deformations_of_mirror_images_are_mirror_images():
    def legs(box):
        for corner in box.corners(0.1):
            leg = corner.taper(0.5, "-y").path((0, 0, 0), (0.1, 0, 0.05), axis="-y").twist(20).bend(10, towards="x")
            yield leg.rotate(15, "z").bulge(0.02, "right")

    for mesh in (shape_of(legs).mesh(), shape_of(legs).mesh(join=False)):
        points = {tuple(point) for point in mesh.vertices.round(8) + 0.0}
        assert {tuple(point) for point in (mesh.vertices * (-1, 1, 1)).round(8) + 0.0} == points
        assert {tuple(point) for point in (mesh.vertices * (1, 1, -1)).round(8) + 0.0} == points


def test_forms():
    assert shape_of(lambda box: box.round()).solid().volume == pytest.approx(np.pi / 4, rel=0.02)
    for axis in "xyz":
        rounded = shape_of(lambda box, axis=axis: box.round(0.2, axis), (1, 2, 3))
        assert rounded.mesh().soundness().sound
        across = {"x": 6, "y": 3, "z": 2}[axis]
        assert rounded.solid().volume == pytest.approx(6 - (4 - np.pi) * 0.04 * 6 / across, rel=5e-3)
        np.testing.assert_array_equal(np.ptp(rounded.mesh().bounds, axis=0), [1, 2, 3])
    filled = shape_of(lambda box: [end.fill(cylinder, segments=8) for end in box.ends("x", 0.2)])
    assert filled.mesh().soundness().components == 2 and len(filled.mesh().faces) == 2 * 28
    np.testing.assert_allclose(filled.mesh().bounds, [[-0.5, 0, -0.5], [0.5, 1, 0.5]])


def test_a_filling_faces_as_its_box_and_keeps_its_labels():
    def ramp(size, at=(0, 0, 0)):
        x, y, z = size
        low = block((x, y / 2, z), at=(0, -y / 4, 0)).label("low")
        return low | block((x / 2, y / 2, z), at=(x / 4, y / 4, 0))  # higher to the right

    mesh = shape_of(lambda box: [end.fill(ramp) for end in box.ends("x", 0.2)]).mesh()
    assert set(mesh.labels) == {"low", "box"}
    high = mesh.vertices[mesh.vertices[:, 1] > 0.9]
    assert set(np.abs(high[:, 0]).round(9)) == {0.4, 0.5}


def test_a_patch_takes_rules_too():
    grammar = Grammar()

    @grammar.rule("chest")
    def chest(box):
        yield box
        yield box.face("front").tag("front")

    @grammar.rule("front")
    def drawers(patch):
        for drawer in patch.inset(x=0.1, y=0.1).repeat("y", count=3, gap=0.05):
            yield drawer.extrude(0.02).tag("drawer")

    mesh = grammar.derive(1).mesh()
    assert mesh.soundness().sound and mesh.bounds[1, 2] == pytest.approx(0.52)
    with pytest.raises(GrammarError, match=r"rule <lambda>\(\): the box '' .*has no thickness; extrude the patch"):
        shape_of(lambda box: box.face("top"))


def test_bulges_of_patches():
    def tufted(box):
        for row in box.face("top").repeat("x", count=2):
            for patch in row.repeat("z", count=2):
                box = box.bulge(0.1, patch)
        return box

    mesh = shape_of(tufted, (1, 0.3, 1)).mesh()
    assert mesh.soundness().sound
    peaks = mesh.vertices[np.isclose(mesh.vertices[:, 1], 0.4)]
    assert {tuple(p) for p in np.abs(peaks[:, [0, 2]]).round(9)} == {(0.25, 0.25)} and len(peaks) == 4


def test_the_tree_is_printed():
    text = str(table().derive(SIZE, thickness=0.05, kind="pedestal"))
    assert text.splitlines() == [
        "table  1.2 x 0.7 x 0.8 at (0, 0.35, 0)  parts()",
        "├─ base  1.2 x 0.65 x 0.8 at (0, 0.325, 0)  pedestal()",
        "│  └─ column  0.1 x 0.65 x 0.1 at (0, 0.325, 0)  column",
        "└─ top  1.2 x 0.05 x 0.8 at (0, 0.675, 0)  top",
    ]


def test_rules_are_counted():
    grammar = table()
    assert len(grammar) == 3 and [rule.name for rule in grammar.rules] == ["parts", "pedestal", "legs"]
    both = [grammar.derive(SIZE, thickness=0.05, kind=kind) for kind in ("legs", "pedestal", "legs")]
    assert grammar.check(both) == {"parts": 3, "legs": 2, "pedestal": 1}
    with pytest.raises(GrammarError, match=r"never applied: pedestal\(\) for 'base' \(its when= never held\)"):
        grammar.check(both[:1])
    grammar.rule("lge")(lambda box: box)
    with pytest.raises(GrammarError, match=r"<lambda>\(\) for 'lge' \(no such box\); there were boxes base, .*leg"):
        grammar.check(both)


def test_a_rule_that_could_never_apply_is_refused():
    grammar = table()
    grammar.rule("base")(lambda box: box)
    with pytest.raises(GrammarError, match=r"rule late\(\) for 'base' would never apply: <lambda>\(\) before"):

        @grammar.rule("base")
        def late(box):
            return box

    with pytest.raises(GrammarError, match=r"a rule parts\(\) already"):

        @grammar.rule("elsewhere")
        def parts(box):
            return box


def test_errors_name_the_rule_and_the_box():
    with pytest.raises(GrammarError, match=r"no rule applies to the box 'base' \(1.2 x 0.65.*pedestal\(\), legs\(\)"):
        table().derive(SIZE, thickness=0.05, kind="trestle")
    with pytest.raises(GrammarError, match=r"rule parts\(\) on the box 'table' \(1.2 x 0.7 x 0.8 .*0.1 more than"):
        table().derive(SIZE, thickness=0.8, kind="legs")
    with pytest.raises(GrammarError, match=r"rule legs\(\) on the box 'base' .*ends: size=0.9"):
        table().derive(SIZE, thickness=0.05, kind="legs", leg=0.9)
    with pytest.raises(GrammarError, match=r"rule <lambda>\(\) on the box 'box' .*bend: .*would fold"):
        shape_of(lambda box: box.bend(300))
    with pytest.raises(GrammarError, match="it must yield boxes"):
        shape_of(lambda box: None)
    with pytest.raises(GrammarError, match="it must yield boxes"):
        shape_of(lambda box: ["box"])
    with pytest.raises(GrammarError, match=r"cannot be applied to the box 'box' .*rounded or filled"):
        shape_of(lambda box: box.round().tag("box"))
    with pytest.raises(GrammarError, match="nothing is left"):
        shape_of(lambda box: []).mesh()


def test_endless_recursion_is_told():
    with pytest.raises(GrammarError, match=r"endless recursion: rule <lambda>\(\) on the box 'box' .* after 64 rules"):
        shape_of(lambda box: box.tag("box"))
    with pytest.raises(GrammarError, match=r"endless recursion: .*boxes$"):
        shape_of(lambda box: [half.tag("box") for half in box.split("x", ..., share(1))])


def test_errors_of_the_author_are_left_as_they_are():
    with pytest.raises(ZeroDivisionError):
        shape_of(lambda box: box.sub((1 / 0, None, None)))


def test_the_same_parameters_give_the_same_shape():
    first, second = (table().derive(SIZE, thickness=0.05, kind="legs") for _ in range(2))
    np.testing.assert_array_equal(first.mesh().vertices, second.mesh().vertices)
    np.testing.assert_array_equal(first.mesh().faces, second.mesh().faces)
    assert first.leaves[0].box == second.leaves[0].box


def test_parts_of_a_derivation_are_solids_to_go_on_with():
    bench = Grammar()

    @bench.rule("bench")
    def parts(box):
        under, seat = box.split("y", ..., 0.1)
        yield seat.tag("seat")
        yield from (corner.tag("legs") for corner in under.corners(0.1))

    shape = bench.derive((1, 0.5, 0.4))
    assert shape.part("legs").volume == pytest.approx(4 * 0.1 * 0.1 * 0.4)
    np.testing.assert_allclose(shape.part("seat").bounds[:, 1], shape.bounds[1, 1] - np.array([0.1, 0]))
    assert shape.without("legs").mesh().label_names == ("seat",)
    assert (shape.without("legs") | shape.part("legs")).volume == pytest.approx((shape | shape.solid()).volume)
    with pytest.raises(ValueError, match="no box is labelled 'back'; the labels are: "):
        shape.part("back")


def test_rules_survive_booleans_and_deformations_where_two_made_parts_of_one_label():
    bed = Grammar()

    @bed.rule("bed")
    def ends(box):
        head, under, foot = box.split("z", 0.1, ..., 0.1)
        yield head.tag("head")
        yield foot.tag("foot")
        yield under.sub((None, 0.2, None), anchor=(0, 0, 0)).tag("frame")

    @bed.rule("head")
    def head_board(box):
        yield box.tag("panel")

    @bed.rule("foot")
    def foot_board(box):
        yield box.sub((None, 0.5, None), anchor=(0, 0, 0)).tag("panel")

    post = block((0.05, 1.5, 0.05), at=(0, 0.75, -0.9)).label("post")
    solid = bed.derive((1, 1, 2)).solid() | post
    for mesh in (solid.mesh(), (solid.taper(0.8) - block(0.3, at=(0.5, 0, 0))).translate((1, 0, 0)).mesh()):
        assert mesh.soundness().sound and mesh.triangles.shape[0] == len(mesh.rules)
        middle = mesh.triangles.mean(axis=1)[:, 2]
        made = {(label, rule) for label, rule in zip(mesh.labels, mesh.rules, strict=True) if label}
        assert made == {("panel", "head_board"), ("panel", "foot_board"), ("frame", "ends"), ("post", None)}
        assert middle[[rule == "head_board" for rule in mesh.rules]].max() < 0
        assert middle[[rule == "foot_board" for rule in mesh.rules]].min() > 0
        both = concatenate([mesh, mesh.label("all"), post.mesh()])
        assert both.rules == mesh.rules * 2 + (None,) * len(post.mesh().faces)
