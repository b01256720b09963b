import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.threemf.markup import outline


def reason(text: bytes) -> str:
    with pytest.raises(UnreadableError) as error:
        outline(text)
    return str(error.value)


def test_elements_come_in_order_with_their_depths_and_namespaces():
    found = outline(b'<a xmlns="u" xmlns:q="v"><q:b c="1"/><d q:c="2" e="3"><f/></d></a>')
    assert [(each.depth, each.space, each.name) for each in found] == [
        (0, "u", "a"),
        (1, "v", "b"),
        (1, "u", "d"),
        (2, "u", "f"),
    ]
    assert found[2].attributes == {"c": "2", "e": "3"}
    assert found[0].prefixes["q"] == "v"


def test_what_is_below_an_element_of_another_namespace_is_left_out():
    found = outline(b'<a xmlns="u"><x xmlns="v"><a/><y><z/></y></x><b/></a>')
    assert [each.name for each in found] == ["a", "x", "b"]


def test_a_prefix_may_stand_for_the_namespace_of_the_root():
    found = outline(b'<k:a xmlns:k="u"><k:b/><b/></k:a>')
    assert [(each.space, each.name) for each in found] == [("u", "a"), ("u", "b"), ("", "b")]


def test_a_prefix_that_is_not_declared_is_another_namespace():
    found = outline(b'<a xmlns="u"><ms:b/><ms:c ms:d="1"/></a>')
    assert [(each.space, each.name) for each in found] == [("u", "a"), ("ms:", "b"), ("ms:", "c")]


def test_an_attribute_without_prefix_wins_over_one_with_it():
    assert outline(b'<a q:id="1" id="2"/>')[0].attributes["id"] == "2"
    assert outline(b'<a id="2" q:id="1"/>')[0].attributes["id"] == "2"


@pytest.mark.parametrize(
    "text",
    [
        b'<!DOCTYPE a [<!ENTITY x "y">]><a>&x;</a>',
        b"<!DOCTYPE a><a/>",
        b'<?xml version="1.0"?><!DOCTYPE a SYSTEM "file:///etc/passwd"><a/>',
        b'<!DOCTYPE a [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;">]><a b="&b;"/>',
    ],
)
def test_document_type_definitions_are_refused(text):
    assert "document type definition" in reason(text)


@pytest.mark.parametrize(
    "text", [b"", b"<a>", b"<a></b>", b"<a/><b/>", b"<a b='1' b='2'/>", b"<a>&x;</a>", b"\xff<a/>"]
)
def test_what_is_not_well_formed_is_refused(text):
    assert "not well-formed" in reason(text)


def test_more_elements_than_any_model_has_are_refused():
    assert "more than 200,000 elements" in reason(b"<a>" + b"<b/>" * 200_001 + b"</a>")


def test_deep_nesting_is_read():
    assert len(outline(b"<a>" * 10_000 + b"</a>" * 10_000)) == 10_000
