import numpy as np
import pytest

from collada_files import document, geometry, numbers, show
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import contents

SQUARE = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [1, 1, 0], [3, 1, 0], [3, 3, 0], [1, 3, 0]]
INPUT = '<input semantic="VERTEX" source="#v" offset="0"/>'


def read(tmp_path, primitives: str, vertices=SQUARE):
    path = tmp_path / "a.dae"
    path.write_bytes(document(f"<node>{show()}</node>", geometry("box", vertices, primitives)))
    return contents(path)


def reason(tmp_path, primitives: str, vertices=SQUARE) -> str:
    with pytest.raises(UnreadableError) as error:
        read(tmp_path, primitives, vertices)
    return str(error.value)


def area(found) -> float:
    """The area that faces up, less what faces down."""
    corners = found.shape.triangles
    return float(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2].sum() / 2)


@pytest.mark.parametrize(
    ("primitive", "faces"),
    [
        (f'<triangles count="2">{INPUT}<p>0 1 2 0 2 3</p></triangles>', 2),
        (f'<polylist count="2">{INPUT}<vcount>3 3</vcount><p>0 1 2 0 2 3</p></polylist>', 2),
        (f'<polygons count="1">{INPUT}<p>0 1 2 3</p></polygons>', 2),
        (f'<polygons count="2">{INPUT}<p>0 1 2</p><p>0 2 3</p></polygons>', 2),
        (f'<trifans count="1">{INPUT}<p>0 1 2 3</p></trifans>', 2),
        (f'<tristrips count="1">{INPUT}<p>0 1 3 2</p></tristrips>', 2),
        (f'<tristrips count="2">{INPUT}<p>0 1 3</p><p>1 2 3</p></tristrips>', 2),
    ],
)
def test_each_primitive_fills_the_square_and_faces_up(tmp_path, primitive, faces):
    found = read(tmp_path, primitive)
    assert (len(found.shape.faces), area(found), found.notes) == (faces, 16, ())


def test_corners_are_taken_at_the_offset_of_their_input(tmp_path):
    inputs = '<input semantic="NORMAL" source="#n" offset="0"/><input semantic="VERTEX" source="#v" offset="2"/>'
    assert area(read(tmp_path, f'<triangles count="1">{inputs}<p>7 7 0 7 7 1 7 7 2</p></triangles>')) == 8


@pytest.mark.parametrize("hole", ["4 5 6 7", "7 6 5 4"])
def test_a_hole_stays_open_whichever_way_it_turns(tmp_path, hole):
    found = read(tmp_path, f'<polygons count="1">{INPUT}<ph><p>0 1 2 3</p><h>{hole}</h></ph></polygons>')
    assert area(found) == 12


def test_a_concave_polygon_is_filled_and_no_more(tmp_path):
    primitive = f'<polylist count="1">{INPUT}<vcount>4</vcount><p>0 1 4 3</p></polylist>'
    assert area(read(tmp_path, primitive)) == 4


def test_lines_are_noted(tmp_path):
    lines = f'<lines count="1">{INPUT}<p>0 1</p></lines>'
    found = read(tmp_path, f'<triangles count="1">{INPUT}<p>0 1 2</p></triangles>{lines}')
    assert found.notes == ("1 x lines left out",)
    assert "1 x lines left out" in reason(tmp_path, lines)


@pytest.mark.parametrize(
    ("primitive", "said"),
    [
        (f'<triangles count="2">{INPUT}<p>0 1 2</p></triangles>', "need 6 corners or counts, but have 3"),
        (f'<polylist count="1">{INPUT}<vcount>4</vcount><p>0 1 2</p></polylist>', "need 4 corners"),
        (f'<triangles count="1">{INPUT}<p>0 1 99</p></triangles>', "outside its 8 vertices"),
        (f'<triangles count="1">{INPUT}<p>0 1 1.5</p></triangles>', "no whole number"),
        (f'<triangles count="1">{INPUT}<p>0 1 x</p></triangles>', "'x' is no number"),
        ('<triangles count="1"><p>0 1 2</p></triangles>', "without positions"),
    ],
)
def test_what_does_not_add_up_is_refused(tmp_path, primitive, said):
    assert said in reason(tmp_path, primitive)


def accessed(attributes: str, params: str, values) -> str:
    return (
        f'<geometry id="box"><mesh><source id="p"><float_array id="a" count="{len(values)}">{numbers(values)}'
        f'</float_array><technique_common><accessor source="#a" {attributes}>{params}</accessor></technique_common>'
        f'</source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>'
        f'<triangles count="1">{INPUT}<p>0 1 2</p></triangles></mesh></geometry>'
    )


def of(tmp_path, shape: str):
    path = tmp_path / "a.dae"
    path.write_bytes(document(f"<node>{show()}</node>", shape))
    return contents(path)


def test_an_accessor_has_an_offset_a_stride_and_parameters_without_name_that_are_passed_over(tmp_path):
    params = '<param name="X"/><param type="float"/><param name="Z"/><param name="Y"/>'
    rows = [9, 9, 1, 7, 3, 2, 2, 7, 3, 5, 4, 7, 4, 5]
    found = of(tmp_path, accessed('count="3" stride="4" offset="2"', params, rows))
    assert found.shape.vertices.tolist() == [[1, 2, 3], [2, 5, 3], [4, 5, 4]]


def test_numbers_that_are_missing_are_told(tmp_path):
    with pytest.raises(UnreadableError, match="goes beyond 8 numbers"):
        of(tmp_path, accessed('count="3" stride="3"', "", [0, 0, 0, 1, 0, 0, 1, 1]))


def test_decimals_with_commas_are_read_where_the_counts_say_so(tmp_path):
    shape = accessed('count="3" stride="3"', "", [0, 0, 0, 1.5, 0, 0, 1.5, 1.5, 0]).replace(".5", ",5")
    assert of(tmp_path, shape).shape.bounds.tolist() == [[0, 0, 0], [1.5, 1.5, 0]]


def test_a_stride_beyond_all_measure_is_refused_at_once(tmp_path):
    with pytest.raises(UnreadableError, match="goes beyond 9 numbers"):
        of(tmp_path, accessed('count="3" stride="99999999999"', "", range(9)))
