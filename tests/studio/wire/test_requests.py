"""Requests of the page, checked."""

from __future__ import annotations

from typing import Any

import pytest

from shapewright.studio.wire.requests import (
    ApplyOrder,
    CancelOrder,
    Evaluate,
    ExportOrder,
    FitOrder,
    MarkOrder,
    SourceEdit,
    Wrong,
    check_known,
    decode,
    decode_page_message,
    number,
    one_of,
)


def test_what_is_left_out_has_its_default() -> None:
    assert decode(b"", FitOrder) == FitOrder(fresh=False)
    order = decode('{"what": ["report"]}', ExportOrder)
    assert (order.format, order.count, order.seed) == ("glb", 50, 0)
    message = decode_page_message('{"type": "evaluate", "id": 3, "parameters": {"a": 1, "b": true, "c": "x"}}')
    assert message == Evaluate(id=3, parameters={"a": 1, "b": True, "c": "x"})


@pytest.mark.parametrize(
    ("body", "kind", "said"),
    [
        ('{"what": []}', ExportOrder, "what is a list of replicas, samples, report, parameters"),
        ('{"what": ["report"], "format": "fbx"}', ExportOrder, "format is one of glb, ply, obj, stl, off"),
        ('{"what": ["report"], "count": 0}', ExportOrder, "count lies between 1 and 10000"),
        ('{"what": ["report"], "seed": true}', ExportOrder, "seed is a whole number"),
        ('{"kind": "dance"}', CancelOrder, "kind is one of fit, explain, export"),
        ('{"to": "moon"}', ApplyOrder, "to is copy or procedure"),
        ('{"text": 1}', SourceEdit, "text is a string"),
        ("[]", dict[str, Any], "send a JSON object"),
        ('{"a": "x", "b": "y"}', MarkOrder, "a mark has a, b"),
        ("{", FitOrder, "no JSON"),
        (b"\xff", FitOrder, "no JSON"),
    ],
)
def test_a_request_that_makes_no_sense_is_answered_by_what_it_should_be(body: str, kind: Any, said: str) -> None:
    with pytest.raises(Wrong, match=said):
        decode(body, kind)


@pytest.mark.parametrize(
    "text", ['{"type": "rm"}', "[1]", '{"type": "evaluate", "id": "x"}', '{"type": "visible"}', "{"]
)
def test_a_message_that_makes_no_sense_is_refused(text: str) -> None:
    with pytest.raises(Wrong):
        decode_page_message(text)


def test_references_have_to_be_there() -> None:
    check_known(["a", None], {"a": 1})
    with pytest.raises(Wrong, match="there is no reference 'b'"):
        check_known(["a", "b"], {"a": 1})


def test_query_strings() -> None:
    assert number(None, 2.0, 0.0, 3.0) == 2.0 and number("1", 2.0, 0.0, 3.0) == 1.0
    for text, said in (("x", "no number"), ("4", "between 0 and 3"), ("nan", "between 0 and 3")):
        with pytest.raises(Wrong, match=said):
            number(text, 2.0, 0.0, 3.0)
    with pytest.raises(Wrong, match="shape is one of a, b"):
        one_of("c", "shape", ("a", "b"))
