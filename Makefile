# `make help` lists the targets. No environment has to be activated, and no variable of the caller's shell changes a result.
QUALITY := standard
SAMPLE := 0.1
BATCH = $(if $(PROFILE),30)
OPTIONS := PANEL FRESH SEED REPLICAS ERROR HOURS JOBS DRY FILE FULL PROFILE BATCH ACCOUNT PARTITION
KNOWN := QUALITY SAMPLE $(OPTIONS) CXX

$(foreach name,$(OPTIONS),$(if $(filter environment,$(origin $(name))),$(eval $(name) :=)))
nearest = $(shell python3 -c 'import difflib, sys; print(*difflib.get_close_matches(sys.argv[1], sys.argv[2:], 1, 0))' $1)
upper = $(shell printf %s '$1' | tr a-z A-Z)
$(foreach name,$(filter-out $(KNOWN),$(foreach one,$(.VARIABLES),$(if $(filter command,$(origin $(one))),$(one)))),\
  $(error $(name) is not an option; did you mean $(call nearest,$(call upper,$(name)) $(KNOWN))?))
$(foreach name,FRESH FULL DRY,$(if $(filter-out yes no,$(subst $() ,_,$($(name)))),$(error $(name)=$($(name)) is invalid; give $(name)=yes, or leave it out)))
$(foreach name,FRESH FULL DRY,$(eval override $(name) := $(filter yes,$($(name)))))
digits = $(subst 9,,$(subst 8,,$(subst 7,,$(subst 6,,$(subst 5,,$(subst 4,,$(subst 3,,$(subst 2,,$(subst 1,,$(subst 0,,$1))))))))))
$(foreach name,JOBS BATCH,$(if $($(name)),$(if $(call digits,$($(name)))$(filter 0%,$($(name))),$(error $(name)=$($(name)) is invalid; give a whole number of at least 1))))
$(if $(filter figures report gallery,$(MAKECMDGOALS)),$(if $(PANEL),$(error PANEL has no effect on this target; try make panel PANEL=$(PANEL))))
PROFILES := $(notdir $(wildcard profiles/*))
$(if $(PROFILE),$(if $(filter $(PROFILE),$(PROFILES)),,$(error $(PROFILE) is not a profile; did you mean $(call nearest,$(PROFILE) $(PROFILES))?)))
$(if $(PROFILE),$(if $(shell grep -x 'executor: slurm' 'profiles/$(PROFILE)/config.yaml'),$(if $(shell command -v sbatch),,\
  $(error sbatch is not in PATH, so that no job can be submitted to Slurm; run make on a login node))))
$(if $(filter panel,$(MAKECMDGOALS)),$(if $(PANEL),,$(error PANEL is missing; try make panel PANEL=fig05)))
$(if $(filter provenance,$(MAKECMDGOALS)),$(if $(FILE),,$(error FILE is missing; try make provenance FILE=figures/standard/fig05.pdf)))

SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.NOTPARALLEL:
.SILENT:

export BASH_ENV := workflow/environment/variables.sh
unexport POSIXLY_CORRECT SHELLOPTS # with which bash does not read BASH_ENV

EFFORT := $(QUALITY)$(SEED:%=_seed=%)$(REPLICAS:%=_replicas=%)$(ERROR:%=_error=%)$(HOURS:%=_hours=%)
PYTHON := .venv/bin/python -m
LOCKED := bash workflow/environment/one_at_a_time.sh
OF := --quality '$(EFFORT)' $(foreach panel,$(PANEL),--panel='$(panel)')
SNAKEMAKE := $(LOCKED) $(PYTHON) snakemake --nolock $(if $(FRESH),--forceall) $(if $(DRY),--dry-run) \
  $(if $(PROFILE),--workflow-profile 'profiles/$(PROFILE)' $(JOBS:%=--jobs '%'),$(JOBS:%=--cores '%')) \
  $(if $(ACCOUNT)$(PARTITION),--default-resources $(ACCOUNT:%=slurm_account='%') $(PARTITION:%=slurm_partition='%')) \
  --config quality='$(EFFORT)' $(if $(PANEL),panel='$(PANEL)') $(BATCH:%=batch='%') --
COMPARE := $(if $(SEED)$(REPLICAS)$(ERROR)$(FRESH),$(PYTHON) workflow.provenance.compare $(OF))
ESTIMATE := $(if $(ERROR),$(PYTHON) workflow.cluster.cost $(OF))
REACHED := $(if $(ERROR),$(PYTHON) workflow.provenance.errors $(OF))
# Snakemake's line on the profile in use is the same in every run.
BRIEF := 2> >(trap '' INT TERM; grep --line-buffered -v '^Using workflow specific profile' >&2)
# Makes a target of Snakemake and prints a line; with DRY=yes prints the files that would be made.
define MAKE_TARGET
$(if $(DRY),,$(ESTIMATE))
$(if $(DRY),,$(if $(FRESH),$(COMPARE) --keep))
$(SNAKEMAKE) $1 $(BRIEF) $(if $(DRY),| sed -nE 's/^ *output: //p; /^Nothing/p')
$(if $(DRY),,$(if $(filter figures panel,$1),$(COMPARE)))
$(if $(DRY),,$(if $(filter figures panel,$1),$(REACHED)))
$(if $(DRY),,echo '$2')
endef

help:  ## This list
	sed -nE 's/^([a-z -]+):.*  ## (.*)/make \1\t\2/p' Makefile | expand -t 17
	echo 'Options: QUALITY=smoke|standard|paper|deep  PANEL=fig05  FRESH=yes  SEED=7  REPLICAS=200  JOBS=2  DRY=yes'
	echo 'Effort by error: ERROR=0.005, the relative standard error of the target quantity of every run; HOURS=2 bounds the time'
	echo 'On a cluster (docs/cluster.md): PROFILE=slurm  BATCH=30  ACCOUNT=physics  PARTITION=short'
figures: build  ## Build, simulate and render every figure: figures/QUALITY/*.pdf, .png, .svg, .csv
	$(call MAKE_TARGET,figures,The figures are in figures/$(EFFORT). Next: make report)
panel: build  ## One panel, PANEL=fig05; FRESH=yes: rerun from scratch and compare
	$(call MAKE_TARGET,panel,In figures/$(EFFORT): $(PANEL:%=%.pdf) and .png .svg .csv)
report: build  ## The paper's claims against the results: figures/QUALITY/report.html
	$(call MAKE_TARGET,report,The report is figures/$(EFFORT)/report.html)
gallery: build  ## docs/gallery and the answer in README.md, from the results at QUALITY
	$(call MAKE_TARGET,gallery,The gallery is docs/gallery)
setup:  ## System packages, and Python packages in .venv
	$(LOCKED) bash workflow/environment/setup.sh
setup-dev:
	$(LOCKED) bash workflow/environment/setup.sh dev
installed:
	test -x .venv/bin/python && test -e .venv/complete || $(LOCKED) bash workflow/environment/setup.sh
build: setup  ## The programs, in build/bin
	$(LOCKED) bash workflow/environment/build.sh all
audit: installed  ## Check every result and figure against sources, parameters, build and packages
	$(PYTHON) workflow.provenance.audit $(OF)
verify: setup  ## Compile afresh, rerun a SAMPLE=0.1 of the results, or PANEL=fig05, and compare bytes
	$(PYTHON) workflow.provenance.verify $(OF) --sample $(SAMPLE)
provenance: installed  ## Where a file comes from, FILE=figures/standard/fig05.pdf or a copy; FULL=yes
	$(PYTHON) workflow.provenance.tree $(if $(FULL),--full) -- "$(FILE)"
status: installed  ## Fresh, stale (why) or missing; errors; CPU time
	$(PYTHON) workflow.provenance.status $(OF)
cost: installed  ## Estimated CPU time of a quality, or of PANEL=fig05
	$(PYTHON) workflow.cluster.cost $(OF) $(BATCH:%=--batch=%)
crate: build  ## Figures, data, code and history as an RO-Crate in build/crate; PANEL=fig05
	$(call MAKE_TARGET,crate,The crate is in build/crate)
prune: build  ## Remove a quality's results and figures that no plan names, of former options or builds; DRY=yes: list
	$(LOCKED) $(PYTHON) workflow.provenance.obsolete $(OF) $(if $(DRY),--dry)
test: setup-dev  ## Tests; make test-long: also those that take many minutes
	bash workflow/environment/test.sh -m 'not long'
test-long: setup-dev
	bash workflow/environment/test.sh
check: setup-dev build docs  ## Format, lint, types, documentation
	git ls-files -z '*.hpp' '*.cpp' | xargs -0 .venv/bin/clang-format --dry-run --Werror
	.venv/bin/ruff check --quiet . && .venv/bin/ruff format --quiet --check . && .venv/bin/mypy --no-error-summary
	.venv/bin/snakefmt --no-format-shell --line-length 110 --check --compact-diff Snakefile workflow/rules
	.venv/bin/actionlint
format: setup-dev  ## Format every source in place
	git ls-files -z '*.hpp' '*.cpp' | xargs -0 .venv/bin/clang-format -i
	.venv/bin/ruff check --quiet --fix . && .venv/bin/ruff format --quiet .
	.venv/bin/snakefmt --no-format-shell --line-length 110 Snakefile workflow/rules
bench: setup-dev build  ## Cost of an event
	$(PYTHON) workflow.tradeoff.bench
tradeoff: setup-dev build  ## Accuracy against time, and rounding: figures/tradeoff
	$(SNAKEMAKE) tradeoff $(BRIEF)
docs: setup-dev build  ## The documentation as a static site, build/docs/index.html
	NO_MKDOCS_2_WARNING=1 .venv/bin/mkdocs build --strict 2> >(grep -v '^INFO' >&2)
	doxygen docs/site/Doxyfile
	cp .venv/lib/python*/site-packages/mathjax/static/mathjax/es5/tex-svg.js build/docs/mathjax.js
clean:  ## Remove programs, logs and caches; make distclean: also results, figures and .venv
	$(LOCKED) rm -rf build .cache
distclean: clean
	rm -rf data/*/ figures/*/ .snakemake .venv
.PHONY: help figures panel report gallery setup setup-dev installed build audit verify provenance status cost crate prune test test-long \
  check format bench tradeoff docs clean distclean
