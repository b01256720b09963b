"""What small files paint, against areas that are made by shapely; y points down in both."""

import gzip

import numpy as np
import pytest
import shapely
from shapely import affinity

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.svg import read_svg

BAR = '<rect x="50" y="50" width="100" height="20"/>'
PAGE = '<rect width="200" height="200" {}/>'
ANGLE = shapely.box(20, 16, 184, 24).union(shapely.box(176, 16, 184, 100))


def file(content, attributes='viewBox="0 0 200 200"', head="") -> bytes:
    names = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    return f"{head}<svg {names} {attributes}>{content}</svg>".encode()


def ink(content, attributes='viewBox="0 0 200 200"', head=""):
    """The area, y down, and the notes."""
    drawing, notes = read_svg(file(content, attributes, head))
    return affinity.scale(drawing.geometry, 1, -1, origin=(0, 0)), notes


def disc(x, y, r):
    return shapely.Point(x, y).buffer(r, quad_segs=32)


def alike(one, other):
    return one.intersection(other).area / one.union(other).area


def shows(content, expected, **options):
    area, notes = ink(content, **options)
    assert notes == () and area.is_valid
    assert alike(area, expected) > 0.995


BAR_AREA = shapely.box(50, 50, 150, 70)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (
            '<rect x="40" y="56" width="12" height="110" transform="rotate(-20 46 56)"/>',
            affinity.rotate(shapely.box(40, 56, 52, 166), -20, origin=(46, 56)),
        ),
        (
            '<g transform="rotate(90 100 100)"><rect x="20" y="40" width="160" height="16"/></g>',
            affinity.rotate(shapely.box(20, 40, 180, 56), 90, origin=(100, 100)),
        ),
        (
            '<ellipse cx="100" cy="100" rx="80" ry="20" transform="rotate(30 100 100)"/>',
            affinity.rotate(affinity.scale(disc(100, 100, 1), 80, 20), 30, origin=(100, 100)),
        ),
        (
            '<circle cx="30" cy="150" r="20" transform="translate(75 0) skewX(-27)"/>',
            affinity.translate(affinity.skew(disc(30, 150, 20), xs=-27, origin=(0, 0)), 75, 0),
        ),
        (
            '<g transform="scale(-1 1) translate(-200)"><path d="M20 20h60v9h-60z"/></g>',
            shapely.box(120, 20, 180, 29),
        ),
        (
            '<rect x="20" y="20" width="60" height="40" style="transform:rotate(45deg);transform-origin:50px 40px"/>',
            affinity.rotate(shapely.box(20, 20, 80, 60), 45, origin=(50, 40)),
        ),
        ('<rect x="20" y="20" width="-10" height="160"/><rect height="160"/>' + BAR, BAR_AREA),
        ('<ellipse cx="100" cy="100" ry="60"/>', disc(100, 100, 60)),
        ('<rect x="20" y="20" width="80" height="60" rx="15"/>', shapely.box(35, 35, 85, 65).buffer(15, quad_segs=32)),
        ('<rect x="10%" y="10%" width="50%" height="2em" font-size="10"/>', shapely.box(20, 20, 120, 40)),
        ('<rect width="1in" height="72pt"/>', shapely.box(0, 0, 96, 96)),
        ('<path d="M 10 10 L 10 50 L 50 10 z L 100 100 L 150 100"/>', None),
    ],
)
def test_shapes_are_where_their_attributes_and_transforms_put_them(content, expected):
    if expected is None:
        triangles = [[(10, 10), (10, 50), (50, 10)], [(10, 10), (100, 100), (150, 100)]]
        expected = shapely.union_all([shapely.Polygon(triangle) for triangle in triangles])
    shows(content, expected)


@pytest.mark.parametrize(
    "content",
    [
        '<symbol id="s"><rect x="10" y="10" width="180" height="180"/></symbol>' + BAR,
        PAGE.format('fill="url(#gone) none"') + BAR,
        '<g opacity="0.6"><g opacity="0.6">' + PAGE.format("") + "</g></g>" + BAR,
        PAGE.format('opacity="20%"') + BAR,
        PAGE.format('fill-opacity=".4"') + BAR,
        PAGE.format('fill="#0003"') + BAR,
        PAGE.format('fill="rgba(0, 0, 0, 30%)"') + BAR,
        '<g fill="white">' + PAGE.format('fill="inherit"') + "</g>" + BAR,
        '<g color="white" fill="currentColor">' + PAGE.format("") + "</g>" + BAR,
        "<style>:root { --paper: #fff } rect.p { fill: var(--paper, black) }</style>" + PAGE.format('class="p"') + BAR,
        "<style>@import url(none)</style>".replace("@import url(none)", "") + BAR,
        '<g style="display:none">' + PAGE.format("") + "</g>" + BAR,
        '<g visibility="hidden">' + PAGE.format("") + BAR.replace("/>", ' visibility="visible"/>') + "</g>",
        '<path id="empty"/>' + BAR,
        '<g id="a" display="none"/><defs>' + PAGE.format("") + "</defs>" + BAR,
        '<switch><g systemLanguage="tlh">' + PAGE.format("") + "</g><g>" + BAR + "</g></switch>",
        '<linearGradient id="g"><stop stop-color="white"/><stop offset="1" stop-color="#ddd"/></linearGradient>'
        + PAGE.format('fill="url(#g)"')
        + BAR,
        '<linearGradient id="g"><stop stop-color="black"/></linearGradient>' + BAR.replace("/>", ' fill="url(#g)"/>'),
        '<rect x="40" y="40" width="120" height="60"/><path fill="#fff" fill-rule="evenodd" d="M0 0H200V200H0Z'
        'M50 50H150V70H50Z"/>',
    ],
)
def test_what_is_not_dark_is_not_drawn(content):
    shows(content, BAR_AREA)


@pytest.mark.parametrize(
    "content",
    [
        "<style>.line { fill: none !important; stroke: #000; stroke-width: 8 }</style>"
        '<path class="line" d="M20 20H180V100"/>',
        "<style>.line { fill: none !important; stroke: #000; stroke-width: 8 }</style>"
        '<path class="line" style="fill: black" d="M20 20H180V100"/>',
        "<style>@media print { path { fill: black } } path { fill: none; stroke: black; stroke-width: 8 }</style>"
        '<path d="M20 20H180V100"/>',
        "<style>@media screen { g > path#p { fill: none } } path { fill: red; stroke: black; stroke-width: 4% }</style>"
        '<g><path id="p" d="M20 20H180V100"/></g>',
        '<g fill="none" stroke="black" style="stroke-width: .8em; font-size: 10px"><path d="M20 20H180V100"/></g>',
        '<path style="fill:none;stroke:#000;stroke-width:8;stroke-linejoin:nonsense" d="M20 20H180V100"/>',
        '<svg viewBox="0 0 100 100"><path fill="none" stroke="black" stroke-width="4" d="M10 10H90V50"/></svg>',
        '<path fill="none" stroke="black" stroke-width="8" vector-effect="non-scaling-stroke" transform="scale(2 1)"'
        ' d="M10 20H90V100"/>',
    ],
)
def test_styles_cascade(content):
    shows(content, ANGLE)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (
            '<path d="M10 100H190" stroke="black" stroke-width="20" stroke-dasharray="20 20"/>',
            shapely.union_all([shapely.box(x, 90, x + 20, 110) for x in range(10, 190, 40)]),
        ),
        (
            '<path d="M10 100H190" stroke="black" stroke-width="20" stroke-dasharray="20" stroke-dashoffset="20"/>',
            shapely.union_all([shapely.box(x, 90, min(x + 20, 190), 110) for x in range(30, 190, 40)]),
        ),
        (
            '<path d="M10 100H190" pathLength="18" stroke="black" stroke-width="20" stroke-dasharray="2 7"/>',
            shapely.box(10, 90, 30, 110).union(shapely.box(100, 90, 120, 110)),
        ),
        (
            '<path d="M10 100H190" stroke="black" stroke-width="20" stroke-linecap="round" stroke-dasharray="0 60"/>',
            shapely.union_all([disc(x, 100, 10) for x in (10, 70, 130)]),
        ),
        (
            '<path d="M60 100h0M140 100h0" stroke="black" stroke-width="40" stroke-linecap="round"/>',
            disc(60, 100, 20).union(disc(140, 100, 20)),
        ),
        ('<path d="M60 100z" stroke="black" stroke-width="40" stroke-linecap="square"/>', shapely.box(40, 80, 80, 120)),
        (
            '<path fill="none" stroke="black" stroke-width="12" d="M60 60H140V140H60ZL20 20"/>',
            shapely.box(54, 54, 146, 146)
            .difference(shapely.box(66, 66, 134, 134))
            .union(shapely.LineString([(60, 60), (20, 20)]).buffer(6, cap_style="flat")),
        ),
        (
            '<g transform="scale(4 1)" stroke="#000" stroke-width="10"><path d="M10 20V180"/><path d="M10 40H45"/></g>',
            shapely.box(20, 20, 60, 180).union(shapely.box(40, 35, 180, 45)),
        ),
        ('<path d="M20 100H180" stroke="black" stroke-width="5%"/>', shapely.box(20, 95, 180, 105)),
        (
            '<path d="M40 140L100 40L160 140" fill="none" stroke="black" stroke-width="20" stroke-miterlimit="1"/>',
            shapely.LineString([(40, 140), (100, 40), (160, 140)]).buffer(10, cap_style="flat", join_style="bevel"),
        ),
        (
            '<path d="M40 140L100 40L160 140" fill="none" stroke="black" stroke-width="20"/>',
            shapely.LineString([(40, 140), (100, 40), (160, 140)]).buffer(
                10, cap_style="flat", join_style="mitre", mitre_limit=9
            ),
        ),
    ],
)
def test_strokes(content, expected):
    shows(content, expected)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (
            '<defs><clipPath id="c"><rect x="20" y="20" width="60" height="160"/></clipPath></defs>'
            '<rect x="10" y="50" width="180" height="60" clip-path="url(#c)"/>',
            shapely.box(20, 50, 80, 110),
        ),
        (
            '<clipPath id="c" clipPathUnits="objectBoundingBox"><circle cx=".5" cy=".5" r=".5"/></clipPath>'
            '<g clip-path="url(#c)"><rect x="50" y="50" width="100" height="100"/></g>',
            disc(100, 100, 50),
        ),
        (
            '<clipPath id="c" clip-path="url(#d)"><path id="p" d="M0 0H100V200H0Z"/></clipPath>'
            '<clipPath id="d"><use href="#q" x="50"/></clipPath><path id="q" display="none" d="M0 0z"/>'.replace(
                '<path id="q" display="none" d="M0 0z"/>', '<defs><path id="q" d="M0 0H150V200H0Z"/></defs>'
            )
            + '<rect x="20" y="50" width="160" height="20" clip-path="url(#c)"/>',
            shapely.box(50, 50, 100, 70),
        ),
        (
            '<defs><mask id="m"><rect x="20" y="20" width="60" height="160" fill="white"/></mask></defs>'
            '<rect x="10" y="50" width="180" height="60" mask="url(#m)"/>',
            shapely.box(20, 50, 80, 110),
        ),
        (
            '<mask id="m" mask-type="alpha"><path d="M60 0H80V200H60Z"/></mask>'
            '<rect x="10" y="50" width="180" height="60" mask="url(#m)"/>',
            shapely.box(60, 50, 80, 110),
        ),
        (
            '<linearGradient id="g"><stop stop-color="black"/><stop offset="1" stop-color="white"/></linearGradient>'
            '<rect x="20" y="20" width="100" height="40" fill="url(#g)"/>',
            shapely.box(20, 20, 70, 60),
        ),
        (
            '<radialGradient id="g" gradientUnits="userSpaceOnUse" cx="100" cy="100" r="80"><stop offset=".5"/>'
            '<stop offset=".5" stop-color="#fff"/></radialGradient><rect width="200" height="200" fill="url(#g)"/>',
            disc(100, 100, 40),
        ),
        (
            '<pattern id="p" width="40" height="40" patternUnits="userSpaceOnUse"><path d="M0 0H20V40H0z"/></pattern>'
            '<rect x="20" y="20" width="100" height="40" fill="url(#p)"/>',
            shapely.union_all([shapely.box(x, 20, x + 20, 60) for x in (40, 80)]),
        ),
        (
            '<marker id="a" viewBox="0 0 10 10" refX="10" refY="5" markerWidth="5" markerHeight="5" orient="auto">'
            '<path d="M0 0L10 5L0 10z"/></marker>'
            '<path d="M20 100H180" stroke="black" stroke-width="8" marker-end="url(#a)"/>',
            shapely.box(20, 96, 180, 104).union(shapely.Polygon([(140, 80), (180, 100), (140, 120)])),
        ),
        (
            '<defs><symbol id="s" viewBox="0 0 10 10"><path d="M0 0H10V10Z"/></symbol></defs>'
            '<use href="#s" x="50" y="50" width="100" height="100"/>',
            shapely.Polygon([(50, 50), (150, 50), (150, 150)]),
        ),
        (
            '<svg x="50" y="50" width="50" height="50"><circle r="50"/></svg>',
            disc(50, 50, 50).intersection(shapely.box(50, 50, 100, 100)),
        ),
        (
            '<path stroke="white" stroke-width="20" paint-order="stroke" d="M50 50H150V70H50Z"/>',
            shapely.box(50, 50, 150, 70),
        ),
        (
            '<path stroke="white" stroke-width="20" d="M50 50H150V150H50Z"/>',
            shapely.box(60, 60, 140, 140),
        ),
    ],
)
def test_what_is_referred_to(content, expected):
    shows(content, expected)


@pytest.mark.parametrize(
    ("content", "note"),
    [
        (
            '<text font-family="Nowhere">no</text>',
            "2 x letter of the font Nowhere, which is not on this machine, left out",
        ),
        ('<image href="data:image/png;base64,AA"/>', "1 x image left out"),
        ("<foreignObject/>", "1 x foreignObject left out"),
        ("<blink/>", "1 x <blink> left out"),
        ("<script>draw()</script>", "1 x script left out"),
        ('<use href="other.svg#a"/>', "1 x use of another file left out"),
        ('<g id="a"><path d="M0 0"/><use href="#a"/></g>', "1 x use that shows itself left out"),
        ('<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g>', "2 x use that shows itself left out"),
        ('<g filter="url(#f)"><rect width="9" height="9" opacity=".1"/></g>', "1 x filter left out"),
        ('<rect width="9" height="9" fill="#fff" style="mix-blend-mode:multiply"/>', "1 x blend mode left out"),
        ('<rect width="calc(1px + 2em)" height="9"/>', "1 x length that is not understood left out"),
        ('<path fill="none" d="M0 0H9Vx"/>', "1 x broken outline, drawn up to where it breaks"),
        ("<style>@import url(other.css);</style>", "1 x style sheet of another file left out"),
        (
            '<path transform="turn(3)" d="M0 0"/>',
            "1 x transform that is not understood left out",
        ),
        ('<g opacity="0"><animate attributeName="opacity"/></g>', "1 x animation left out"),
    ],
)
def test_one_odd_element_is_noted_and_the_rest_is_read(content, note):
    area, notes = ink(content + BAR)
    assert notes == (note,) and alike(area, BAR_AREA) > 0.999


def test_text_that_is_not_shown_is_not_noted():
    hidden = '<defs><text>a</text></defs><text display="none">b</text><g visibility="hidden"><text>c</text></g>'
    assert ink(hidden + BAR)[1] == ()


def test_only_the_page_counts():
    outside = '<rect x="150" y="50" width="500" height="20"/><rect y="900" width="9" height="9"/>'
    assert ink(outside)[0].bounds == pytest.approx((150, 50, 200, 70))
    assert ink(outside, 'width="160" height="100"')[0].bounds == pytest.approx((150, 50, 160, 70))
    assert ink(outside, "")[0].bounds == pytest.approx((0, 50, 650, 909))
    with pytest.raises(UnreadableError, match="outside"):
        ink('<rect x="300" width="9" height="9"/>')
    with pytest.raises(UnreadableError, match="no size"):
        ink(BAR, 'viewBox="0 0 200 200" width="0"')


def test_a_stretched_page_stretches_what_is_on_it():
    area, _ = ink(BAR, 'viewBox="0 0 200 200" width="400" height="200" preserveAspectRatio="none"')
    assert area.bounds == pytest.approx((100, 50, 300, 70))
    area, _ = ink(BAR, 'viewBox="0 0 200 200" width="40mm" height="20mm"')
    assert area.bounds == pytest.approx((50, 50, 150, 70))


@pytest.mark.parametrize(
    ("content", "attributes"),
    [
        (PAGE.format("") + BAR.replace("/>", ' fill="#eee"/>'), 'viewBox="0 0 200 200"'),
        (BAR.replace("/>", ' fill="white"/>'), 'viewBox="0 0 200 200" style="background: #111"'),
    ],
)
def test_light_on_a_dark_page_is_read_as_dark_on_light(content, attributes):
    area, notes = ink(content, attributes)
    assert notes == ("light on a dark page, read as dark on light",) and alike(area, BAR_AREA) > 0.999


def test_a_dark_frame_around_a_light_sheet_is_no_dark_page():
    sheet = '<rect x="5" y="5" width="190" height="190" fill="white"/>'
    area, notes = ink(PAGE.format("") + sheet + BAR)
    assert notes == () and area.area == pytest.approx(200**2 - 190**2 + 2000)


def test_a_broken_file_before_changes_nothing():
    with pytest.raises(UnreadableError):
        read_svg(b"<svg><rect")
    assert read_svg(file(f'<g inkscape:label="layer">{BAR}</g>'))[0].geometry.area == pytest.approx(2000)


def test_files_as_programs_write_them():
    illustrator = '<!DOCTYPE svg [<!ENTITY ns "http://www.w3.org/2000/svg"><!ENTITY dark "fill:#123;">]>'
    marked = BAR.replace("/>", ' style="&dark;"/>')
    assert ink(marked, head=illustrator)[0].area == pytest.approx(2000)
    undeclared = file(f'<g inkscape:label="layer">{BAR}</g>')
    assert read_svg(undeclared)[0].geometry.area == pytest.approx(2000)
    plain = f'\n<svg viewBox="0 0 200 200">{BAR}</svg>'.encode()
    for data in (plain, gzip.compress(plain), b"\xef\xbb\xbf" + plain.strip(), plain.decode().encode("utf-16")):
        assert read_svg(data)[0].geometry.area == pytest.approx(2000)


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"<svg><rect", "^broken: no XML"),
        (b"<html><svg/></html>", "outermost element is <html>"),
        (file('<text font-family="Nowhere">no</text>'), "nothing in it is dark.*2 x letter of the font Nowhere"),
        (file("<g/>"), "nothing in it is dark"),
    ],
)
def test_reasons(data, reason):
    with pytest.raises(UnreadableError, match=reason):
        read_svg(data)


class TestHostileFiles:
    def test_entities_that_grow_without_end(self):
        entities = "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 12))
        head = f'<!DOCTYPE svg [<!ENTITY e0 "{"x" * 100}">{entities}]>'
        with pytest.raises(UnreadableError, match="broken"):
            ink("<desc>&e11;</desc>" + BAR, head=head)

    def test_entities_of_other_files_are_not_read(self, tmp_path):
        (tmp_path / "secret.svg").write_text(PAGE.format(""))
        head = f'<!DOCTYPE svg [<!ENTITY e SYSTEM "file://{tmp_path}/secret.svg">]>'
        try:
            area, notes = ink("&e;" + BAR, head=head)
        except UnreadableError as error:
            assert "broken" in str(error)
        else:
            assert area.area == pytest.approx(2000) and notes

    def test_uses_of_uses(self):
        levels = "".join(f'<g id="u{i + 1}">{f"""<use href="#u{i}"/>""" * 10}</g>' for i in range(9))
        with pytest.raises(UnreadableError, match="uses of uses"):
            ink(f'<defs><rect id="u0" width="9" height="9"/>{levels}</defs><use href="#u9"/>')

    def test_elements_inside_one_another(self):
        area, notes = ink("<g>" * 150 + PAGE.format("") + "</g>" * 150 + BAR)
        assert alike(area, BAR_AREA) > 0.999 and "deep" in notes[0]

    def test_dashes_and_tiles_without_number(self):
        dashed = '<path d="M50 60H150" stroke="black" stroke-width="20" stroke-dasharray="1e-9"/>'
        assert alike(ink(dashed)[0], BAR_AREA) > 0.999
        tiny = '<pattern id="p" width="1e-6" height="1e-6" patternUnits="userSpaceOnUse"><path d="M0 0H1"/></pattern>'
        area, notes = ink(tiny + BAR.replace("/>", ' fill="url(#p)"/>'))
        assert alike(area, BAR_AREA) > 0.999 and "tiles" in notes[0]


class TestManyLines:
    def test_many_parts_of_one_path(self):
        places = np.random.default_rng(0).integers(0, 990, (1000, 2))
        area, notes = ink(f'<path d="{"".join(f"M{x} {y}h4v4h-4z" for x, y in places)}"/>', 'viewBox="0 0 1000 1000"')
        expected = shapely.union_all([shapely.box(x, y, x + 4, y + 4) for x, y in places])
        assert notes == () and alike(area, expected) > 0.999

    def test_a_scribble_is_read_as_a_picture(self):
        corners = np.random.default_rng(0).integers(0, 1000, (500, 2))
        line = " ".join(f"{x} {y}" for x, y in corners)
        area, notes = ink(f'<path fill="none" stroke="black" d="M{line}"/>', 'viewBox="0 0 1000 1000"')
        assert "picture of 1024" in notes[0] and area.is_valid
        assert 0.1e6 < area.area < 0.4e6


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_scale_at_the_end_of_what_numbers_hold_is_refused():
    page = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 64 64" width="64" height="64">'
    other = '<circle cx="30" cy="40" r="5" stroke="black" fill="none" stroke-dasharray="3 2"/>'
    svg = f'{page}<path d="M8 20h48v6h-48z"/><g transform="rotate(5 32 32) scale(.1e308)">{other}</g></svg>'
    with pytest.raises(UnreadableError, match="too large to measure"):
        read_svg(svg.encode())
