import io

import numpy as np
import pytest
import shapely
from PIL import Image

from benches import AREA as BENCH
from benches import bench, overlap
from shapewright.references import Collection
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.svg import read_svg
from shapewright.references.readers.svg.fonts import faces
from shapewright.shapes import Drawing
from shapewright.shapes.files import svg


def png(array, mode=None) -> bytes:
    buffer = io.BytesIO()
    Image.fromarray(np.asarray(array), mode).save(buffer, "PNG")
    return buffer.getvalue()


def document(content, attributes='viewBox="0 0 64 64" width="64" height="64"') -> bytes:
    return f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{content}</svg>'.encode()


TOP = '<rect x="8" y="20" width="48" height="6"/>'
LEGS = '<rect x="10" y="26" width="4" height="20"/><rect x="50" y="26" width="4" height="20"/>'


class TestSvg:
    @pytest.mark.parametrize(
        "content",
        [
            TOP + LEGS,
            f'<g transform="translate(4 4) scale(2)"><g transform="translate(-2 -2) scale(.5)">{TOP}{LEGS}</g></g>',
            f'{TOP}<polygon points="10,26 14,26 14,46 10,46"/><path d="M50 26h4v20h-4z"/>',
            f'{TOP}<g stroke="black" stroke-width="4"><line x1="12" y1="20" x2="12" y2="46"/>'
            '<polyline points="52,20 52,46" fill="none"/></g>',
            f'{TOP}<defs><rect id="leg" y="26" width="4" height="20"/></defs><use href="#leg" x="10"/>'
            '<use href="#leg" x="50"/>',
            '<style>.ink { fill: #123 }</style><path class="ink" d="M8 20H56V26H54V46H50V26H14V46H10V26H8Z"/>',
            '<rect x="8" y="20" width="48" height="26"/><rect x="8" y="26" width="2" height="20" fill="white"/>'
            '<rect x="14" y="26" width="36" height="20" fill="#fff"/><path d="M54 26h9v22h-9z" style="fill:white"/>',
            f'{TOP}{LEGS}<rect width="64" height="64" fill="none"/><rect width="64" height="64" opacity="0.2"/>'
            '<g display="none"><rect width="9" height="9"/></g>',
            f'<rect width="64" height="64" fill="#eee"/>{TOP}{LEGS}',
        ],
        ids=[
            "boxes",
            "transforms",
            "polygon and path",
            "strokes",
            "use",
            "style",
            "white cuts",
            "unseen",
            "background",
        ],
    )
    def test_what_is_painted_dark(self, content):
        drawing, notes = read_svg(document(content))
        assert notes == () and drawing.geometry.is_valid and overlap(drawing.geometry, BENCH) > 0.999

    def test_curves_and_fill_rules(self):
        disc, _ = read_svg(document('<circle cx="30" cy="30" r="20"/>'))
        assert overlap(disc.geometry, shapely.Point(30, -30).buffer(20.0, quad_segs=64)) > 0.995
        rings = "M0 0H30V30H0Z M10 10H20V20H10Z"
        for rule, area in (("nonzero", 900), ("evenodd", 800)):
            drawing, _ = read_svg(document(f'<path fill-rule="{rule}" d="{rings}"/>'))
            assert drawing.geometry.area == pytest.approx(area)
        opposed, _ = read_svg(document('<path d="M0 0H30V30H0Z M10 10V20H20V10Z"/>'))
        assert opposed.geometry.area == pytest.approx(800)
        star = '<path d="M30 0L48 55L1 21H59L12 55Z"/>'
        assert (
            read_svg(document(star))[0].geometry.area
            > read_svg(document(star.replace("<path", '<path fill-rule="evenodd"')))[0].geometry.area + 100
        )

    def test_round_ends_of_strokes(self):
        line = '<line x1="10" y1="30" x2="50" y2="30" stroke="black" stroke-width="6" stroke-linecap="{}"/>'
        areas = [read_svg(document(line.format(cap)))[0].geometry.area for cap in ("butt", "round", "square")]
        assert areas == pytest.approx([240, 240 + np.pi * 9, 276], rel=0.01)

    def test_text_without_a_font_is_left_out_with_a_note(self, monkeypatch):
        monkeypatch.setattr(faces, "machine_faces", lambda: ())
        note = "2 x letter of the font serif, which is not on this machine, left out"
        assert read_svg(document(TOP + "<text>no</text>"))[1] == (note,)

    @pytest.mark.parametrize("content", ["", '<rect width="9" height="9" fill="white"/>', "<text>no</text>"])
    def test_nothing_dark(self, monkeypatch, content):
        monkeypatch.setattr(faces, "machine_faces", lambda: ())
        with pytest.raises(UnreadableError, match="nothing in it is dark"):
            read_svg(document(content))

    def test_what_we_write_reads_back(self):
        shape = Drawing(
            shapely.union_all([BENCH, shapely.Point(30, 5).buffer(9).difference(shapely.box(28, 3, 32, 7))])
        )
        drawing, _ = read_svg(svg(shape))
        assert overlap(drawing.normalised().geometry, shape.normalised().geometry) > 1 - 1e-9


def test_a_folder_of_drawings_is_a_collection_and_broken_ones_are_skipped(tmp_path):
    (tmp_path / "a.png").write_bytes(png(bench()))
    (tmp_path / "b.svg").write_bytes(document(TOP + LEGS))
    (tmp_path / "broken.svg").write_bytes(b"<svg><rect")
    (tmp_path / "broken.png").write_bytes(png(bench())[:60])
    (tmp_path / "white.png").write_bytes(png(bench(black=255)))
    references = Collection.load(tmp_path)
    assert references.names == ("a", "b") and references.kind is Drawing
    assert {path.name: reason.split(":")[0] for path, reason in references.skipped.items()} == {
        "broken.png": "broken",
        "broken.svg": "broken",
        "white.png": "nothing in the picture is dark",
    }
    for reference in references:
        assert np.abs(reference.shape.bounds).max() == pytest.approx(0.5)
    assert overlap(references["a"].shape.geometry, references["b"].shape.geometry) > 0.99
