"""The space that the random draws of a function are, of functions that are told what they draw."""

import random

import pytest

from shapewright.commands.entries import entries_of
from shapewright.commands.procfunc.drawn_space import MOST_RUNS, read_draws, settled
from shapewright.commands.procfunc.naming import Site


class Drawing:
    """Records draws as the program in the other Python does. forced: values by key."""

    def __init__(self, forced, seed):
        self.forced, self.seed, self.records = forced, seed, []

    def _record(self, name, **said):
        number = sum(each["name"] == name for each in self.records) + 1
        key = f"{name}#{number}"
        place = {"file": "/lib/seats.py", "function": f"_{name}_rand", "line": 7, "column": len(name), "outer": "way"}
        self.records.append({"name": name, "key": key, "held": False, **place, **said})
        return key

    def number(self, name, low, high, **said):
        key = self._record(name, low=low, high=high, **said)
        middle = (low + high) / 2 if self.seed is None else random.Random(f"{self.seed} {key}").uniform(low, high)
        kind, given = self.forced.get(key, ("value", int(middle) if said.get("integer") else middle))
        value = given if kind == "value" else low + given * (high - low)
        self.records[-1]["value"] = value
        return value

    def choice(self, name, options, **said):
        key = self._record(name, options=options, **said)
        self.records[-1]["value"] = self.forced.get(key, ("option", 0))[1]
        return options[self.records[-1]["value"]]


def read(function, sites=None):
    """The draws of a function, and in how many calls they were read."""
    calls = []

    def run(forced, seed):
        drawing = Drawing(forced, seed)
        function(drawing)
        calls.append(forced)
        return drawing.records

    draws = read_draws(run, lambda record: (sites or {}).get(record["name"], Site(record["name"])))
    entries_of({name: draw.table for name, draw in draws.items()})  # a spec could say so
    return draws, len(calls)


def tables(function, sites=None):
    draws, _ = read(function, sites)
    plain = {name: dict(draw.table) for name, draw in draws.items()}
    assert all(table.pop("description").endswith("seats.py:7") for table in plain.values())
    return plain


def test_ranges_are_those_of_the_calls():
    def made(d):
        d.number("width", 1.0, 2.0)
        d.number("count", 2, 40, integer=True)
        d.number("scale", 0.1, 10.0, log=True)
        d.choice("closed", [True, False])
        d.choice("feet", ["ball", "block"])

    assert tables(made) == {
        "width": {"range": [1.0, 2.0]},
        "count": {"range": [2, 40], "integer": True, "default": 21},
        "scale": {"range": [0.1, 10.0], "log": True},
        "closed": {"bool": True, "default": True},
        "feet": {"choices": ["ball", "block"], "default": "ball"},
    }


def test_names_that_are_the_same_get_numbers_and_a_draw_without_one_that_of_its_function():
    def made(d):
        for name in ("a", "b", "c", "d"):
            d.number(name, 0.0, 1.0)

    sites = {"a": Site("size"), "b": Site("size_2"), "c": Site("size"), "d": Site("", "_seat_rand")}
    assert list(tables(made, sites)) == ["size", "size_2", "size_3", "seat"]


def test_a_range_that_depends_on_another_draw_is_a_share():
    def made(d):
        width = d.number("width", 1.0, 2.0)
        d.number("depth", 0.5 * width, width)

    draws, _ = read(made)
    assert (draws["width"].kind, draws["depth"].kind) == ("value", "share")
    assert draws["depth"].table["range"] == [0.0, 1.0] and draws["depth"].given(0.25) == ("share", 0.25)


def test_what_is_drawn_with_one_option_only_has_a_condition():
    def made(d):
        base = d.choice("base", ["legs", "star", "block"])
        if base == "star" and d.choice("wheels", ["none", "some"]) == "some":
            d.number("radius", 1.0, 2.0)
        if base != "block":
            d.number("height", 1.0, 2.0)

    found = tables(made)
    assert {name: table.get("when") for name, table in found.items()} == {
        "base": None,
        "height": "base in ('legs', 'star')",
        "wheels": "base == 'star'",
        "radius": "wheels == 'some'",
    }


def test_a_draw_that_is_fixed_settles_what_depends_on_it():
    def made(d):
        if d.choice("base", ["legs", "star"]) == "star" and d.choice("wheels", ["none", "some"]) == "some":
            d.number("radius", 1.0, 2.0)
        else:
            d.number("height", 1.0, 2.0)

    draws, _ = read(made)
    star = settled(draws, {"base": "star"})
    assert list(star) == ["base", "height", "wheels", "radius"]
    assert "when" not in star["wheels"].table and star["radius"].table["when"] == "wheels == 'some'"
    assert list(settled(draws, {"base": "legs"})) == ["base", "height"]


def test_a_count_says_how_many_of_a_loop_there_are():
    def made(d):
        for _ in range(d.number("count", 1, 3, integer=True)):
            d.number("length", 1.0, 2.0)

    found = tables(made)
    assert {name: table.get("when") for name, table in found.items()} == {
        "count": None,
        "length": None,
        "length_2": "count >= 2",
        "length_3": "count >= 3",
    }


def test_what_is_drawn_for_no_known_reason_is_held_and_so_is_what_matters_to_materials():
    def made(d):
        if d.number("width", 0.0, 1.0) > 0.5:
            d.number("sometimes", 0.0, 1.0)
        d.number("gloss", 0.0, 1.0, held=True)
        if d.choice("seat_material", ["wood", "steel"]) == "steel":
            d.number("grain", 0.0, 1.0)
        d.choice("only", ["one"])

    draws, calls = read(made)
    assert list(draws) == ["width"] and calls == 2


def test_a_draw_within_an_option_counts_with_it_and_an_option_that_differs_has_the_name_of_its_variable():
    def made(d):
        rib = d.number("rib", 1.0, 2.0)
        own = d.number("own", 1.0, 2.0)
        d.choice("depth", [0.5, rib, own])

    sites = {"own": Site("own", choice=(7, len("depth")), option=2), "depth": Site("depth", options=("", "rib", ""))}
    found = tables(made, sites)
    assert found["depth"]["choices"] == ["0.5", "rib", "drawn"]
    assert found["own"]["when"] == "depth == 'drawn'" and "when" not in found["rib"]
    assert read(made, sites)[0]["depth"].given("rib") == ("option", 1)


def test_reading_ends():
    def made(d):
        for i in range(50):
            d.choice(f"choice_{i}", ["a", "b", "c"])

    draws, calls = read(made)
    assert len(draws) == 50 and calls == pytest.approx(MOST_RUNS, abs=2)
