"""Procedures: the author's function, whose signature is its parameter space."""

from shapewright.procedures.errors import Infeasible, ProcedureError
from shapewright.procedures.facts import Facts
from shapewright.procedures.loading import load_procedure
from shapewright.procedures.places import Place, describe, place_of
from shapewright.procedures.procedure import Procedure, procedure, source_digest

__all__ = [
    "Facts",
    "Infeasible",
    "Place",
    "Procedure",
    "ProcedureError",
    "describe",
    "load_procedure",
    "place_of",
    "procedure",
    "source_digest",
]
