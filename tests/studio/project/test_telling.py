from dataclasses import replace

import pytest
import trimesh
from msgspec.structs import replace as replace_struct

from shapewright.references import Collection
from shapewright.references.manifests.folder_tables import TABLE
from shapewright.studio.project.listing import listing
from shapewright.studio.project.telling import tell, told
from shapewright.studio.project.workspace import Project, ProjectError
from shapewright.studio.wire.detail import Told

NOTHING = Told()


@pytest.fixture
def project(tmp_path):
    home = tmp_path / "chairs"
    (home / "references").mkdir(parents=True)
    (home / "procedure.py").write_text("")
    for name in ("a", "b"):
        trimesh.creation.box((1, 2, 3)).export(home / "references" / f"{name}.stl")
    return Project.of(home)


def sources(project):
    return listing(project.origin).sources


def test_what_is_told_is_in_the_table_that_every_command_reads_and_is_taken_back(project):
    says = Told(up="z", split="apart")
    tell(project, [(source, says) for source in sources(project).values()])
    table = project.folder / "references" / TABLE
    assert table.read_text() == "path,up,front,split\na.stl,z,,apart\nb.stl,z,,apart\n"
    assert [told(source) for source in sources(project).values()] == [says, says]
    assert [each.orientation.up for each in Collection.load(project.origin.source)] == ["z", "z"]
    tell(project, [(sources(project)["a"], NOTHING)])
    assert told(sources(project)["a"]) == NOTHING and told(sources(project)["b"]) == says
    tell(project, [(sources(project)["b"], NOTHING)])
    assert not table.exists()


def test_nothing_is_written_where_another_place_says_it_or_outside_the_project(project, tmp_path):
    trimesh.creation.box((1, 2, 3)).export(tmp_path / "far.stl")
    (project.folder / "list.csv").write_text("path\nreferences/a.stl\n")
    for source, why in ((tmp_path, "outside the project"), (project.folder / "list.csv", "list.csv lists")):
        other = replace(project, origin=replace(project.origin, source=str(source), confine=None))
        with pytest.raises(ProjectError, match=why):
            tell(other, [(source, Told(up="z")) for source in sources(other).values()])
    assert not list(tmp_path.rglob(TABLE))


def test_an_up_on_the_axis_of_the_front_is_refused_before_anything_is_written(project):
    facing = replace(project, origin=replace(project.origin, front="z"))
    with pytest.raises(ProjectError, match="up='-z' and front='z' are parallel"):
        tell(facing, [(source, Told(up="-z")) for source in sources(facing).values()])
    assert not list(project.folder.rglob(TABLE))


def test_a_front_is_told_too_and_stays_in_a_table_that_has_it(project):
    table = project.folder / "references" / TABLE
    table.write_text("path,up,front\na.stl,z,x\n")
    source = sources(project)["a"]
    assert told(source) == Told(up="z", front="x")
    tell(project, [(source, replace_struct(told(source), front="-y"))])
    first = next(iter(Collection.load(project.origin.source)))
    assert (first.orientation.up, first.orientation.front) == ("z", "-y")
    with pytest.raises(ProjectError, match="a: up='z' and front='-z' are parallel"):
        tell(project, [(source, Told(up="z", front="-z"))])


def test_where_axes_are_to_be_found_what_is_told_stands_alone(project):
    finding = replace(project, origin=replace(project.origin, up="auto", front="z"))
    tell(finding, [(source, Told(up="z")) for source in sources(finding).values()])
    listed = listing(finding.origin)
    assert listed.free == set() and {one.orientation.front for one in listed.sources.values()} == {"-y"}


def test_a_unit_is_told_and_read_by_the_next_fit_and_a_table_gets_its_column_only_then(project):
    table, source = project.folder / "references" / TABLE, sources(project)["a"]
    tell(project, [(source, Told(up="z"))])
    assert "unit" not in table.read_text()
    tell(project, [(source, Told(up="z", unit="mm"))])
    assert told(source) == Told(up="z", unit="mm")
    assert [each.unit for each in Collection.load(project.origin.source)] == [0.001, None]
    tell(project, [(source, NOTHING)])
    assert not table.exists()
