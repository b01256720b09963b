"""Every COLLADA and FBX of a folder, as our readers and as pycollada and ufbx read it.

The environment variable SHAPEWRIGHT_PUBLIC_MODELS names the folder, for example with clones of assimp/assimp,
ufbx/ufbx, pycollada/pycollada and mikedh/trimesh.
"""

import os
from pathlib import Path

import pytest

from scene_readers import ours, unexplained

NEEDS = {".dae": "collada", ".zae": "collada", ".fbx": "ufbx"}
LARGEST = 50_000_000  # bytes
FOLDER = os.environ.get("SHAPEWRIGHT_PUBLIC_MODELS")
FUZZED = "fuzz"
"""The folder of ufbx with mutated files: they are to be read or refused, and there is nothing to compare with."""
FOUND = sorted(path for path in Path(FOLDER).rglob("*") if path.suffix.lower() in NEEDS) if FOLDER else []


@pytest.mark.skipif(not FOLDER, reason="SHAPEWRIGHT_PUBLIC_MODELS names no folder of public models")
@pytest.mark.parametrize("path", FOUND or [Path()], ids=str)
def test_a_scene_is_read_as_a_second_reader_reads_it_or_the_difference_is_known(path):
    library = NEEDS[path.suffix.lower()]
    pytest.importorskip(library, reason=f"compares with {library}, which is not installed")
    if path.stat().st_size > LARGEST or FUZZED in path.parts:
        pytest.skip("too large, or mutated")
    assert (told := unexplained(path)) is None, told


@pytest.mark.skipif(not FOLDER, reason="SHAPEWRIGHT_PUBLIC_MODELS names no folder of public models")
@pytest.mark.parametrize("path", FOUND or [Path()], ids=str)
def test_no_reason_is_in_the_words_of_a_parser(path):
    mine = ours(path)
    if isinstance(mine, str):
        assert not any(word in mine for word in ("Error:", "Exception:", "StopIteration", "Warning:")), mine
