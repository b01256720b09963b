import os
from pathlib import Path

import numpy as np
import pytest

import shapewright as sw
from shapewright.building import Workers
from shapewright.fitting.pacing import filing
from shapewright.fitting.pacing.opening import PROBES
from shapewright.fitting.pacing.stock import Stock
from shapewright.shapes import Drawing, shape_digest

SOURCE = """
import time
from pathlib import Path
from typing import Annotated, Literal
from shapewright import Infeasible, Range, procedure
from shapewright.modelling.solids import box
from sizes import DEPTH

@procedure
def part(
    width: Annotated[float, Range(1.0, 2.0)] = 1.5,
    kind: Literal["plain", "capped", "none"] = "plain",
):
    # a comment
    with (Path(__file__).parent / "built").open("a") as log:
        log.write("x")
    time.sleep(0.03)
    if kind == "none":
        raise Infeasible("no part")
    body = box((width, 1.0, DEPTH)).label("body")
    return body | box((0.5, 0.5, 0.5), at=(0, 0.7, 0)).label("cap") if kind == "capped" else body
"""


@pytest.fixture
def project(tmp_path):
    write(tmp_path)
    return tmp_path


def write(folder, change=lambda text: text, depth="0.5"):
    (folder / "part.py").write_text(change(SOURCE))
    (folder / "sizes.py").write_text(f"DEPTH = {depth}\n")


def run(folder, count=40, seed=0):
    """The builds of the samples of one run, how many shapes were built for them, and what was told."""
    part = sw.load_procedure(folder / "part.py")
    vectors = part.space.sample(count, seed=seed)
    log = folder / "built"
    log.write_text("")
    with Workers(part, 2) as crew:
        stock = Stock(crew, folder / "cache")
        stock.fresh(vectors[:PROBES])
        told = stock.hold(vectors, seed)
        builds = stock.build(vectors)
        stock.keep()
    assert [build.parameters for build in builds] == vectors
    return builds, len(log.read_text()), told


def contents(builds):
    return [
        (b.failure.message,)
        if b.shape is None
        else (shape_digest(b.shape), b.shape.labels, b.shape.faces.dtype, b.shape.label_names)
        for b in builds
    ]


def test_a_second_run_builds_the_first_samples_alone_and_gets_the_same_to_the_bit(project):
    first, built, told = run(project)
    assert built == 40 and told is None
    second, again, told = run(project)
    assert again == PROBES and told.text == f"{40 - PROBES} samples of an earlier run are used again"
    assert contents(second) == contents(first)
    assert {b.failure.kind for b in second if b.failure} == {"infeasible"}


@pytest.mark.parametrize("change", [lambda text: text.replace("# a comment", "# another one\n\n"), lambda text: text])
def test_comments_and_layout_change_nothing(project, change):
    run(project)
    write(project, change)
    assert run(project)[1] == PROBES


def test_an_edit_that_changes_no_shape_keeps_them_after_a_look_at_every_class(project):
    run(project, 60)
    write(project, lambda text: text.replace("body = box", "size = 1.0\n    body = box"))
    _, built, told = run(project, 60)
    assert built == PROBES + 16 and told is not None


def test_what_the_author_saves_during_a_run_is_not_the_text_that_its_samples_are_of(project):
    part = sw.load_procedure(project / "part.py")
    vectors = part.space.sample(40, seed=0)
    with Workers(part, 2) as crew:
        stock = Stock(crew, project / "cache")
        stock.fresh(vectors[:PROBES])
        stock.build(vectors)
        write(project, lambda text: text.replace("body = box", "size = 1.0\n    body = box"))
        stock.keep()
    assert run(project)[1] > PROBES


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace("(width, 1.0, DEPTH)", "(width, 1.1, DEPTH)"),
        lambda text: text.replace("(0.5, 0.5, 0.5)", "(0.5, 0.5, 0.50001)"),
        lambda text: text.replace('.label("cap")', '.label("lid")'),
        lambda text: text.replace('Infeasible("no part")', "ValueError(3)"),
        lambda text: text.replace('if kind == "none"', 'if kind == "never"'),
    ],
)
def test_an_edit_that_changes_shapes_of_one_class_builds_all_anew(project, change):
    run(project)
    write(project, change)
    builds, built, told = run(project)
    assert built == 40 and told is None
    assert contents(builds) == contents(run(project, 40)[0])


def test_a_helper_and_a_file_that_is_read_count_as_well(project):
    run(project)
    write(project, depth="0.6")
    builds, built, _ = run(project)
    assert built == 40 and min(np.ptp(b.shape.bounds, axis=0).min() for b in builds if b.shape) == pytest.approx(0.6)
    (project / "h").write_text("1.0")
    from_file = "(width, float(Path(__file__).with_name('h').read_text()), 1)"
    write(project, lambda text: text.replace("(width, 1.0, DEPTH)", from_file))
    run(project)
    (project / "h").write_text("1.25")
    assert run(project)[1] == 40


def test_another_seed_uses_what_is_asked_again_alone(project):
    run(project)
    assert run(project, seed=1)[1] == 40
    assert run(project)[1] == PROBES, "the samples of both seeds are kept"


def test_a_quick_procedure_and_one_that_is_not_steady_keep_nothing(project):
    write(project, lambda text: text.replace("time.sleep(0.03)", ""))
    run(project)
    assert not (project / "cache").exists()
    part = sw.load_procedure(project / "part.py")
    with Workers(part, 1) as crew:
        stock = Stock(crew, project / "cache")
        stock.forget()
        stock.build(part.space.sample(3))
        stock.keep()
    assert not (project / "cache").exists()


def test_a_damaged_file_counts_as_none(project):
    run(project)
    (file,) = (project / "cache" / "samples").iterdir()
    file.write_bytes(file.read_bytes()[:-200])
    assert run(project)[1] == 40


def test_drawings_and_colours_come_back_to_the_bit(tmp_path):
    import shapely

    from shapewright.building import Build
    from shapewright.shapes import Mesh

    mesh = Mesh(
        np.random.default_rng(0).random((3, 3)),
        np.array([[0, 1, 2]]),
        np.array([0]),
        ("leg",),
        np.array([-1]),
        ("rule",),
        np.array([[1, 2, 3, 255]], np.uint8),
    )
    drawing = Drawing(shapely.box(0, 0, 1, 1 / 3))
    file = tmp_path / "builds.npz"
    filing.write(file, "digest", [Build({"a": 0.1, "b": None, "c": True}, mesh, None, 1.5), Build({"a": 1}, drawing)])
    digest, (one, other) = filing.read(file)
    assert digest == "digest" and one.parameters == {"a": 0.1, "b": None, "c": True} and one.seconds == 1.5
    for name, value in vars(mesh).items():
        assert np.array_equal(getattr(one.shape, name), value), name
    assert other.shape.geometry.wkb == drawing.geometry.wkb


def test_what_was_used_longest_ago_goes_where_files_grow_too_large(tmp_path, monkeypatch):
    for age, name in enumerate(("new", "middle", "old")):
        path = tmp_path / f"{name}.npz"
        path.write_bytes(b"x" * 100)
        os.utime(path, (1e9 - age, 1e9 - age))
    monkeypatch.setattr(filing, "MOST_BYTES", 250)
    filing.tidy(tmp_path)
    assert {path.name for path in Path(tmp_path).iterdir()} == {"new.npz", "middle.npz"}
