import os
from pathlib import Path

import pytest

from shapewright.references import CollectionError, Orientation
from shapewright.references.readers.formats import MESHES
from shapewright.references.sources import find, natural_key


@pytest.fixture
def tree(tmp_path):
    """Makes empty files (finding looks at names only) and returns their folder."""

    def make(*names: str) -> Path:
        for name in names:
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(b"")
        return tmp_path

    return make


def names(*origins, **axes) -> list[str]:
    return [source.name for source in find(origins, **axes)]


def test_natural_order():
    ordered = ["a", "Chair2", "chair2b", "chair10", "Table 1.9", "table 1.10"]
    assert sorted(set(ordered), key=natural_key) == ordered
    assert natural_key("a01") != natural_key("a1")


class TestFolder:
    def test_the_files_in_it_and_in_the_folders_below(self, tree):
        folder = tree("b10.obj", "b9.PLY", "b9.mtl", "wood.jpg", "notes", ".hidden.obj", "._b9.PLY", "below/c.obj")
        assert names(folder) == names(str(folder)) == ["b9", "b10", "c"]

    def test_hidden_folders_and_those_of_runs_and_samples_are_passed_over(self, tree):
        folder = tree("x/b.stl", "x/y/a.off", "readme.txt", ".git/c.obj", "__MACOSX/x/b.stl")
        tree("runs/001/iteration.json", "runs/001/replicas/b.glb", "out/manifest.samples.json", "out/a-0001.glb")
        assert names(folder) == ["a", "b"]
        assert names(folder / "out") == ["a-0001"]

    def test_links_to_folders_are_followed_and_loops_end(self, tree, tmp_path):
        folder = tree("data/x/a.obj", "elsewhere/b.obj") / "data"
        (folder / "link").symlink_to(tmp_path / "elsewhere", target_is_directory=True)
        (folder / "x" / "loop").symlink_to(folder, target_is_directory=True)
        assert names(folder) == ["a", "b"]

    @pytest.mark.parametrize("start", [".", "03001627", "03001627/1a04"])
    def test_shapenet(self, tree, start):
        models = [f"03001627/{shape}/models/model_normalized" for shape in ("1a04", "9f", "10b")]
        folder = tree(*(model + extension for model in models for extension in (".obj", ".mtl", ".json")))
        assert names(folder / start) == (["1a04"] if start.endswith("1a04") else ["1a04", "9f", "10b"])

    def test_pictures_beside_meshes_are_textures(self, tree):
        assert names(tree("a.obj", "wood.png", "b.ply")) == ["a", "b"]
        assert names(tree("c/preview.png", "c/1/a.obj", "c/1/wood.png") / "c") == ["a"]
        drawings = tree("d/1.png", "d/2.SVG", "d/more/3.webp") / "d"
        assert names(drawings) == ["1", "2", "3"]
        assert names(drawings / "**" / "*.[pw]*") == ["1", "3"]

    def test_drawings_below_a_folder_of_meshes_are_refused(self, tree):
        found = find([tree("a.obj", "doc/plan.svg")])
        assert [(one.name, bool(one.refusal)) for one in found] == [("a", False), ("plan", True)]
        assert [one.refusal for one in find([tree("d/a.svg", "d/more/b.svg") / "d"])] == [None, None]

    def test_every_file_of_shapes_that_is_not_read_has_its_refusal(self, tree):
        folder = tree(
            "a.obj", "b.blend", "c.SKP", "sub/d.max", "e.obj.dvc", "wood.tga", "a.mtl", "list.json", "notes.txt"
        )
        refused = {one.path.name: one.refusal for one in find([folder]) if one.refusal}
        assert sorted(refused) == ["b.blend", "c.SKP", "d.max", "e.obj.dvc"]
        assert refused["b.blend"] == "a Blender file, which is not read: open it in Blender and export it as GLB or OBJ"
        assert names(folder)[0] == "a"

    def test_a_link_that_leads_nowhere_is_listed_for_its_reader(self, tree):
        folder = tree("a.obj")
        (folder / "b.obj").symlink_to(folder / ".git" / "annex" / "b.obj")
        assert names(folder) == ["a", "b"]

    def test_a_name_that_is_not_utf_8_is_shown_with_its_letters_and_keeps_its_path(self, tree):
        path = os.fsdecode(os.fsencode(tree("a.obj")) + b"/st\xfchl\x81.obj")
        Path(path).write_bytes(b"")
        odd = find([Path(path).parent])[1]
        assert odd.name == "st\xfchl\ufffd" and odd.path == Path(path)
        tree("st\xfchl\ufffd.obj")
        assert [one.name for one in find([Path(path).parent])] == [
            "a",
            "st\xfchl\ufffd.obj",
            "st\xfchl\ufffd.obj (2)",
        ]

    def test_nothing_there(self, tree):
        folder = tree("a.blend", "b.BLEND", "x/wood.tga", "x/readme")
        with pytest.raises(CollectionError) as error:
            find([folder])
        first, *more = str(error.value).splitlines()
        assert first == (
            f"{folder} holds no shapes: looked for {' '.join(sorted((*MESHES, '.png', '.svg')))}, other "
            "pictures, and points such as .las .pcd .xyz, found 2 .blend, 1 without extension, 1 .tga"
        )
        assert more == [
            f"{name}: a Blender file, which is not read: open it in Blender and export it as GLB or OBJ"
            for name in ("a.blend", "b.BLEND")
        ]

    def test_nothing_there_at_all(self, tmp_path):
        with pytest.raises(CollectionError, match="found no files at all"):
            find([tmp_path])

    def test_a_folder_that_cannot_be_looked_into(self, tree, monkeypatch):
        folder = tree("a.obj")

        def refuse(path):
            raise PermissionError(13, "Permission denied", str(path))

        monkeypatch.setattr(os, "scandir", refuse)
        with pytest.raises(CollectionError, match=r"cannot look into .*: Permission denied"):
            find([folder])


class TestNames:
    def test_stems_that_clash_give_way_to_paths(self, tree):
        folder = tree("chairs/a.obj", "tables/a.obj", "tables/b.obj")
        assert names(folder) == ["b", "chairs/a", "tables/a"]

    def test_the_extension_decides_where_paths_clash_too(self, tree):
        assert names(tree("a.obj", "a.ply", "a.obj.stl", "b.off")) == ["a.obj", "a.obj.stl", "a.ply", "b"]

    def test_a_file_listed_twice_is_two_references(self, tree):
        path = tree("a.obj") / "a.obj"
        assert names(path, path, path) == ["a.obj", "a.obj (2)", "a.obj (3)"]


class TestPattern:
    def test_files_of_every_folder(self, tree):
        folder = tree("x/a1.obj", "x/a2.obj", "y/z/a3.ply", "x/a4.txt")
        assert names(folder / "*" / "a*.obj") == ["a1", "a2"]
        assert names(str(folder / "**" / "*")) == ["a1", "a2", "a3"]
        assert names(str(folder / "x" / "a[2-9].*")) == ["a2"]

    def test_a_relative_pattern(self, tree, monkeypatch):
        monkeypatch.chdir(tree("x/a1.obj"))
        assert [source.path for source in find(["x/*.obj"])] == [Path("x/a1.obj")]

    def test_a_folder_whose_name_looks_like_a_pattern(self, tree):
        assert names(tree("[old]/a.obj") / "[old]") == ["a"]

    @pytest.mark.parametrize(
        ("pattern", "found"),
        [("*.stl", "no files at all"), ("*.tx?", "1 .txt"), ("x*", r"it matches folders: add /\*")],
    )
    def test_no_match(self, tree, pattern, found):
        with pytest.raises(CollectionError, match=rf"matches no shapes: looked for .*, found .*{found}"):
            find([tree("x/a.obj", "a.txt") / pattern])


class TestManifest:
    def write(self, folder: Path, text: str) -> Path:
        path = folder / "list.csv"
        path.write_text(text, encoding="utf-8")
        return path

    def test_its_columns(self, tree):
        folder = tree("m/a.obj", "m/b.obj", "c.obj")
        text = "id,Name,path, up ,front\n1,seat,m/a.obj,z,\n2,,m/b.obj,-Z,x\n\n3,,c.obj,,\n"
        sources = {source.name: source for source in find([self.write(folder, text)])}
        assert {name: source.orientation for name, source in sources.items()} == {
            "seat": Orientation("z", "-y"),
            "b": Orientation("-z", "x"),
            "c": Orientation("y", "z"),
        }
        assert sources["seat"].path == folder / "m" / "a.obj"

    def test_empty_cells_leave_the_arguments_in_force(self, tree):
        manifest = self.write(tree(), "path,up\na.obj,\nb.obj,y\n")
        found = find([manifest], up="z", front="x")
        assert [source.orientation for source in found] == [Orientation("z", "x"), Orientation("y", "x")]

    @pytest.mark.parametrize("separator", [",", ";", "\t"])
    def test_its_separators_quotes_and_mark(self, tree, separator):
        lines = [["\ufeffpath", "name"], ['"a, b;c\td.obj"', '"a ""b"""'], ["e.obj"]]
        manifest = self.write(tree(), "\r\n".join(separator.join(line) for line in lines))
        assert [(source.path.name, source.name) for source in find([manifest])] == [
            ("a, b;c\td.obj", 'a "b"'),
            ("e.obj", "e"),
        ]

    def test_names_that_clash_give_way_to_paths(self, tree):
        assert names(self.write(tree(), "path,name\nx/a.obj,Bed\ny/a.obj,Bed\n")) == ["x/a", "y/a"]

    @pytest.mark.parametrize(
        ("text", "message"),
        [
            ("file,name\na.obj,a\n", "no column 'path'; its first line has file, name"),
            ("", "no column 'path'; its first line has none"),
            ("path,up\n", "lists no files"),
            ("path,up\n\na.obj,y\n,z\n", "line 4: no path"),
            ("path,up\na.obj,top\n", "a.obj, as the manifest lists it: up='top' is no axis"),
            ("path,up,front\na.obj,z,z\n", "a.obj, as the manifest lists it: .* parallel"),
        ],
    )
    def test_what_is_wrong_with_it(self, tree, text, message):
        with pytest.raises(CollectionError, match=message):
            find([self.write(tree(), text)])


class TestPath:
    def test_one_file(self, tree):
        assert names(tree("a.obj") / "a.obj") == ["a"]

    def test_several_origins(self, tree):
        folder = tree("x/a.obj", "y/b.obj", "z/c.obj", "list.csv")
        (folder / "list.csv").write_text("path\nz/c.obj\n")
        assert names(folder / "x", folder / "y" / "*", folder / "list.csv", folder / "none.obj") == [
            "a",
            "b",
            "c",
            "none",
        ]

    def test_home(self, tree, monkeypatch):
        monkeypatch.setenv("HOME", os.fspath(tree("a.obj")))
        assert names("~/a.obj") == ["a"]

    def test_no_such_folder_names_what_is_near(self, tree):
        folder = tree("chairs/a.obj", "tables/a.obj")
        with pytest.raises(CollectionError) as error:
            find([folder / "chiars" / "office"])
        assert str(error.value) == (
            f"no such file or folder: {folder / 'chiars' / 'office'}; did you mean {folder / 'chairs'}?"
        )

    def test_no_such_folder_names_what_is_there(self, tree):
        folder = tree("chairs/a.obj", "tables/a.obj")
        with pytest.raises(CollectionError, match=rf"no such file or folder: .*; {folder} holds chairs, tables"):
            find([folder / "Q"])

    def test_another_kind_of_file(self, tree):
        with pytest.raises(
            CollectionError,
            match=r"a\.blend is not a kind of file that is read; \.3mf .* and \.csv are\na\.blend: a Blender file",
        ):
            find([tree("a.blend") / "a.blend"])

    def test_an_empty_list(self):
        with pytest.raises(CollectionError, match="the list of references is empty"):
            find([])

    def test_axes_are_checked_before_anything_is_looked_for(self):
        with pytest.raises(CollectionError, match="up='w' is no axis"):
            find(["nowhere"], up="w")
