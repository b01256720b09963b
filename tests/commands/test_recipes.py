"""Ranges of GeoCode and PyTorchGeoNodes: small files in the form of theirs, written anew."""

import json

import pytest

import shapewright as sw
from shapewright.commands.recipes import read_recipe
from shapewright.procedures import Infeasible, ProcedureError

RECIPE = """\
base:
  seat_height: 0.6999999
  seat_count: 3
  is_arm: 1
  arm_width: 0.2
  leg_bend:
    x: 0.5
    y: 1.0000001
dataset_generation:
  seat_height:
    min: 0.4
    max: 0.8
    samples: 5
  seat_count:
    min: 1
    max: 4
  is_arm:
    min: 0
    max: 1
  arm_width:
    min: 0.1
    max: 0.3
    samples: 3
  leg_bend:
    x:
      min: 0.0
      max: 1.0
      samples: 6
    y:
      min: 0.0
      max: 1.0
      samples: 6
constraints:
  rule1: arm_width <= seat_height
visibility_conditions:
  arm_: is_arm
  leg_bend y: ( not is_arm ) or seat_count > 2
camera_angles_train:
- - -30.0
  - 35.0
"""
PROGRAM = {
    "class_name": "stool",
    "blend_path": "./stool.blend",
    "params": {
        "Base": {
            "type": "nested",
            "params": {
                "Seat Width": {"type": "float", "range": [0.3, 0.9]},
                "Legs Type": {"type": "int", "range": [0, 3]},
                "Sides": {"type": "int", "valid_values": [3, 4, 8]},
            },
        },
        "Has Ring": {"type": "bool", "or_dependencies": [["Legs Type", 1], ["Legs Type", 2]]},
        "Ring Height": {"type": "float", "range": [0.1, 0.5], "or_dependencies": ["Has Ring"]},
        "Cushion": {"type": "bool", "range": [0, 2], "not_dependencies": ["Has Ring"]},
    },
}


def described(folder, ranges, extra="", name="ranges"):
    path = folder / "spec.toml"
    path.write_text(f'run = "false {{params.json}} {{out.obj}}"\n{name} = "{ranges}"\n{extra}')
    made = sw.load_procedure(path)
    return made, made.space.to_schema()["properties"]


@pytest.mark.parametrize("name", ["ranges", "parameters"])
def test_a_recipe_of_geocode_is_a_space(tmp_path, name):
    pytest.importorskip("yaml", reason="recipes are YAML")
    (tmp_path / "recipe.yml").write_text(RECIPE)
    made, space = described(tmp_path, "recipe.yml", name=name)
    assert space == {
        "seat_height": {"type": "number", "minimum": 0.4, "maximum": 0.8, "x-steps": 5, "default": 0.6999999},
        "seat_count": {"type": "integer", "minimum": 1, "maximum": 4, "default": 3},
        "is_arm": {"type": "boolean", "default": True},
        "arm_width": {
            "type": "number", "minimum": 0.1, "maximum": 0.3, "x-steps": 3, "default": 0.2, "x-when": "is_arm",
        },
        "leg_bend_x": {"type": "number", "minimum": 0.0, "maximum": 1.0, "x-steps": 6, "default": 0.5},
        "leg_bend_y": {
            "type": "number", "minimum": 0.0, "maximum": 1.0, "x-steps": 6, "default": 1.0,
            "x-when": "( not is_arm ) or seat_count > 2",
        },
    }  # fmt: skip
    assert made.helpers == (tmp_path / "recipe.yml",)
    assert "leg_bend_y" not in made.space.active(made.space.defaults | {"seat_count": 1})
    with pytest.raises(Infeasible, match="arm_width <= seat_height"):
        made(arm_width=0.9)


def test_data_types_of_a_recipe_say_what_its_parameters_are(tmp_path):
    pytest.importorskip("yaml", reason="recipes are YAML")
    (tmp_path / "r.yml").write_text(
        "dataset_generation:\n  lid: {min: 0, max: 1}\n  size: {min: 1, max: 3, samples: 5}\n  n: {min: 0, max: 1}\n"
        "data_types:\n  lid: {type: Boolean}\n  size: {type: Float}\n  n: {type: Integer}\n"
    )
    _, space = described(tmp_path, "r.yml")
    assert [space[name]["type"] for name in ("lid", "size", "n")] == ["boolean", "number", "integer"]


def test_a_shape_program_of_pytorchgeonodes_is_a_space(tmp_path):
    (tmp_path / "sp_stool.json").write_text(json.dumps(PROGRAM))
    made, space = described(tmp_path, "sp_stool.json")
    assert space == {
        "Seat_Width": {"type": "number", "minimum": 0.3, "maximum": 0.9, "default": 0.6},
        "Legs_Type": {"type": "integer", "minimum": 0, "maximum": 2, "default": 0},
        "Sides": {"enum": [3, 4, 8], "default": 3},
        "Has_Ring": {"type": "boolean", "default": False, "x-when": "Legs_Type == 1 or Legs_Type == 2"},
        "Ring_Height": {"type": "number", "minimum": 0.1, "maximum": 0.5, "default": 0.3, "x-when": "Has_Ring"},
        "Cushion": {"type": "boolean", "default": False, "x-when": "not Has_Ring"},
    }
    assert made.function.spec.entries.names["Legs_Type"] == "Legs Type"


def test_a_spec_may_say_more_than_its_recipe(tmp_path):
    (tmp_path / "sp.json").write_text(json.dumps(PROGRAM))
    _, space = described(tmp_path, "sp.json", '[parameters]\nCushion = true\n"Seat Width" = { range = [0.4, 0.5] }\n')
    assert "Cushion" not in space and space["Seat_Width"]["maximum"] == 0.5


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("a.json", "{", "a.json:1: no JSON"),
        ("a.json", "{}", "no ranges are found"),
        ("a.json", '{"params": {"x": {"type": "color"}}}', "type 'color' is none of float, int, bool, nested"),
        ("a.json", '{"params": {"x": {"type": "float"}}}', "it cannot be understood: KeyError: 'range'"),
        ("a.yml", "a:\n  b: [\n", "no YAML"),
    ],
)
def test_a_file_of_another_form_is_refused(tmp_path, name, text, says):
    (tmp_path / name).write_text(text)
    with pytest.raises(ProcedureError) as error:
        read_recipe(tmp_path / name)
    assert says in str(error.value)
