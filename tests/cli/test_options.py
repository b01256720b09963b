"""The options of the command line are those that the settings' fields describe."""

import inspect
import subprocess
import sys
from collections.abc import Mapping
from typing import Any, get_args, get_type_hints

import pytest
import typer
from typer.testing import CliRunner

from shapewright.cli.evaluations import evaluate
from shapewright.cli.fits import fit
from shapewright.cli.main import app
from shapewright.cli.options import with_settings
from shapewright.cli.projects import demo
from shapewright.cli.shape_files import sample
from shapewright.cli.studio import studio
from shapewright.settings import Settings, described, groups


def options(command):
    """Type and option of each setting that a command offers, by the setting's name."""
    hints = get_type_hints(command, include_extras=True)
    return {name: get_args(hints[name]) for name in hints if name in described()}


@pytest.mark.parametrize("command", [fit, evaluate, studio, demo, sample])
def test_help_choices_and_bounds_are_those_of_the_settings(command):
    assert options(command)
    for name, (hint, option) in options(command).items():
        field = described()[name]
        assert option.help.startswith(field.help)
        assert (option.min, option.max) == (field.within.least, field.within.most)
        assert not field.choices or get_args(get_args(hint)[0]) == field.choices


def test_fit_offers_settings_of_every_group():
    offered = options(fit)
    assert all(offered.keys() & set(names) for names in groups().values())
    assert "default: 15; of the preset paper: 50" in offered["epochs"][1].help
    assert "default: 0.18" in offered["threshold"][1].help
    assert "default: 5.0" in options(studio)["shape_seconds"][1].help


def test_evaluate_measures_the_search_on_as_many_samples_as_the_function():
    from shapewright.fitting.evaluation import REFINED

    assert inspect.signature(evaluate).parameters["refined"].default == REFINED


def test_options_that_are_given_change_the_preset_and_others_do_not(monkeypatch, tmp_path):
    taken = []
    monkeypatch.setattr(
        "shapewright.studio.server.launch.serve", lambda project, preferences, *_: taken.append(preferences)
    )
    (tmp_path / "procedure.py").write_text("")
    assert CliRunner().invoke(app, ["studio", str(tmp_path), "--preset", "paper", "--epochs", "2"]).exit_code == 0
    (preferences,) = taken
    assert preferences.settings == Settings.preset("paper", epochs=2, shape_seconds=5.0)


@pytest.mark.parametrize(
    ("arguments", "chosen"),
    [
        ([], {"refine": "thorough"}),
        (["--augment", "--views", "2"], {"refine": "thorough", "augment": True, "views": 2}),
        (["--refine", "off", "--time-limit", "0.3"], {"refine": "off", "shape_seconds": 0.3}),
    ],
)
def test_a_command_gets_what_was_given_and_its_own_defaults(arguments, chosen):
    taken = []

    @with_settings("augment", "refine", "views", "shape_seconds", refine="thorough")
    def command(chosen: Mapping[str, Any]) -> None:
        taken.append(chosen)

    small = typer.Typer()
    small.command()(command)
    assert CliRunner().invoke(small, arguments).exit_code == 0 and taken == [chosen]


def test_a_choice_that_is_none_is_a_usage_error():
    result = CliRunner().invoke(app, ["fit", "p.py", "references", "--refine", "quik"])
    assert result.exit_code == 2 and all(word in result.output for word in described()["refine"].choices)


def test_help_needs_no_torch_and_no_numba():
    code = "import sys; from shapewright.cli.main import app; app(['fit', '--help'], standalone_mode=False); "
    code += "sys.exit(any(name in sys.modules for name in ('torch', 'numba', 'sklearn')))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=120).returncode == 0


@pytest.mark.parametrize(
    ("text", "seconds"), [("90s", 90), ("10min", 600), ("1h", 3600), ("1.5 h", 5400), ("45", 45), ("2m", 120)]
)
def test_a_limit_of_time_is_written_with_its_unit(text, seconds):
    taken = []

    @with_settings("within")
    def command(chosen: Mapping[str, Any]) -> None:
        taken.append(chosen)

    small = typer.Typer()
    small.command()(command)
    assert CliRunner().invoke(small, ["--within", text]).exit_code == 0 and taken == [{"within": seconds}]
    assert CliRunner().invoke(small, []).exit_code == 0 and taken[1] == {}


@pytest.mark.parametrize("text", ["soon", "10 parsecs", "-3min", "0s", ""])
def test_what_is_no_time_is_a_usage_error(text):
    result = CliRunner().invoke(app, ["fit", "p.py", "references", "--within", text])
    assert result.exit_code == 2 and "is no time" in result.output
