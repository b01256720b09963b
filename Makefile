# `make demo`, `make test` and `make test-adapters` need Python 3.11 or newer and nothing else; each makes the
# environment it needs.
PYTHON ?= python3
BIN := .venv/bin

.PHONY: demo test test-adapters page clean picture

PAGE := src/shapewright/studio/page/index.html
PAGE_SOURCES := $(shell find studio-page -type f -not -path '*/node_modules/*')

demo: .venv/installed
	$(BIN)/shapewright demo --out demo-run

test: .venv/installed $(PAGE)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/pytest

.venv/installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e ".[dev]"
	touch $@

# The tests that need the libraries of extras. Their environment sees all that .venv holds and adds only these libraries:
# the extras of shapewright, and what only tests need.
EXTRAS := cadquery,build123d,openscad,points,scene-synthesizer,usd,cad
ONLY_TESTED := pycollada ufbx meshio pyvista vedo jsonschema
ADAPTERS := .venv-adapters/bin/python

test-adapters: .venv-adapters/installed
	$(ADAPTERS) -m pytest tests/adapters

.venv-adapters/installed: .venv/installed Makefile
	$(BIN)/python -m venv .venv-adapters
	echo "import site; site.addsitedir('$$($(BIN)/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')')" \
	    > $$($(ADAPTERS) -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/base.pth
	$(ADAPTERS) -m pip install --quiet --disable-pip-version-check -c constraints.txt "shapewright[$(EXTRAS)]" $(ONLY_TESTED)
	touch $@

# The studio's page; installing builds it where it is missing or older than its sources.
page: $(PAGE)

$(PAGE): .venv/installed $(PAGE_SOURCES)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps -e .

clean:
	rm -rf .venv .venv-adapters demo-run runs studio-page/node_modules src/shapewright/studio/page

# The picture in the README: the report that `make demo` made last.
picture:
	$(BIN)/python tools/screenshot.py $$(ls -d demo-run/runs/*/ | tail -1)report.html docs/pictures/report.png
