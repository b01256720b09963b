"""The first procedures of `shapewright new --kind` with the real libraries."""

import subprocess
import sys

import pytest

from shapewright import load_procedure
from shapewright.building import Workers
from shapewright.cli.projects import NEEDED, starter


@pytest.mark.parametrize("kind", list(NEEDED))
def test_a_first_procedure_builds_sound_shapes(kind):
    pytest.importorskip(NEEDED[kind], reason="needs the extras; run `make test-adapters`")
    first = load_procedure(starter(kind))
    with Workers(first, 2) as crew:
        builds = crew.build(first.space.sample(20, seed=0))
    assert all(build.shape for build in builds), [str(build.failure) for build in builds if build.failure]
    assert all(build.shape.soundness().closed for build in builds)
    assert first.facts.up == "z"


@pytest.mark.parametrize("kind", list(NEEDED))
def test_the_command_writes_samples_of_it(kind, tmp_path):
    pytest.importorskip(NEEDED[kind], reason="needs the extras; run `make test-adapters`")
    command = [sys.executable, "-m", "shapewright"]
    subprocess.run([*command, "new", "parts", "--kind", kind], cwd=tmp_path, check=True, timeout=120)
    page = next((tmp_path / "parts").glob("procedure.*")).name
    sampled = subprocess.run(
        [*command, "sample", page, "-n", "3", "--out", "out"],
        cwd=tmp_path / "parts",
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert sampled.returncode == 0, sampled.stderr
    assert len(list((tmp_path / "parts" / "out").glob("*.glb"))) == 3
