import pytest

WHY = "needs the extras; run `make test-adapters`"


@pytest.mark.parametrize("library", ["cadquery", "build123d"])
def test_the_cad_libraries_work_beside_each_other_and_shapewright(library):
    box = {
        "cadquery": lambda cadquery: cadquery.Solid.makeBox(1, 2, 3),
        "build123d": lambda build123d: build123d.Box(1, 2, 3),
    }[library](pytest.importorskip(library, reason=WHY))
    assert len(box.tessellate(0.1, 0.4)[1]) == 12
