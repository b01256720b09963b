from typing import Annotated, Literal

import shapewright as sw
from shapewright import Infeasible, Range
from shapewright.building import Build, Failure
from shapewright.fitting.sensitivity import without_effect
from shapewright.modelling.solids import box


@sw.procedure
def stand(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    unit: Literal["metre", "inch"] = "metre",
    foot: bool = False,
    foot_size: Annotated[float, Range(0.4, 0.9, when=lambda p: p.foot)] = 0.5,
    rivets: Annotated[int, Range(0, 5)] = 0,
    inside: Annotated[float, Range(0.02, 0.08)] = 0.05,
    never: Annotated[float, Range(0.0, 1.0, when=lambda p: False)] = 0.5,
    banned: bool = False,
):
    if banned:
        raise Infeasible("banned")
    shape = box((1, 0.1, 1), at=(0, height, 0)) | box((0.2, height, 0.2), at=(0, height / 2, 0))
    shape = shape | box((foot_size, 0.06, foot_size)) if foot else shape
    shape = shape - box((inside, inside, inside), at=(0, height / 2, 0))
    return shape.scale(39.37) if unit == "inch" else shape


def build(vectors):
    made = []
    for values in vectors:
        try:
            made.append(Build(values, stand(**values)))
        except Infeasible as error:
            made.append(Build(values, None, Failure("infeasible", str(error))))
    return made


def test_what_changes_no_picture_has_no_effect():
    asked = []

    def counting(vectors):
        asked.extend(vectors)
        return build(vectors)

    builds = [item for item in build(stand.space.sample(80, seed=1)) if item.shape]
    assert without_effect(stand.space, builds, counting, threads=1) == ["unit", "rivets", "inside", "never"]
    assert len(asked) <= 7 * 4 + 3 * 12
    assert without_effect(stand.space, builds, build, threads=1) == ["unit", "rivets", "inside", "never"]


def test_a_run_reports_parameters_without_effect():
    settings = sw.Settings(seed=1, samples=60, epochs=1, image_size=32, workers=2, refine="off")
    it = sw.fit(stand, sw.Collection.of({"one": stand(), "two": stand(height=0.9)}), settings)
    assert it.metrics["without_effect"] == ["unit", "rivets", "inside", "never"]
