"""Procedures: the author's function, whose signature is its parameter space."""

from shapewright.procedures.procedure import (
    Infeasible,
    Procedure,
    ProcedureError,
    author_line,
    load_procedure,
    procedure,
)

__all__ = ["Infeasible", "Procedure", "ProcedureError", "author_line", "load_procedure", "procedure"]
