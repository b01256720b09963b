"""Procedures: the author's function, whose signature is its parameter space."""

from shapewright.procedures.errors import Infeasible, ProcedureError
from shapewright.procedures.facts import Facts
from shapewright.procedures.loading import load_procedure
from shapewright.procedures.places import Place, describe, place_of
from shapewright.procedures.procedure import Procedure, procedure
from shapewright.procedures.texts import BINARY, FOREIGN, is_foreign, source_digest, text_of

__all__ = [
    "BINARY",
    "FOREIGN",
    "Facts",
    "Infeasible",
    "Place",
    "Procedure",
    "ProcedureError",
    "describe",
    "is_foreign",
    "load_procedure",
    "place_of",
    "procedure",
    "source_digest",
    "text_of",
]
