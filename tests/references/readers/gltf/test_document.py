import json

import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.gltf.document import parse


def document(**more) -> bytes:
    return json.dumps({"asset": {"version": "2.0"}, **more}).encode()


def reason(text: bytes) -> str:
    with pytest.raises(UnreadableError) as error:
        parse(text)
    return str(error.value)


def test_what_is_not_about_triangles_may_be_anything():
    text = document(materials=3, images=[None], nodes=[{"name": 4, "extras": [[]], "camera": "x"}], animations={})
    found, notes = parse(text)
    assert len(found.nodes) == 1
    assert notes == ()


def test_whole_numbers_may_be_written_with_a_point():
    found, _ = parse(document(scene=1.0, scenes=[{"nodes": [2e0]}]))
    assert (found.scene, found.scenes[0].nodes) == (1, [2])


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (b"{", "broken: Input data was truncated"),
        (b"{}", "a JSON text without 'asset'"),
        (b'{"asset": {}}', "missing required field `version`"),
        (document(nodes=[{"mesh": -1}]), "`int` >= 0 - at `$.nodes[0].mesh`"),
        (document(nodes=[{"matrix": [1, 2]}]), "length >= 16 - at `$.nodes[0].matrix`"),
        (document(accessors=[{"type": "VEC3", "count": 10**30, "componentType": 5126}]), "$.accessors[0].count"),
        (document(meshes=[{"primitives": {}}]), "Expected `array`, got `object`"),
        (b'{"asset": {"version": "2.0"}, "scene": NaN}', "malformed"),
        (b'{"asset": {"version": "2.0"}, "nodes": ' + b"[" * 100_000, "broken"),
        (b'{"asset": {"version": "2.0"}, "extras": ' + b"[" * 100_000, "broken"),
    ],
)
def test_what_is_broken_is_refused_with_its_place(text, why):
    assert why in reason(text)


@pytest.mark.parametrize("asset", [{"version": "1.0"}, {"version": 1.0}, {"version": "2.1", "minVersion": "2.1"}])
def test_other_versions_are_refused_by_name(asset):
    assert "which is not read; save it as glTF 2.0" in reason(document(asset=asset))


def test_a_newer_file_that_version_2_0_can_read_is_read():
    assert parse(document(asset={"version": "2.1", "minVersion": "2.0"}))[1] == ()


def test_extensions_that_are_needed_and_not_known_are_refused_by_name():
    text = document(extensionsRequired=["KHR_materials_unlit", "EXT_bent_space", "KHR_mesh_quantization"])
    assert reason(text) == "it needs the extension EXT_bent_space, which is not known; save it without"


def test_extensions_that_are_used_and_not_known_are_noted():
    _, notes = parse(document(extensionsUsed=["KHR_texture_basisu", "EXT_bent_space", "EXT_mesh_gpu_instancing"]))
    assert notes == ("extension EXT_bent_space passed over: it is not known",)
