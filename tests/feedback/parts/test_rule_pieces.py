import pytest

from shapewright.feedback.parts.gallery import Gallery
from shapewright.feedback.parts.lack import Lack
from shapewright.feedback.parts.rule_pieces import fitted, retrieved
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.modelling.solids import box, cylinder
from shapewright.rules.library import bundled_rules, kinds

GALLERY = Gallery(None)
RULES = {rule.name: rule for kind in kinds() for rule in bundled_rules(kind)}


def cup(thickness):
    body = cylinder((1, 1.2, 1)).label("body")
    return body, body | RULES["half_ring"]((0.4, 0.8, 0.15), thickness=thickness).translate((0.62, 0, 0))


def test_a_handle_is_found_beside_the_cup_and_fitted():
    body, whole = cup(0.25)
    lack = Lack.of(residuals(whole.mesh(), body.mesh()), ())
    found = retrieved(lack, list(RULES.values()), GALLERY)
    best = max(found, key=lambda name: found[name][0])
    assert best in ("half_ring", "bracket") and found[best][1].turn == 0.0
    gain, piece = fitted(found["half_ring"], lack)
    assert gain >= found["half_ring"][0] and piece.centre == pytest.approx((0.62, 0, 0), abs=0.08)


def test_rules_stand_where_such_parts_stand():
    top = box((1, 0.1, 1), (0, 0.9, 0)).label("top")
    table = top | RULES["splayed_legs"]((1, 0.86, 1)).translate((0, 0.43, 0))
    found = retrieved(Lack.of(residuals(table.mesh(), top.mesh()), ()), list(RULES.values()), GALLERY)
    best = max(found, key=lambda name: found[name][0])
    assert RULES[best].stance == "under" and "legs" in best


def test_parts_of_a_stance_are_not_found_elsewhere():
    foot = cylinder((0.6, 0.05, 0.6), (0, 0.025, 0))
    pole = cylinder((0.05, 1, 0.05), (0, 0.5, 0)).label("pole")
    lack = Lack.of(residuals((foot | pole).mesh(), pole.mesh()), ())
    low = retrieved(lack, list(RULES.values()), GALLERY)
    stances = {RULES[name].stance for name, (_, piece) in low.items() if piece.high[1] < 0.1}
    assert "anywhere" in stances and not stances & {"on", "within", "back"}


def test_nothing_is_found_where_nothing_lacks():
    body, _ = cup(0.2)
    assert not retrieved(Lack.of(residuals(body.mesh(), body.mesh()), ()), list(RULES.values()), GALLERY)


def test_the_same_is_found_again():
    body, whole = cup(0.2)
    lack = Lack.of(residuals(whole.mesh(), body.mesh()), ())
    once, again = (retrieved(lack, list(RULES.values()), GALLERY) for _ in range(2))
    assert {name: gain for name, (gain, _) in once.items()} == {name: gain for name, (gain, _) in again.items()}
