# `make run` and `make test` are the two commands; `make help` lists the rest.
#
# Needs python3 (3.11 or newer), make and git. Uses uv where it is on PATH, else venv and pip with the hash-checked
# requirements.lock. Both install the same versions: requirements.lock is exported from uv.lock.
#   make test PYTHON=python3.13     with another interpreter (.venv is made anew)
#   make test UV=                   with pip although uv is there

PYTHON  ?= python3
UV      ?= $(shell command -v uv 2>/dev/null)
VERSION := $(shell $(PYTHON) -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null)
VENV    := .venv
BIN     := $(VENV)/bin
STAMP   := $(VENV)/.installed-$(VERSION)

UV_SYNC  = env -u VIRTUAL_ENV UV_PROJECT_ENVIRONMENT=$(VENV) "$(UV)" sync --quiet --frozen --inexact \
           --no-build-isolation-package sched-sim --python "$$($(PYTHON) -c 'import sys; print(sys.executable)')"
PIP      = $(BIN)/python -m pip --disable-pip-version-check --quiet install
# The same packages that `uv sync --extra bench` adds, pinned with their hashes, for pip.
UNLOCK   = import tomllib; pins = {p["name"]: p for p in tomllib.load(open("uv.lock", "rb"))["package"]}; \
           [print(d["name"] + "==" + pins[d["name"]]["version"], *["--hash=" + w["hash"] for w in pins[d["name"]]["wheels"]]) \
           for d in pins["sched-sim"]["optional-dependencies"]["bench"]]
# The locks name the public index only, whatever indexes the caller has set up.
LOCK_ENV = env -u VIRTUAL_ENV -u UV_INDEX -u UV_DEFAULT_INDEX -u UV_INDEX_URL -u UV_EXTRA_INDEX_URL -u UV_FIND_LINKS \
           -u UV_NO_INDEX -u UV_CONFIG_FILE -u UV_CONSTRAINT -u UV_OVERRIDE -u UV_EXCLUDE_NEWER XDG_CONFIG_HOME=/nonexistent
LOCK_UV  = $(or $(UV),build/uv/bin/uv)

.DEFAULT_GOAL := help
.PHONY: help run publish times docs test lint types imports unit exhaust bench install lock clean

help: ## list the targets
	@sed -n 's/^\([a-z]*\):.*## /\1|/p' Makefile | while IFS='|' read -r name what; do \
		printf '  make %-8s %s\n' "$$name" "$$what"; done

run: $(STAMP) ## measure, simulate, analyse and write the first report to build/reports (all: sched-sim report --all)
	$(BIN)/sched-sim report

publish: $(STAMP) ## write all reports anew where they are kept, in reports/published
	$(BIN)/sched-sim report --all --output reports/published
	cd reports/published/embedded && cp cortex-*.toml stored-boards.csv stored-checks.csv stored-folders.csv stored-live*.csv \
		$(CURDIR)/studies/data/embedded
	cd reports/published && $(CURDIR)/$(BIN)/python -m studies.machines steffes2014/measured.toml erkf/measured-*.toml \
		modular/measured*.toml embedded/c-*.toml embedded/numba-*.toml embedded/numpy-*.toml

times: $(STAMP) ## time this machine for the reports, keep it in studies/data/measurements, write them anew with it
	$(BIN)/python -m studies.machines
	$(BIN)/python -m tests.reports.rebuild steffes2014 erkf modular

docs: $(STAMP) ## the documentation as a site, in build/docs; needs no network
	$(BIN)/sphinx-build --quiet --fail-on-warning --nitpicky --fresh-env --write-all -d build/doctrees docs build/docs
	@echo build/docs/index.html

test: $(STAMP) ## all that CI checks: the next four, two at a time, for mypy alone would leave a core idle
	@$(MAKE) --no-print-directory --jobs=2 lint types imports unit

lint: $(STAMP) ## ruff: rules and format
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(STAMP) ## mypy --strict on the four packages
	$(BIN)/mypy --strict

imports: $(STAMP) ## import-linter: who may import whom
	$(BIN)/lint-imports

# Without byte code each of the many processes compiles all that it imports anew.
unit: $(STAMP) ## pytest, the slow tests too
	env -u PYTHONDONTWRITEBYTECODE $(BIN)/python -m pytest -n 2 --dist worksteal

exhaust: $(STAMP) ## what takes too long for `make test`, with its figures (EXHAUST_SHARE=0.01: a hundredth of it)
	$(BIN)/python -m pytest -v -n 2 --dist worksteal -m exhaust

bench: $(STAMP) ## the benchmarks (installs the extra `bench`)
	@if [ -n "$(UV)" ]; then $(UV_SYNC) --extra bench; else \
		$(BIN)/python -c '$(UNLOCK)' > $(VENV)/bench.lock && \
		$(PIP) --require-hashes --only-binary :all: --no-deps -r $(VENV)/bench.lock; fi
	$(BIN)/python -m benchmarks

install: $(STAMP) ## make .venv with the project and its locked dependencies (the others do it as needed)

$(STAMP): pyproject.toml uv.lock requirements.lock
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || { echo "sched_sim needs Python 3.11 \
	or newer, and $(PYTHON) is $(or $(VERSION),not there): name another with PYTHON=, as in make run PYTHON=python3.13" \
	| tr -s '\t ' ' ' >&2; exit 1; }
	@if [ -n "$(UV)" ]; then echo "Installing into $(VENV) with uv ..."; $(UV_SYNC); else \
		echo "Installing into $(VENV) with pip ..."; \
		{ $(BIN)/python -c 'import pip, sys; sys.exit("%d.%d" % sys.version_info[:2] != "$(VERSION)")' 2>/dev/null || \
			$(PYTHON) -m venv --clear $(VENV); } && \
		$(PIP) --require-hashes --only-binary :all: -r requirements.lock && \
		$(PIP) --no-deps --no-build-isolation --editable .; fi
	@touch $@

lock: $(if $(UV),,build/uv/bin/uv) ## resolve the dependencies again (LOCK=--upgrade takes the newest)
	$(LOCK_ENV) $(LOCK_UV) lock --default-index https://pypi.org/simple --python $(PYTHON) $(LOCK)
	$(LOCK_ENV) $(LOCK_UV) export --quiet --frozen --no-emit-project --output-file requirements.lock

build/uv/bin/uv:
	$(PYTHON) -m venv build/uv
	build/uv/bin/python -m pip install --quiet uv

clean: ## remove all that make made, .venv too
	rm -rf $(VENV) build dist .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find filters reports sched_sim studies tests -name __pycache__ -type d -prune -exec rm -rf {} +
