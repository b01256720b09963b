from typing import Annotated, Literal

import numpy as np
import pytest
import torch

import shapewright as sw
from shapewright import Range
from shapewright.building import Workers
from shapewright.modelling.solids import box, cylinder
from shapewright.parameters import Binary, Choice, ParameterSpace, Prediction, Scalar
from shapewright.prediction.dataset import make_dataset, shapes_of, split
from shapewright.prediction.inference import infer, score
from shapewright.prediction.network import CompactNetwork, loss
from shapewright.prediction.training import Schedule, train_network

SETTINGS = sw.Settings(seed=1, samples=500, epochs=14, image_size=32, workers=2)


@sw.procedure
def stool(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    seat: Literal["square", "round"] = "square",
    foot: bool = False,
    foot_size: Annotated[float, Range(0.3, 0.9, when=lambda p: p.foot)] = 0.5,
):
    top = (cylinder if seat == "round" else box)((1, 0.1, 1), at=(0, height, 0))
    shape = top | box((0.15, height, 0.15), at=(0, height / 2, 0))
    return shape | box((foot_size, 0.06, foot_size)) if foot else shape


@pytest.fixture(scope="module")
def predictor():
    return sw.train(stool, SETTINGS)


def test_a_small_predictor_learns_the_parameters(predictor):
    held_out = stool.space.sample(60, seed=99)
    predicted = predictor.predict([stool(**values) for values in held_out])
    error = np.mean([abs(p["height"] - v["height"]) / 0.7 for p, v in zip(predicted, held_out, strict=True)])
    right = np.mean(
        [(p["seat"], p["foot"]) == (v["seat"], v["foot"]) for p, v in zip(predicted, held_out, strict=True)]
    )
    assert error < 0.06 and right > 0.9
    assert all(p["foot_size"] == 0.5 for p in predicted if not p["foot"])
    assert predictor.metrics["height"]["mae"] < 0.06 and predictor.metrics["seat"]["f1"] > 0.9
    assert predictor.curve[-1].validation < predictor.curve[0].validation / 3
    assert predictor.samples == 500


def test_the_same_seed_gives_the_same_predictor(predictor):
    again = sw.train(stool, SETTINGS)
    meshes = [stool(**values) for values in stool.space.sample(20, seed=5)]
    assert predictor.predict(meshes) == again.predict(meshes)
    for mine, theirs in zip(predictor.network.parameters(), again.network.parameters(), strict=True):
        assert torch.equal(mine, theirs)


def test_prediction_does_not_mind_scale_place_or_winding(predictor):
    mesh = stool(height=0.8, seat="round")
    moved = sw.Mesh(mesh.vertices * 37.0 + [5.0, -80.0, 2.0], mesh.faces[:, ::-1])
    one, other = predictor.predict([mesh, moved])
    assert one["height"] == pytest.approx(other["height"], abs=0.02) and one["seat"] == other["seat"]


def test_the_loss_counts_a_parameter_only_where_it_matters():
    space = ParameterSpace((Scalar("s", 0, 1, 0), Choice("c", ("a", "b"), "a")))
    outputs = [torch.tensor([[0.5], [0.9]]), torch.tensor([[0.0, 0.0], [0.0, 0.0]])]
    targets = torch.tensor([[0.25, 0.0], [0.0, 1.0]])
    both = loss(space, outputs, targets, torch.tensor([[True, True], [True, True]]))
    assert both.item() == pytest.approx((0.25 + 0.9) / 2 + np.log(2))
    first = loss(space, outputs, targets, torch.tensor([[True, True], [False, True]]))
    assert first.item() == pytest.approx(0.25 + np.log(2))
    none = loss(space, outputs, targets, torch.zeros(2, 2, dtype=torch.bool))
    assert none.item() == 0.0


def test_each_parameter_has_a_head_of_its_own():
    space = ParameterSpace((Scalar("s", 0, 1, 0), Choice("c", ("a", "b", "d"), "a"), Binary("b", False)))
    network = CompactNetwork(space, views=2, size=32)
    assert [tuple(output.shape) for output in network(torch.rand(5, 2, 2, 32, 32))] == [(5, 2), (5, 3), (5, 2)]
    columns = infer(network, space, np.zeros((4, 2, 2, 32, 32), dtype=np.uint8)).columns
    assert columns[0].shape == (4,) and columns[1].sum(axis=1) == pytest.approx(np.ones(4), abs=1e-5)


def test_scores_are_mae_f1_and_accuracy_where_the_parameter_matters():
    space = ParameterSpace((Scalar("s", 0, 1, 0), Binary("b", False), Scalar("never", 0, 1, 0)))
    predicted = [np.array([0.1, 0.5, 0.9]), np.array([[0.9, 0.1], [0.2, 0.8], [0.2, 0.8]]), np.zeros(3)]
    targets = np.array([[0.0, 0, 0], [0.5, 0, 0], [0.0, 1, 0]], dtype=np.float32)
    active = np.array([[1, 1, 0], [1, 1, 0], [0, 1, 0]], dtype=bool)
    metrics = score(Prediction(space, tuple(predicted)), targets, active)
    assert metrics["s"] == {"kind": "scalar", "rows": 2, "mae": pytest.approx(0.05)}
    assert metrics["b"]["accuracy"] == pytest.approx(2 / 3) and metrics["b"]["f1"] == pytest.approx(2 / 3)
    assert metrics["never"]["rows"] == 0


def test_the_split_is_disjoint_whole_and_seeded():
    parts = split(1000, seed=2)
    assert [len(part) for part in parts] == [800, 100, 100]
    assert sorted(np.concatenate(parts)) == list(range(1000))
    assert all(np.array_equal(a, b) for a, b in zip(parts, split(1000, seed=2), strict=True))


def test_training_does_not_disturb_the_callers_torch():
    data = make_dataset(stool.space, stool.space.sample(40), [stool(**v).normalised() for v in stool.space.sample(40)])
    torch.manual_seed(7)
    expected, threads = torch.rand(3), torch.get_num_threads()
    torch.manual_seed(7)
    train_network(stool.space, data, data, Schedule(epochs=1, seed=3))
    assert torch.equal(torch.rand(3), expected) and torch.get_num_threads() == threads


def test_a_procedure_that_draws_cannot_be_trained_on_meshes():
    import shapely

    @sw.procedure
    def square(size: Annotated[float, Range(0.5, 1.0)] = 0.7):
        return shapely.box(0, 0, size, 1)

    unusable = "only 0 of 12 sampled shapes can be used: it builds drawings"
    with pytest.raises(sw.ProcedureError, match=unusable), Workers(square, 1) as crew:
        shapes_of(crew.build(square.space.sample(12), give_up=True), sw.Mesh)


def test_a_predictor_of_sized_shapes_tells_sizes_apart_and_keeps_it_when_saved(tmp_path):
    @sw.procedure(size="given")
    def cube(side: Annotated[float, sw.Range(10.0, 100.0)] = 50.0, flat: bool = False):
        return box((side, side / 4 if flat else side, side))

    predictor = sw.train(cube, sw.Settings(seed=2, samples=200, epochs=25, image_size=32, workers=2))
    predictor.save(tmp_path / "predictor.pt")
    for one in (predictor, sw.Predictor.load(tmp_path / "predictor.pt")):
        shapes = [cube(side=20.0), cube(side=80.0)]
        small, large = one.predict(shapes)
        assert small["side"] == pytest.approx(20.0, abs=15.0) and large["side"] == pytest.approx(80.0, abs=15.0)
        assert one.predict([shape.normalised() for shape in shapes], [20.0, 80.0]) == [small, large]
