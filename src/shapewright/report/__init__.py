"""The report of an iteration: one static page."""

from shapewright.report.comparison import Comparison, Move, compare
from shapewright.report.report import write_report

__all__ = ["Comparison", "Move", "compare", "write_report"]
