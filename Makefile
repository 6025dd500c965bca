# `make help` lists the targets. No environment has to be activated, and no variable of the caller's shell changes a result.

QUALITY := standard
SAMPLE := 0.1
OPTIONS := QUALITY PANEL JOBS FRESH SEED REPLICAS FILE FULL SAMPLE PROFILE BATCH ACCOUNT PARTITION CXX

GIVEN := $(foreach name,$(.VARIABLES),$(if $(filter command%,$(origin $(name))),$(name)))
nearest = $(shell python3 -c 'import difflib, sys; print(*difflib.get_close_matches(sys.argv[1].upper(), sys.argv[2:], 1, 0))' $1 $2)
$(foreach name,$(filter-out $(OPTIONS),$(GIVEN)),$(error $(name) is not an option; did you mean $(call nearest,$(name),$(OPTIONS))?))

SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.NOTPARALLEL:
.SILENT:

export LC_ALL := C.UTF-8
export TZ := UTC
export SOURCE_DATE_EPOCH := 1230768000
export PYTHONHASHSEED := 0
export PYTHONSAFEPATH := 1
export PYTHONNOUSERSITE := 1
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1
export MPLBACKEND := Agg
export MPLCONFIGDIR := $(CURDIR)/.cache/matplotlib
unexport PYTHONPATH PYTHONHOME CFLAGS CXXFLAGS CPPFLAGS LDFLAGS CPATH C_INCLUDE_PATH CPLUS_INCLUDE_PATH LIBRARY_PATH \
  MATPLOTLIBRC SNAKEMAKE_PROFILE HDF5_PLUGIN_PATH VIRTUAL_ENV
ifneq ($(shell test -w "$$HOME" || echo no),) # containers whose user has no home
  export HOME := $(CURDIR)/.cache/home
endif

EFFORT := $(QUALITY)$(if $(SEED),_seed=$(SEED))$(if $(REPLICAS),_replicas=$(REPLICAS))
PYTHON := .venv/bin/python -m
SNAKEMAKE = bash workflow/environment/one_at_a_time.sh .venv/bin/snakemake --nolock \
  $(if $(PROFILE),--workflow-profile profiles/$(PROFILE) $(if $(JOBS),--jobs $(JOBS)),$(if $(JOBS),--cores $(JOBS))) \
  $(if $(ACCOUNT)$(PARTITION),--default-resources $(ACCOUNT:%=slurm_account=%) $(PARTITION:%=slurm_partition=%)) \
  $(if $(FRESH),--forceall) --config quality=$(EFFORT) $(PANEL:%=panel=%) $(BATCH:%=batch=%) --
COMPARE := $(if $(SEED)$(REPLICAS)$(FRESH),$(PYTHON) workflow.provenance.compare --quality $(EFFORT) $(PANEL:%=--panel=%))
IN_PLACE = [ -d "$${HOME}" ] || mkdir -p "$${HOME}"

help:  ## This list
	sed -nE 's/^([a-z-]+):.*  ## (.*)/make \1\t\2/p' Makefile | expand -t 17
	echo 'Options: QUALITY=smoke|standard|paper|deep  PANEL=fig05  FRESH=yes  SEED=7  REPLICAS=200  JOBS=2'
	echo 'On a cluster (docs/cluster.md): PROFILE=slurm  BATCH=30  ACCOUNT=physics  PARTITION=short'

figures: build  ## Build, simulate and draw every figure into figures/QUALITY
	$(if $(FRESH),$(COMPARE) --keep)
	$(SNAKEMAKE) figures
	$(COMPARE)
	echo 'The figures are in figures/$(EFFORT). Next: make report'

panel: build  ## One panel, PANEL=fig05; with FRESH=yes rerun from scratch and compared
	$(if $(PANEL),,echo 'PANEL is missing; try make panel PANEL=fig05' >&2; exit 2)
	$(if $(FRESH),$(COMPARE) --keep)
	$(SNAKEMAKE) panel
	$(COMPARE)
	echo 'The panel is figures/$(EFFORT)/$(PANEL).pdf, .png, .svg and .csv'

report: figures  ## The paper's claims against the results: figures/QUALITY/report.html
	$(PYTHON) workflow.report.write --quality $(EFFORT)

gallery: setup  ## docs/gallery and the answer in README.md from the best results that are here
	$(PYTHON) workflow.report.gallery --quality $(EFFORT)

setup:  ## System packages and .venv
	bash workflow/environment/system_packages.sh
	bash workflow/environment/python.sh --no-dev

setup-dev:
	bash workflow/environment/system_packages.sh dev
	bash workflow/environment/python.sh

build: setup  ## The programs, in build/bin
	bash workflow/environment/build.sh all

audit: installed  ## Check every result and figure against its sources, parameters, build and packages; PANEL=fig05
	$(PYTHON) workflow.provenance.audit --quality $(EFFORT) $(PANEL:%=--panel=%)

verify: build  ## Rerun a SAMPLE=0.1 of the results, or PANEL=fig05, with a fresh build and compare bytes
	$(PYTHON) workflow.provenance.verify --quality $(EFFORT) --sample $(SAMPLE) $(PANEL:%=--panel=%)

provenance: installed  ## Where a file comes from, FILE=figures/standard/fig05.pdf or a copy of it; FULL=yes
	$(if $(FILE),,echo 'FILE is missing; try make provenance FILE=figures/standard/fig05.pdf' >&2; exit 2)
	$(PYTHON) workflow.provenance.tree $(FULL:yes=--full) -- "$(FILE)"

status: installed  ## Fresh, stale (why) or missing; errors reached, CPU time
	$(PYTHON) workflow.provenance.status --quality $(EFFORT)

cost: installed  ## Estimated CPU time of a quality, or of PANEL=fig05
	$(PYTHON) workflow.cluster.cost --quality $(EFFORT) $(PANEL:%=--panel=%) $(BATCH:%=--batch=%)

crate: installed  ## Figures, data, code and their history as an RO-Crate in build/crate; PANEL=fig05
	$(PYTHON) workflow.provenance.crate --quality $(EFFORT) $(PANEL:%=--panel=%)

test test-long: setup-dev  ## All tests; test-long also those that take minutes
	bash workflow/environment/build.sh all cpp_tests
	ctest --test-dir build --output-on-failure --parallel 2 --no-tests=error --quiet --output-log build/ctest.log || { cat build/ctest.log; exit 1; }
	tail -n 4 build/ctest.log
	$(PYTHON) pytest -n 2 --dist loadfile $(if $(filter test,$@),-m 'not long')

check: setup-dev build  ## Format, lint, types, docs
	git ls-files -z '*.hpp' '*.cpp' | xargs -0 .venv/bin/clang-format --dry-run --Werror
	.venv/bin/ruff check --quiet . && .venv/bin/ruff format --quiet --check .
	.venv/bin/mypy --no-error-summary
	.venv/bin/snakefmt --no-format-shell --line-length 110 --check --compact-diff Snakefile workflow/rules
	.venv/bin/snakemake --lint
	$(MAKE) docs
