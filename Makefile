# `make help` lists the targets. No environment has to be activated. The entry removes the variables of the
# caller's shell that could change a result (workflow/pipeline/environment/variables.py).
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
export LC_ALL := C.UTF-8
export HOME := $(shell [ -w "$${HOME:-}" ] && echo "$$HOME" || echo "$(CURDIR)/.cache")
unexport BASH_ENV ENV VIRTUAL_ENV
.DEFAULT_GOAL := help
.NOTPARALLEL:
.SILENT:
ENTRY := .venv/bin/python -I -m workflow
DEV := .venv/bin

help:  ## This list
	sed -nE 's/^([a-z -]+):.*  ## (.*)/make \1\t\2/p' Makefile | expand -t 17
	echo 'Options: QUALITY=smoke|standard|paper  PANEL=fig05  SEED=7  REPLICAS=200  ERROR=0.005  JOBS=2  DRY=yes'
	echo 'On a cluster (docs/machines.md): PROFILE=slurm  ACCOUNT=physics  PARTITION=short'
figures:  ## Build, simulate and render the paper's figures: figures/QUALITY/*.pdf, .png, .svg, .csv
panel:  ## One panel, PANEL=fig05
report:  ## The paper's statements against the results: figures/QUALITY/report.html
gallery:  ## The report of the release, docs/gallery, from the results at QUALITY
audit:  ## Check every file, and render every figure again and compare
status:  ## Current, stale (why), edited or missing files
verify:  ## Compile afresh, rerun a SAMPLE=0.1 of the results, or PANEL=fig05, and compare values
provenance:  ## Where a file comes from, FILE=figures/standard/fig05.pdf or a copy
build:  ## The programs, in build/bin
figures panel report gallery build: setup
audit status verify provenance: present
present:
	bash workflow/pipeline/environment/setup.sh if-missing
figures panel report gallery audit status verify provenance build:
	$(ENTRY) $@  # which reads PANEL=, QUALITY= and the other options from MAKEFLAGS
setup:  ## System packages, and Python packages in .venv
	bash workflow/pipeline/environment/setup.sh $(PROFILE)
setup-dev:
	bash workflow/pipeline/environment/setup.sh dev
test: setup-dev build  ## Tests; make test-long: also those that take many minutes
	bash workflow/pipeline/environment/test.sh
test-long: setup-dev build
	bash workflow/pipeline/environment/setup.sh dev slurm
	bash workflow/pipeline/environment/test.sh -m ''
check: setup-dev build  ## Format, lint, types
	git ls-files -z '*.hpp' '*.cpp' | xargs -0 $(DEV)/clang-format --dry-run --Werror
	$(DEV)/ruff check --quiet . && $(DEV)/ruff format --quiet --check . && $(DEV)/mypy --no-error-summary
	$(DEV)/snakefmt --no-format-shell --line-length 110 --check --compact-diff Snakefile
format: setup-dev  ## Format every source in place
	git ls-files -z '*.hpp' '*.cpp' | xargs -0 $(DEV)/clang-format -i
	$(DEV)/ruff check --quiet --fix . && $(DEV)/ruff format --quiet .
	$(DEV)/snakefmt --no-format-shell --line-length 110 Snakefile
.DEFAULT:
	echo '$@ is not a target; write make panel PANEL=$@, or see make help' >&2; exit 2
clean:  ## Remove build (programs, logs) and caches; results and figures stay
	rm -rf build .cache
.PHONY: help figures panel report gallery audit status verify provenance present
.PHONY: setup setup-dev build test test-long check format clean
