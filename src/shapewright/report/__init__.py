"""The report of a run: one static page."""

from shapewright.report.page import write_report

__all__ = ["write_report"]
