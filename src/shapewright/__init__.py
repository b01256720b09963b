"""shapewright: find the parameters that replicate a collection of shapes, and see what the procedure cannot make."""

import importlib
from typing import TYPE_CHECKING, Any

from shapewright.parameters import Binary, Choice, Integer, ParameterSpace, Range, Scalar, Seed, When
from shapewright.procedures import Infeasible, Procedure, ProcedureError, load_procedure, procedure
from shapewright.settings import Settings
from shapewright.shapes import Drawing, Mesh, Points, Transform, View, Views
from shapewright.shapes.conversion import register

if TYPE_CHECKING:
    from shapewright.comparison import light_field, outline
    from shapewright.feedback.explanation import explain
    from shapewright.fitting.evaluation import evaluate
    from shapewright.fitting.fit import fit
    from shapewright.fitting.learning import train
    from shapewright.fitting.samples import sample
    from shapewright.judging.judge import fidelity
    from shapewright.judging.verdict import Verdict
    from shapewright.prediction.predictor import Predictor
    from shapewright.references import Collection, CollectionError, Reference
    from shapewright.report.page import write_report
    from shapewright.rules.rule import rule
    from shapewright.runs.changes import compare
    from shapewright.runs.iteration import Iteration
    from shapewright.survey.survey import Survey, check

# An author's file imports this package in every worker process: what loads torch or numba is loaded when first used.
_ON_FIRST_USE = {
    "check": "shapewright.survey.survey",
    "Survey": "shapewright.survey.survey",
    "compare": "shapewright.runs.changes",
    "evaluate": "shapewright.fitting.evaluation",
    "explain": "shapewright.feedback.explanation",
    "fidelity": "shapewright.judging.judge",
    "fit": "shapewright.fitting.fit",
    "light_field": "shapewright.comparison",
    "outline": "shapewright.comparison",
    "Iteration": "shapewright.runs.iteration",
    "Verdict": "shapewright.judging.verdict",
    "Predictor": "shapewright.prediction.predictor",
    "rule": "shapewright.rules.rule",
    "sample": "shapewright.fitting.samples",
    "train": "shapewright.fitting.learning",
    "write_report": "shapewright.report.page",
    "Collection": "shapewright.references",
    "CollectionError": "shapewright.references",
    "Reference": "shapewright.references",
}


def __getattr__(name: str) -> Any:
    if name not in _ON_FIRST_USE:
        raise AttributeError(f"module 'shapewright' has no attribute {name!r}")
    home = _ON_FIRST_USE[name]
    if home == "shapewright.comparison":
        return importlib.import_module(f"{home}.{name}")
    return getattr(importlib.import_module(home), name)


__all__ = [
    "Binary",
    "Choice",
    "Collection",
    "CollectionError",
    "Drawing",
    "Infeasible",
    "Integer",
    "Iteration",
    "Mesh",
    "ParameterSpace",
    "Points",
    "Predictor",
    "Procedure",
    "ProcedureError",
    "Range",
    "Reference",
    "Scalar",
    "Seed",
    "Settings",
    "Survey",
    "Transform",
    "Verdict",
    "View",
    "Views",
    "When",
    "check",
    "compare",
    "evaluate",
    "explain",
    "fidelity",
    "fit",
    "light_field",
    "load_procedure",
    "outline",
    "procedure",
    "register",
    "rule",
    "sample",
    "train",
    "write_report",
]
