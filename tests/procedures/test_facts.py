import json
from typing import Annotated

import numpy as np
import pytest

import shapewright as sw
from shapewright import Range
from shapewright.fitting.samples import write_samples
from shapewright.procedures import Facts


def pillar(height: Annotated[float, Range(2.0, 9.0)] = 5.0, wide: bool = False):
    side = 2.0 if wide else 1.0
    x, y, z = np.meshgrid([0, side], [0, 1], [0, height], indexing="ij")
    corners = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    return corners, [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


UPRIGHT = sw.procedure(up="z", unit="mm", size="given")(pillar)


@pytest.mark.parametrize(
    ("up", "point"), [("y", (1, 2, 3)), ("z", (1, 3, -2)), ("-z", (-1, -3, -2)), ("x", (-2, 1, 3)), ("-y", (-1, -2, 3))]
)
def test_what_points_up_is_turned_up_and_back(up, point):
    mesh = sw.Mesh(np.array([[0, 0, 0], [1, 2, 3], [1, 0, 0]]), [[0, 1, 2]])
    stood = Facts(up).stood(mesh)
    assert stood.vertices[1].tolist() == list(point)
    assert Facts(up).laid(stood).vertices.tolist() == mesh.vertices.tolist()


def test_a_procedure_builds_with_y_up_whatever_its_function_returns():
    assert UPRIGHT(height=7.0).extent.tolist() == [1.0, 7.0, 1.0]
    assert sw.procedure(pillar)(height=7.0).extent.tolist() == [1.0, 1.0, 7.0]
    assert UPRIGHT.random(0).bounds[0].tolist() == [0.0, 0.0, -1.0]


def test_workers_know_the_facts():
    assert [build.shape.extent[1] for build in sw.sample(UPRIGHT, 2, seed=3)] == [
        values["height"] for values in UPRIGHT.space.sample(2, seed=3)
    ]


@pytest.mark.parametrize(
    ("facts", "message"),
    [({"up": "up"}, "up='up': use one of x, y, z"), ({"unit": "inch"}, "unit='inch'"), ({"size": "real"}, "given")],
)
def test_a_fact_that_is_none_is_refused_at_the_functions_line(facts, message):
    with pytest.raises(sw.ProcedureError, match=message) as told:
        sw.procedure(**facts)(pillar)
    assert told.value.place.function == "pillar"


def test_a_record_has_the_facts_that_are_stated():
    assert UPRIGHT.facts.stated == {"up": "z", "unit": "mm", "size": "given"}
    assert sw.procedure(pillar).facts.stated == {}
    assert Facts.of({"name": "pillar", **UPRIGHT.facts.stated}) == UPRIGHT.facts


def test_samples_come_in_the_axes_of_the_procedure_and_glb_in_its_own_and_in_metres(tmp_path):
    for format in ("stl", "glb"):
        write_samples(UPRIGHT, 1, tmp_path / format, format, workers=1)
    height = UPRIGHT.space.sample(1)[0]["height"]
    (stl,), (glb,) = (sw.Collection.load(str(tmp_path / f"{kind}/*.{kind}")) for kind in ("stl", "glb"))
    assert stl.size[2] == pytest.approx(height)
    assert glb.size[1] == pytest.approx(height / 1000.0) and glb.unit == 1.0
    data = next((tmp_path / "glb").glob("*.glb")).read_bytes()
    document = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    assert document["nodes"][0]["extras"].items() >= {"unit": "mm", "up": "z"}.items()
    both = sw.Collection((*(stl,), *(glb,))).sized(UPRIGHT.facts.metres)
    assert both.extents == pytest.approx((height, height))
    assert both.standing("z").references[0].shape.extent[1] == 1.0
    assert both.standing("z").references[1].shape is both.references[1].shape


def test_facts_are_read_from_a_text():
    assert Facts.written("up=z, unit='mm'", {"size": "given"}) == Facts("z", "mm", "given")
    assert Facts.written("", {"up": "z"}) == Facts("z")
    for text in ("size=large", "size", "colour=red"):
        with pytest.raises(ValueError, match="size"):
            Facts.written(text, {})
