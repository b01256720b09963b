import numpy as np
import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.threemf.number_blocks import cut

AXES = (b"x", b"y", b"z")
CORNERS = (b"v1", b"v2", b"v3")


def vertices(*elements: str, prefix: str = "") -> list:
    text = f"<{prefix}model><{prefix}vertices>{''.join(elements)}</{prefix}vertices></{prefix}model>".encode()
    return cut(text).rows(0, b"vertex", AXES).tolist()


def triangles(*elements: str) -> list:
    return (
        cut(f"<model><triangles>{''.join(elements)}</triangles></model>".encode())
        .rows(0, b"triangle", CORNERS)
        .tolist()
    )


def reason(call, *elements: str) -> str:
    with pytest.raises(UnreadableError) as error:
        call(*elements)
    return str(error.value)


@pytest.mark.parametrize(
    "element",
    [
        '<vertex x="1" y="-2.5" z="3e2"/>',
        '<vertex x="1" y="-2.5" z="3e2" />\n',
        '<vertex  x = "1"\n y="-2.5"\tz=" +3E+2 "></vertex>',
        "<vertex x='1' y='-2.5' z='3e2'/>",
        '<vertex z="3e2" x="1" y="-2.5"/>',
        '<vertex x="1" y="-2.5" z="3e2" q:colour="7" p="a"/>',
        '<vertex max="9" x="1" y="-2.5" xy="8" z="3e2"/>',
    ],
)
def test_vertices_are_read_however_they_are_written(element):
    assert vertices(element) == [[1, -2.5, 300]]
    assert vertices(element, '<vertex x="4" y="5" z="6"/>') == [[1, -2.5, 300], [4, 5, 6]]


@pytest.mark.parametrize(
    "element",
    [
        '<triangle v1="10" v2="2" v3="33"/>',
        '<triangle v2="2" v1="10" v3="33"/>',
        '<triangle v1="10" v2="2" v3="33" pid="5" p1="0" p2="1" p3="2"/>',
        '<triangle v1="10" v2="2" v3="33" slic3rpe:mmu_segmentation="4"/>',
        "<triangle v3='33' v1='10' v2='2'/>",
    ],
)
def test_triangles_are_read_however_they_are_written(element):
    assert triangles(element) == [[10, 2, 33]]
    assert triangles(element, '<triangle v1="1" v2="2" v3="3"/>') == [[10, 2, 33], [1, 2, 3]]


def test_a_prefix_and_other_elements_between_are_no_obstacle():
    element = '<k:vertex x="1" y="2" z="3"/><x:note x="9"/>'
    assert vertices(element, element, prefix="k:") == [[1, 2, 3], [1, 2, 3]]


def test_many_elements_are_read_in_pieces():
    count = 150_000
    found = triangles(*(f'<triangle v1="{i}" v2="{i + 1}" v3="{i + 2}"/>' for i in range(count)))
    np.testing.assert_array_equal(np.array(found)[:, 0], np.arange(count))


def test_numbers_that_are_not_finite_are_numbers():
    assert np.isnan(vertices('<vertex x="nan" y="1" z="2"/>')[0][0])


@pytest.mark.parametrize(
    ("elements", "why"),
    [
        (['<vertex x="1" y="2"/>'], "has no z"),
        (['<vertex x="1" y="2" z="3"/>', '<vertex x="1" z="3"/>'], '\'<vertex x="1" z="3"/\' has no y'),
        (['<vertex x="1" y="" z="3"/>'], "vertex with an empty y"),
        (['<vertex x="1 2" y="" z="3"/>'], "vertex with an empty y"),
        (['<vertex x="1 2" y="3" z="4"/>'], "vertex with two numbers in one attribute"),
        (['<vertex x="1,5" y="2" z="3"/>'], "'1,5' is no number; decimals need a point"),
        (['<vertex x="1-2" y="2" z="3"/>'], "'1-2' is no number"),
        (['<vertex x="a" y="2" z="3"/>'], "'a' is no number"),
        (['<vertex x="1" y="2" z="3" x="4"/>'], "has no x"),
    ],
)
def test_what_is_broken_is_refused_with_its_element(elements, why):
    assert why in reason(vertices, *elements)


def test_the_content_of_blocks_is_out_of_the_outline():
    text = b'<m><!-- <vertices> --><vertices><vertex x="1"/></vertices><triangles/><vertices a="2"/></m>'
    found = cut(b'<?xml version="1.0"?>' + text)
    assert found.outline == b'<m><vertices block="0"/><triangles block="1"/><vertices block="2"/></m>'
    assert [found.text[start:stop] for start, stop in found.blocks] == [b'<vertex x="1"/>', b"", b""]


@pytest.mark.parametrize("text", [b"<m><vertices><vertex/>", b"<m><!-- <vertices>", b"<m><![CDATA[", b"<?xml"])
def test_what_does_not_end_is_refused(text):
    assert "cut short" in reason(cut, text)


def test_what_could_take_a_pattern_forever_is_read_at_once():
    assert "cut short" in reason(cut, b"<m>" + b"<!--" * 1_000_000)
    assert "cut short" in reason(cut, b"<m>" + b"<vertices>" * 500_000)
    assert cut(b"<m>" + b"<vertices " * 500_000).blocks == []
