# `make demo` and `make test` need Python 3.11 or newer and nothing else; each makes the environment it needs.
PYTHON ?= python3
BIN := .venv/bin

.PHONY: demo test clean picture

demo: .venv/installed
	$(BIN)/shapewright demo --out demo-run

test: .venv/installed
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/pytest

.venv/installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e ".[dev]"
	touch $@

clean:
	rm -rf .venv demo-run runs

# The picture in the README: the report that `make demo` made last.
picture:
	$(BIN)/python docs/screenshot.py $$(ls -d demo-run/runs/*/ | tail -1)report.html docs/pictures/report.png
