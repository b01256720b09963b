from typing import Annotated

import numpy as np
import pytest
import torch
from torch import nn

import shapewright as sw
from shapewright import Range
from shapewright.modelling.solids import box
from shapewright.parameters import Binary, Choice, ParameterSpace, Scalar
from shapewright.prediction import devices
from shapewright.prediction.dataset import make_dataset
from shapewright.prediction.heads import head_of
from shapewright.prediction.inference import infer
from shapewright.prediction.network import CompactNetwork, loss, make_network, spread_loss
from shapewright.prediction.training import Schedule, train_network
from shapewright.prediction.vgg import VGG19Network, find_weights
from shapewright.rendering.cameras import THREE_VIEWS

SPACE = ParameterSpace((Scalar("s", 0.2, 1, 0.5), Choice("c", ("a", "b", "d"), "a"), Binary("b", False)))


@sw.procedure
def slab(s: Annotated[float, Range(0.2, 1.0)] = 0.5, b: bool = False):
    return box((1, s, 0.5 if b else 1))


def dataset(space=SPACE, count=16, size=32, views=2):
    rows = space.sample(count, seed=3)
    meshes = [slab(s=values["s"], b=values["b"]).normalised() for values in rows]
    return make_dataset(space, rows, meshes, THREE_VIEWS[:views], size, threads=1)


def published(colours=3):
    """Random weights in torchvision's layout."""
    network = VGG19Network(SPACE, views=1, size=32)
    state = {f"features.{name}": value.clone() for name, value in network.features.state_dict().items()}
    state["features.0.weight"] = torch.randn(64, colours, 3, 3)
    return state | {"classifier.0.weight": torch.zeros(2, 2)}


@pytest.mark.parametrize("name", ["compact", "vgg19"])
def test_every_network_gives_every_parameter_an_answer(name):
    network = make_network(name, SPACE, views=2, size=32).eval()
    answers = network(torch.rand(5, 2, 2, 32, 32))
    assert [tuple(answer.shape) for answer in answers] == [(5, 2), (5, 3), (5, 2)]


def test_heads_at_once_answer_as_each_by_itself():
    heads, features = CompactNetwork(SPACE, views=1, size=16).heads, torch.randn(4, 256)
    scalar = heads["head_s"]
    alone = [torch.cat([scalar.value(features), scalar.spread(features)], dim=1)]
    alone += [heads[f"head_{name}"](features) for name in SPACE.names[1:]]
    for together, expected in zip(heads(features), alone, strict=True):
        torch.testing.assert_close(together, expected)


def test_the_spread_teaches_nothing_but_itself():
    network = CompactNetwork(SPACE, views=1, size=16)
    targets, active = torch.rand(4, 3), torch.ones(4, 3, dtype=torch.bool)
    spread_loss(SPACE, network(torch.rand(4, 1, 2, 16, 16)), targets, active).backward()
    taught = {name for name, value in network.named_parameters() if value.grad is not None and value.grad.any()}
    assert taught and all(name.startswith("heads.head_s.spread") for name in taught)


def test_the_spread_that_loses_least_is_the_mean_error():
    space, targets = ParameterSpace((Scalar("s", 0, 1, 0),)), torch.tensor([[0.0], [0.0], [1.0]])
    active = torch.tensor([[True], [True], [False]])
    values, spread = torch.tensor([0.1, 0.3, 0.3]), torch.zeros(3, requires_grad=True)
    answer = torch.stack([values, spread + np.log(0.2)], dim=1)
    spread_loss(space, [answer], targets, active).backward()
    assert spread.grad.sum().item() == pytest.approx(0.0, abs=1e-6) and spread.grad[2] == 0.0
    assert spread.grad[0] > 0 > spread.grad[1]


def test_vgg19_has_the_layout_of_torchvision():
    network = VGG19Network(SPACE, views=2, size=64)
    convolutions = [name for name, layer in network.features.named_children() if isinstance(layer, nn.Conv2d)]
    assert convolutions == ["0", "2", "5", "7", "10", "12", "14", "16", "19", "21", "23", "25", "28", "30", "32", "34"]
    assert len(network.features) == 37 and network.features[34].weight.shape == (512, 512, 3, 3)
    assert network.heads["head_c"][0].in_features == 2 * 512 * 2 * 2
    with pytest.raises(ValueError, match="at least 32 pixels"):
        VGG19Network(SPACE, views=1, size=16)


def test_published_weights_see_a_grey_picture_as_they_would_in_colour(tmp_path):
    state = published()
    torch.save(state, tmp_path / "vgg19.pth")
    network = VGG19Network(SPACE, views=1, size=32, weights=tmp_path / "vgg19.pth")
    grey = torch.rand(2, 1, 8, 8)
    colour = nn.Conv2d(3, 64, 3, padding=1)
    colour.load_state_dict({"weight": state["features.0.weight"], "bias": state["features.0.bias"]})
    seen = network.features[0](torch.cat([grey, torch.rand(2, 1, 8, 8)], dim=1))
    assert torch.allclose(seen, colour(grey.expand(-1, 3, -1, -1)), atol=1e-5)
    assert torch.equal(network.features[34].weight, state["features.34.weight"])


def test_other_files_are_no_weights(tmp_path):
    (tmp_path / "text.pth").write_text("no weights")
    with pytest.raises(ValueError, match=r"text\.pth: not readable"):
        VGG19Network(SPACE, views=1, size=32, weights=tmp_path / "text.pth")
    torch.save({k: v for k, v in published().items() if "34" not in k}, tmp_path / "vgg16.pth")
    with pytest.raises(ValueError, match="not the convolutions"):
        VGG19Network(SPACE, views=1, size=32, weights=tmp_path / "vgg16.pth")


def test_weights_come_from_the_named_file_or_from_torchs_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("TORCH_HOME", str(tmp_path))
    with pytest.warns(UserWarning, match="trained from scratch"):
        assert find_weights() is None
    checkpoints = tmp_path / "hub" / "checkpoints"
    checkpoints.mkdir(parents=True)
    for name in ("vgg19-dcbb9e9d.pth", "vgg19_bn-c79401a0.pth"):
        (checkpoints / name).touch()
    assert find_weights() == checkpoints / "vgg19-dcbb9e9d.pth"
    assert find_weights(tmp_path / "hub" / "checkpoints" / "vgg19_bn-c79401a0.pth").name.startswith("vgg19_bn")
    with pytest.raises(ValueError, match="no such file"):
        find_weights(tmp_path / "missing.pth")


def test_vgg19_trains_as_the_paper_does():
    data = dataset(count=8)
    schedule = Schedule(epochs=2, batch=4, learning_rate=1e-4, optimiser="adam", camera_rate=0.05, network="vgg19")
    trained, again = (train_network(SPACE, data, data, schedule, threads=2) for _ in range(2))
    assert np.isfinite(trained.curve[-1].validation) and trained.cameras != data.cameras
    state, same = trained.network.state_dict(), again.network.state_dict()
    assert all(torch.equal(state[name], same[name]) for name in state)


def test_training_goes_on_from_another_network_where_the_two_agree():
    edited = ParameterSpace((SPACE["s"], Choice("c", ("a", "b"), "a"), Binary("b", False), Scalar("new", 0, 1, 0)))
    old = train_network(SPACE, dataset(), dataset(), Schedule(epochs=3), threads=1).network
    schedule = Schedule(epochs=1, learning_rate=1e-12, weight_decay=0.0, seed=5)
    fresh, warm = (
        train_network(edited, dataset(edited), dataset(edited), schedule, threads=1, initial=initial).network
        for initial in (None, old)
    )

    def layers(network, prefix):
        return torch.cat([v.flatten() for n, v in network.named_parameters() if n.startswith(prefix)])

    for kept in ("features", "heads.head_s.value", "heads.head_b"):
        assert torch.allclose(layers(warm, kept), layers(old, kept), atol=1e-6)
        assert not torch.allclose(layers(fresh, kept), layers(old, kept), atol=1e-3)
    assert torch.allclose(layers(warm, "heads.head_new.value"), layers(fresh, "heads.head_new.value"), atol=1e-6)
    assert head_of(warm, "c")[2].weight.shape[0] == 2


def test_devices_are_picked_by_name():
    there = devices.available()
    assert there[-1] == "cpu" and devices.pick("auto") == torch.device(there[0])
    assert devices.pick("cpu") == torch.device("cpu")
    for missing in {"cuda", "mps"} - set(there):
        with pytest.raises(ValueError, match=f"device='{missing}': torch finds none here; available: .*cpu"):
            devices.pick(missing)


def test_the_loss_does_not_see_the_spread():
    targets, active = torch.rand(4, 3), torch.ones(4, 3, dtype=torch.bool)
    answers = CompactNetwork(SPACE, views=1, size=16)(torch.rand(4, 1, 2, 16, 16))
    changed = [torch.cat([answers[0][:, :1], torch.rand(4, 1)], dim=1), *answers[1:]]
    assert loss(SPACE, answers, targets, active) == loss(SPACE, changed, targets, active)


def test_values_of_vectors_and_records_have_heads_as_others_do():
    space = ParameterSpace((Scalar("size.x", 0.2, 1, 0.5), Binary("legs.round", False), Binary("legs_round", False)))
    network = make_network("compact", space, 2, 32)
    assert [head_of(network, name) for name in space.names] == list(network.heads.values())
    assert len(set(network.state_dict())) == len(network.state_dict())


def test_an_integer_with_many_values_is_predicted_as_a_number_and_rounded():
    @sw.procedure
    def plate(hole: Annotated[int, Range(5, 30)] = 10, feet: Annotated[int, Range(1, 4)] = 2):
        return box((hole, feet, 40))

    vectors = plate.space.sample(24, seed=1)
    data = make_dataset(plate.space, vectors, [plate(**vector).normalised() for vector in vectors], THREE_VIEWS[:1], 32)
    torch.manual_seed(0)
    network = CompactNetwork(plate.space, 1, 32)
    answers = network(torch.from_numpy(data.images).float())
    assert [tuple(answer.shape) for answer in answers] == [(24, 2), (24, 4)]  # a value with its spread; four classes
    predicted = infer(network, plate.space, data.images).decode()
    assert {type(values["hole"]) for values in predicted} == {int}
    assert all(5 <= values["hole"] <= 30 for values in predicted)
