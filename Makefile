# `make demo`, `make test` and `make test-adapters` need Python 3.11 or newer and nothing else; each makes the
# environment it needs. `make test-blender` needs Python 3.11.
PYTHON ?= python3
BIN := .venv/bin

.PHONY: demo test test-adapters test-blender page clean picture

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
EXTRAS := cadquery,build123d,openscad,points,scene-synthesizer,usd,cad,dask,slurm,remote,scale
ONLY_TESTED := pycollada ufbx meshio pyvista vedo jsonschema duckdb polars
ADAPTERS := .venv-adapters/bin/python

test-adapters: .venv-adapters/installed
	$(ADAPTERS) -m pytest tests/adapters

.venv-adapters/installed: .venv/installed Makefile
	$(BIN)/python -m venv .venv-adapters
	echo "import site; site.addsitedir('$$($(BIN)/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')')" \
	    > $$($(ADAPTERS) -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/base.pth
	$(ADAPTERS) -m pip install --quiet --disable-pip-version-check -c constraints.txt "shapewright[$(EXTRAS)]" $(ONLY_TESTED)
	touch $@

# The tests that need Blender: in an environment of its own, since its module needs numpy 1.26. Our environment runs the
# tests and that one runs Blender; then that one runs those of procedures that import bpy themselves.
BLENDER := .venv-blender/bin/python

test-blender: .venv-blender/installed
	SHAPEWRIGHT_BLENDER=$(CURDIR)/$(BLENDER) $(BIN)/pytest tests/adapters/test_blender.py
	$(BLENDER) -m pytest tests/adapters/test_bpy.py tests/adapters/test_starters.py

.venv-blender/installed: .venv/installed Makefile
	$(BIN)/python -m venv .venv-blender
	echo "import site; site.addsitedir('$$($(BIN)/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')')" \
	    > $$($(BLENDER) -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/base.pth
	$(BLENDER) -m pip install --quiet --disable-pip-version-check --ignore-installed bpy==4.5.0 "numpy<2"
	touch $@

# The studio's page; installing builds it where it is missing or older than its sources.
page: $(PAGE)

$(PAGE): .venv/installed $(PAGE_SOURCES)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps -e .

clean:
	rm -rf .venv .venv-adapters .venv-blender demo-run runs studio-page/node_modules src/shapewright/studio/page

# The picture in the README: the report that `make demo` made last.
picture:
	$(BIN)/python tools/screenshot.py $$(ls -d demo-run/runs/*/ | tail -1)report.html docs/pictures/report.png
