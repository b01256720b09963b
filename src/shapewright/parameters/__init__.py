"""Parameters: four kinds, the ordered space of them, what is likely of them, and their form in files."""

from shapewright.parameters.kinds import (
    Binary,
    Choice,
    Integer,
    Parameter,
    Parameters,
    Range,
    Scalar,
    Seed,
    Side,
    Value,
    When,
    whole_number,
)
from shapewright.parameters.prediction import Prediction
from shapewright.parameters.records import from_record, to_record
from shapewright.parameters.space import End, Excess, ParameterSpace

__all__ = [
    "Binary",
    "Choice",
    "End",
    "Excess",
    "Integer",
    "Parameter",
    "ParameterSpace",
    "Parameters",
    "Prediction",
    "Range",
    "Scalar",
    "Seed",
    "Side",
    "Value",
    "When",
    "from_record",
    "to_record",
    "whole_number",
]
