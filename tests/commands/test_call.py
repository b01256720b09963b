"""Functions of libraries as procedures, called as they are, here and in another Python."""

import os
import sys
import venv

import pytest

import shapewright as sw
from shapewright.building import Limits, Workers
from shapewright.procedures import Infeasible, ProcedureError

TOOL = """\
import os, sys, time
print("hello from the library")
class Wedge:
    def __init__(self, width=1.0, height=1.0, corners=((0, 0, 0),), lid=False):
        print("built")
        if height > 8.0:
            time.sleep(60)
        if height > 7.0:
            os._exit(3)
        if height > 6.0:
            raise ValueError("too high")
        self.vertices = [*corners, (width, 0, 0), (0, height, 0), (0, 0, 1)]
        self.faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
class Shop:
    wedge = staticmethod(Wedge)
"""
SPEC = """\
call = "wedges:Wedge"
up = "z"
[parameters]
width = { range = [1, 4], default = 2 }
height = { range = [1, 9], default = 2 }
corners = { fixed = [[0, 0, -1]] }
"""


def written(folder, spec=SPEC, head=""):
    (folder / "wedges.py").write_text(TOOL)
    (folder / "spec.toml").write_text(head + spec)
    return folder / "spec.toml"


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "path", list(sys.path))
    yield tmp_path
    sys.modules.pop("wedges", None)


def test_a_class_is_called_with_what_stands_beside_it(here):
    made = sw.load_procedure(written(here))
    assert made.space.names == ("width", "height") and made.helpers == (here / "wedges.py",)
    assert made(width=3.0).extent.tolist() == [3.0, 2.0, 2.0]  # Y up
    inner = sw.load_procedure(written(here, SPEC.replace("wedges:Wedge", "wedges:Shop.wedge")))
    assert inner(width=4.0).extent[0] == 4.0


def test_what_it_does_not_take_is_told_with_its_line(here):
    with pytest.raises(
        ProcedureError, match=r"spec.toml:4: parameters.breadth: .* it takes width, height, corners, lid"
    ):
        sw.load_procedure(written(here, SPEC.replace("width", "breadth")))


def test_what_it_needs_and_does_not_get_is_told(here):
    path = written(here, SPEC.replace("wedges:Wedge", "wedges:edge"))
    (here / "wedges.py").write_text("def edge(width, height, corners, depth): ...\n")
    with pytest.raises(ProcedureError, match=r"spec.toml:1: .*missing a required argument: 'depth'; say its range"):
        sw.load_procedure(path)


@pytest.mark.parametrize(
    ("target", "says"),
    [
        ("no_such_library.shapes:Box", "there is no module no_such_library here; install it with: pip install"),
        ("wedges:Box", "AttributeError: module 'wedges' has no attribute 'Box'"),
    ],
)
def test_what_is_not_there_is_told_when_it_is_loaded(here, target, says):
    with pytest.raises(ProcedureError, match=r"spec.toml:1: ") as error:
        sw.load_procedure(written(here, SPEC.replace("wedges:Wedge", target)))
    assert says in str(error.value)


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    """Another Python, which has no library at all."""
    folder = tmp_path_factory.mktemp("elsewhere")
    venv.create(folder, with_pip=False)
    return folder / "bin" / "python"


@pytest.mark.skipif(os.name != "posix", reason="the folders of environments are those of POSIX")
def test_another_python_builds_and_is_kept(tmp_path, python):
    made = sw.load_procedure(written(tmp_path, head=f'python = "{python}"\nconstraints = ["width < 3.5"]\n'))
    assert made(width=3.0).extent.tolist() == [3.0, 2.0, 2.0]
    assert made(width=2.5).extent[0] == 2.5
    with pytest.raises(ProcedureError, match=r"ValueError: too high \(.*wedges.py:11\)"):
        made(height=6.5)
    with pytest.raises(ProcedureError, match=r"its Python ended while it built \(exit status 3\)"):
        made(height=7.5)
    assert made(width=3.0).extent[0] == 3.0
    with pytest.raises(Infeasible):
        made(width=3.9)
    with pytest.raises(ProcedureError, match="ModuleNotFoundError: No module named 'shapes'"):
        sw.load_procedure(written(tmp_path, SPEC.replace("wedges:", "shapes:"), f'python = "{python}"\n'))()
    with pytest.raises(ProcedureError, match=r"'infinigen2'.*infinigen/bin/pip install infinigen==2.0.0a3"):
        sw.load_procedure(
            written(tmp_path, SPEC.replace("wedges:", "infinigen2.objects.vase:"), f'python = "{python}"\n')
        )()
    with pytest.raises(ProcedureError, match="cannot be started: No such file"):
        sw.load_procedure(written(tmp_path, head='python = "/no/python"\n'))()


@pytest.mark.skipif(os.name != "posix", reason="the folders of environments are those of POSIX")
def test_a_call_elsewhere_that_takes_too_long_costs_its_shape_alone(tmp_path, python):
    made = sw.load_procedure(written(tmp_path, head=f'python = "{python}"\nseconds = 3\n'))
    with Workers(made, 1, Limits(seconds=30.0)) as crew:
        builds = crew.build([{"width": 2.0, "height": height} for height in (2.0, 8.5, 3.0)])
    assert [build.failure.kind if build.failure else None for build in builds] == [None, "time", None]
