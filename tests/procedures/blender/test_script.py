"""Values of sockets as a script for Blender. That it does what it should is tested where Blender is."""

import ast

import pytest

from shapewright import procedure
from shapewright.procedures import ProcedureError
from shapewright.procedures.blender.script import script
from shapewright.procedures.blender.sockets import Socket
from shapewright.procedures.forms import written

SIZE = Socket("size", "Socket_1", "Size", "", "", "float", 0.5, 0.0, 1.0, (), False)
PAINT = Socket("paint", "Socket_2", "Paint", "", "", "material", None, None, None, (), False)


def test_each_shape_is_a_call_with_identifiers_of_sockets():
    text = script("My 'Group'", [SIZE, PAINT], {"a": {"size": 0.25}, "it's": {"size": 1.0}})
    calls = [ast.literal_eval(f"({line[4:-1]})") for line in text.splitlines() if line.startswith("add(")]
    assert calls == [("a", {"Socket_1": 0.25}), ("it's", {"Socket_1": 1.0})]
    assert "# Socket_1: Size\n" in text and ast.parse(text)


def test_a_procedure_that_is_no_node_group_has_none():
    @procedure
    def box(lid: bool = False): ...

    with pytest.raises(ProcedureError, match="the form blender is for node groups"):
        written(box, {"a": {"lid": True}}, "blender")
