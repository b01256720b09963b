"""Every model of a folder, as our readers and a second one read it.

The environment variable SHAPEWRIGHT_PUBLIC_MODELS names the folder, for example with clones of
3MFConsortium/3mf-samples, KhronosGroup/glTF-Sample-Assets, KhronosGroup/glTF-Blender-IO and assimp/assimp.
"""

import os
from pathlib import Path

import pytest

from second_reader import difference, explained, ours, theirs

FOLDER = os.environ.get("SHAPEWRIGHT_PUBLIC_MODELS")
KINDS = (".3mf", ".glb", ".gltf")
LARGEST = 50_000_000  # bytes; more take minutes in the second reader
MODELS = sorted(path for path in Path(FOLDER).rglob("*") if path.suffix.lower() in KINDS) if FOLDER else []


@pytest.mark.skipif(not FOLDER, reason="SHAPEWRIGHT_PUBLIC_MODELS names no folder of public models")
@pytest.mark.parametrize("path", MODELS or [Path()], ids=str)
def test_a_model_is_read_as_a_second_reader_reads_it_or_the_difference_is_known(path):
    if path.stat().st_size > LARGEST:
        pytest.skip(f"larger than {LARGEST} bytes")
    mine = ours(path)
    told = difference(mine, theirs(path))
    assert told is None or explained(path, told), told


@pytest.mark.skipif(not FOLDER, reason="SHAPEWRIGHT_PUBLIC_MODELS names no folder of public models")
@pytest.mark.parametrize("path", MODELS or [Path()], ids=str)
def test_no_reason_is_in_the_words_of_a_parser(path):
    mine = ours(path)
    if isinstance(mine, str):
        assert not any(word in mine for word in ("Error:", "Exception:", "StopIteration", "Warning:")), mine
