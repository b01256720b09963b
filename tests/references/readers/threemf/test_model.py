import numpy as np
import pytest

from gltf_files import CUBE, CUBE_FACES
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.threemf.model import read_model
from threemf_files import BEAMS, CORE, SLICES, components, mesh, model, moved, object_

MANUFACTURING = "http://schemas.3mf.io/3dmanufacturing/"


def reason(text: str | bytes) -> str:
    with pytest.raises(UnreadableError) as error:
        read_model(text if isinstance(text, bytes) else text.encode())
    return str(error.value)


def test_objects_items_and_the_unit():
    xml = model(
        object_(1, mesh()) + object_(2, components('objectid="1"', f'objectid="1" p:path="/x.model" {moved(5, 6, 7)}')),
        'objectid="2"',
        'objectid="1" transform="1 2 3 4 5 6 7 8 9 10 11 12"',
        attributes='unit="inch"',
    )
    found = read_model(xml.encode())
    assert found.unit == 25.4
    np.testing.assert_array_equal(found.objects[1].vertices[found.objects[1].faces], CUBE[CUBE_FACES])
    first, second = found.objects[2].parts
    assert (first.number, first.path, first.matrix.tolist()) == (1, None, np.eye(4).tolist())
    assert (second.path, second.matrix[:3, 3].tolist()) == ("/x.model", [5, 6, 7])
    assert found.items[1].matrix.tolist() == [[1, 4, 7, 10], [2, 5, 8, 11], [3, 6, 9, 12], [0, 0, 0, 1]]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "latin-1"])
def test_every_encoding_that_xml_may_have(encoding):
    xml = model(object_(1, mesh(), 'name="Stühlchen"'), 'objectid="1"').replace("UTF-8", encoding[:6].upper())
    assert len(read_model(xml.encode(encoding)).objects[1].faces) == 12


@pytest.mark.parametrize(
    "space", [f'xmlns:k="{CORE}"', 'xmlns:k="http://schemas.microsoft.com/3dmanufacturing/2013/01"']
)
def test_the_namespace_may_have_a_prefix_and_be_that_of_the_draft(space):
    xml = f'<k:model {space}><k:resources><k:object id="1">{mesh()}</k:object></k:resources><k:build/></k:model>'
    for name in ("mesh", "vertices", "vertex", "triangles", "triangle"):
        xml = (
            xml.replace(f"<{name} ", f"<k:{name} ")
            .replace(f"<{name}>", f"<k:{name}>")
            .replace(f"</{name}>", f"</k:{name}>")
        )
    assert len(read_model(xml.encode()).objects[1].faces) == 12


def test_vertices_of_slices_are_not_those_of_the_mesh():
    stack = f'<slicestack xmlns="{SLICES}"><vertices><vertex x="1" y="2"/></vertices></slicestack>'
    found = read_model(model(stack + object_(1, mesh()) + stack, 'objectid="1"').encode())
    assert len(found.objects[1].vertices) == 8


def test_numbers_may_have_zeros_before_them():
    assert list(read_model(model(object_("007", mesh()), 'objectid="7"').encode()).objects) == [7]


def test_other_forms_of_an_object_are_told():
    lattice = f'<b:beamlattice xmlns:b="{BEAMS}"><b:beams><b:beam v1="0" v2="1"/></b:beams></b:beamlattice>'
    found = read_model(
        model(
            object_(1, mesh(more=lattice))
            + object_(2, mesh(), f'xmlns:s="{SLICES}" s:meshresolution="lowres"')
            + object_(3, '<x:levelset xmlns:x="http://example.org/implicit"><x:mesh/></x:levelset>')
        ).encode()
    ).objects
    assert [each.has_beams for each in found.values()] == [True, False, False]
    assert [each.is_sketch for each in found.values()] == [False, True, False]
    assert found[3].others == ("<levelset> of http://example.org/implicit",)


@pytest.mark.parametrize("space", [BEAMS, SLICES, "http://schemas.microsoft.com/3dmanufacturing/material/2015/02"])
def test_extensions_that_are_needed_and_known_are_no_obstacle(space):
    xml = model(object_(1, mesh()), attributes=f'xmlns:q="{space}" requiredextensions="q p"')
    assert len(read_model(xml.encode()).objects) == 1


@pytest.mark.parametrize(
    ("attributes", "name"),
    [
        (
            'xmlns:bo="http://schemas.3mf.io/3dmanufacturing/booleanoperations/2023/07" requiredextensions="p bo"',
            "booleanop",
        ),
        ('xmlns:d="http://schemas.3mf.io/3dmanufacturing/displacement/2023/10" requiredextensions="d"', "displacement"),
        ('requiredextensions="nowhere"', "nowhere"),
    ],
)
def test_extensions_that_are_needed_and_not_known_are_refused_by_name(attributes, name):
    why = reason(model(object_(1, mesh()), attributes=attributes))
    assert why.startswith("it needs the extension")
    assert name in why


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (b"%3McF\0\0", "it is encrypted"),
        ("<svg/>", "begins with <svg"),
        ('<model xmlns="http://example.org/other"/>', "begins with <model"),
        (model("", attributes='unit="parsec"'), "'parsec', which is no unit"),
        (model(object_(1, mesh()) + object_(1, mesh())), "two objects have the id 1"),
        (model(object_("x", mesh())), "<object> has id='x'"),
        (model(object_("1_0", mesh())), "<object> has id='1_0'"),
        (model(object_("9" * 30, mesh())), "which is no number"),
        (model("", 'transform="1 0 0"'), "3 numbers, not 12"),
        (model("", 'objectid="1" transform="a"'), "'a' is no number"),
        (model("", ""), "<item> has objectid=''"),
        (model(object_(1, mesh(faces=[[0, 1, 8]]))), "point outside its 8 vertices"),
        (model(object_(1, mesh(faces=[[0, 1, -1]]))), "point outside its 8 vertices"),
        (model(object_(1, mesh(faces=[[0, 1, 1.5]]))), "no whole numbers"),
        (model(object_(1, mesh(faces=[[0, 1, float("nan")]]))), "no whole numbers"),
        (model(object_(1, mesh())).replace("<model", "<!DOCTYPE model><model"), "document type definition"),
    ],
)
def test_what_is_broken_is_refused(text, why):
    assert why in reason(text)
