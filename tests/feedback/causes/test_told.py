"""What is told of a replica is told of the one that is shown."""

import re
from dataclasses import replace
from itertools import combinations, product

import pytest

from shapewright.feedback.case import Case, Replica
from shapewright.feedback.causes.structure import differences
from shapewright.feedback.causes.told import remark, shown_regions, told_causes
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.modelling.solids import box, cone, cylinder

PARTS = {
    "seat": box((0.6, 0.06, 0.6), at=(0, 0.45, 0)),
    "legs": box((0.06, 0.42, 0.06), at=(0.27, 0.21, 0.27)).mirror("x", keep=True).mirror("z", keep=True),
    "panel": box((0.6, 0.5, 0.06), at=(0, 0.72, -0.27)),
    "arms": box((0.06, 0.25, 0.5), at=(0.27, 0.6, 0)).mirror("x", keep=True),
    "tray": box((0.4, 0.03, 0.3), at=(0, 0.2, 0)),
    "stalk": cylinder((0.1, 0.42, 0.1), at=(0, 0.21, 0)),
}
KINDS = [
    ("seat", *some) for count in (1, 2, 3) for some in combinations(("legs", "panel", "arms", "tray", "stalk"), count)
]


def made(kind, *stretched):
    solid = None
    for name in kind:
        part = PARTS[name].scale((1, 1.3, 1)) if name in stretched else PARTS[name]
        labelled = part.label(name)
        solid = labelled if solid is None else solid | labelled
    return solid.mesh()


def case(reference, shown, covering=None):
    """Of a reference whose file names no parts."""
    reference = replace(reference, face_labels=None, label_names=())
    where = residuals(reference, shown)
    found = Case.of("one", reference, False, Replica(0, {}, shown, 0.3), where)
    if covering is None:
        return found
    return replace(found, covering=Replica(0, {}, covering, 0.3), covering_residuals=residuals(reference, covering))


def test_a_missing_region_has_the_name_that_the_file_gives_its_part():
    reference, shown = made(("seat", "legs", "panel")), made(("seat", "legs"))
    one = Case.of("one", reference, False, Replica(0, {}, shown, 0.3), residuals(reference, shown))
    cause = told_causes(one, differences(one.residuals))[0]
    assert (cause.kind, cause.evidence["part"]) == ("missing part", "panel")
    assert cause.text.startswith("missing: the reference's part 'panel', ")


def test_a_name_that_all_of_the_reference_has_is_not_told():
    reference, shown = made(("seat", "legs", "panel")).label("chair"), made(("seat", "legs"))
    one = Case.of("one", reference, False, Replica(0, {}, shown, 0.3), residuals(reference, shown))
    assert "part" not in told_causes(one, differences(one.residuals))[0].evidence


PAIRS = [(KINDS[i], KINDS[(7 * i + 3) % len(KINDS)], KINDS[(5 * i + 11) % len(KINDS)]) for i in range(len(KINDS))]


@pytest.mark.parametrize(("wanted", "here", "best"), PAIRS)
def test_every_part_that_is_named_is_one_of_the_shown_replica_and_every_number_is_of_it(wanted, here, best):
    one = case(made(wanted), made(here), made(best))
    labels = set(here)
    for cause in told_causes(one, differences(one.covering_residuals)):
        assert cause.label is None or cause.label in labels
        assert not (set(re.findall(r"[a-z]+", cause.text)) & set(PARTS)) - labels
        assert set(cause.evidence.get("where", {}).get("parts", ())) <= labels
        if cause.kind != "missing part":
            shares = {round(region.share, 4) for region in one.residuals.of("surplus")}
            assert cause.evidence.get("surplus", 0.0) <= sum(shares) + 1e-3
        if cause.kind == "surplus part":
            assert cause.label not in wanted or cause.label in here
            assert any(region.label == cause.label for region in one.residuals.of("surplus"))
    for region in shown_regions(one):
        assert region.label is None or region.label in labels


def test_a_surplus_part_of_another_replica_is_not_told():
    one = case(made(("seat", "legs")), made(("seat", "legs", "tray")), made(("seat", "legs", "arms")))
    (cause,) = told_causes(one, differences(one.covering_residuals))
    assert cause.kind == "surplus part" and cause.label == "tray" and cause.text.startswith("too much: tray, ")


def test_a_missing_part_is_told_by_its_form_and_its_place():
    one = case(made(("seat", "legs", "panel")), made(("seat", "legs")))
    cause, *_ = told_causes(one, differences(one.covering_residuals))
    assert cause.kind == "missing part" and cause.text.startswith("missing: an upright plate of 0.")
    assert "above seat, at 5" in cause.text and cause.evidence["form"]["copies"] == 1
    assert cause.evidence["where"]["relation"] == "above" and cause.evidence["where"]["parts"] == ("seat",)


def test_copies_that_are_missing_are_counted():
    cause, *_ = told_causes(
        one := case(made(("seat", "stalk", "arms")), made(("seat", "stalk"))), differences(one.residuals)
    )
    assert "2 upright plates" in cause.text and "above seat" in cause.text


def test_what_is_good_enough_has_a_quiet_remark_where_it_differs():
    vase, plain = cone((0.5, 1.0, 0.5), top=0.5, bottom=1.0).mesh(), cylinder((0.5, 1.0, 0.5)).label("body").mesh()
    said = remark(case(vase, plain))
    assert said is not None and said.kind == "wrong form" and "body" in said.text and "the replica 0.5" in said.text
    assert remark(case(plain, plain)) is None


def test_there_is_always_a_cause():
    for wanted, here in product(KINDS[:6], KINDS[:6]):
        one = case(made(wanted), made(here))
        assert told_causes(one, differences(one.covering_residuals))
