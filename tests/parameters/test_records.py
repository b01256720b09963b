import json

import pytest

from shapewright.parameters import Binary, Choice, Integer, Scalar, from_record, to_record


@pytest.mark.parametrize(
    "parameter",
    [
        Scalar("s", 0.5, 1.0, 0.7, 8),
        Scalar("bed", 0.9, 1.8, 0.9, (0.9, 1.4, 1.8)),
        Scalar("free", -1.0, 1.0, 0.0),
        Integer("n", 0, 3, 0),
        Choice("c", ("a", "b"), "b"),
        Binary("b", False),
    ],
)
def test_a_parameter_survives_json(parameter):
    record = json.loads(json.dumps(to_record(parameter)))
    assert from_record(record) == parameter
    assert set(record) == {"kind", "name", "low", "high", "steps", "options", "default"}
