# Front door. `make help` lists what it can do.
#
# Every recipe runs in an environment of its own: .SHELLFLAGS below starts it with nothing but what is
# named there, so no variable of the caller's shell changes a result. Options are arguments of make; they are
# text, in which neither make nor the shell expands anything.

QUALITY := standard
JOBS := $(shell nproc 2>/dev/null || sysctl -n hw.ncpu)
PANEL :=
FRESH :=
FILE :=
SAMPLE := 0.1

$(foreach name,$(.VARIABLES),$(if $(filter command,$(origin $(name))),$(eval override $(name) := $$(value $(name)))))
quote = '$(subst ','\'',$1)'

.DEFAULT_GOAL := help
.NOTPARALLEL:
.SILENT:
.DELETE_ON_ERROR:
MAKEFLAGS += --no-builtin-rules

# What reaches the network only; the locks' hashes vouch for the content.
NETWORK := PIP_INDEX_URL PIP_EXTRA_INDEX_URL PIP_TRUSTED_HOST PIP_CERT PIP_CONFIG_FILE PIP_FIND_LINKS \
  PIP_DEFAULT_TIMEOUT SSL_CERT_FILE http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY
SHELL := /usr/bin/env
.SHELLFLAGS := -i HOME=$(call quote,$(value HOME)) PATH=/opt/homebrew/bin:/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin \
  LC_ALL=C.UTF-8 TZ=UTC SOURCE_DATE_EPOCH=1230768000 \
  PYTHONHASHSEED=0 PYTHONNOUSERSITE=1 PYTHONDONTWRITEBYTECODE=1 PYTHONUNBUFFERED=1 \
  OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MPLBACKEND=Agg MPLCONFIGDIR=.cache/matplotlib \
  XDG_CACHE_HOME=.cache $(foreach name,$(NETWORK),$(if $(value $(name)),$(name)=$(call quote,$(value $(name))))) \
  /bin/bash -euo pipefail -c

PYTHON := .venv/bin/python
SNAKEMAKE := $(PYTHON) -m snakemake --cores $(call quote,$(JOBS)) --config quality=$(call quote,$(QUALITY))
SNAKEFMT := .venv/bin/snakefmt --no-format-shell --line-length 110
ONLY_PANEL := $(if $(PANEL),--panel $(call quote,$(PANEL)))
FORCE := $(if $(FRESH),--forcerun simulate)

.PHONY: help figures panel build test check format describe reference lock audit verify provenance status \
  crate bench tradeoff clean
help:  ## This list
	sed -nE 's/^([a-z]+):.*  ## (.*)/make \1\t\2/p' Makefile | expand -t 16
	echo 'Options: QUALITY=smoke|standard|paper|deep  PANEL=fig05  FRESH=1  JOBS=2'

figures: build .venv/runtime  ## Build, simulate and draw every figure into figures/QUALITY
	$(SNAKEMAKE) $(FORCE) -- figures
	echo Figures are in $(call quote,figures/$(QUALITY))

panel: build .venv/runtime  ## The same for one panel, PANEL=fig05; FRESH=1 simulates it anew
	$(if $(PANEL),,echo 'make panel: PANEL is missing; try make panel PANEL=fig05'; exit 2)
	$(SNAKEMAKE) $(FORCE) -- $(call quote,figures/$(QUALITY)/$(PANEL).pdf)
	echo The panel is $(call quote,figures/$(QUALITY)/$(PANEL).pdf), .png, .svg and .csv

crate: build .venv/runtime  ## Figures, data, code and runs as an RO-Crate in build/crate; PANEL=fig05 packs one panel
	$(PYTHON) -m workflow.provenance.crate --quality $(call quote,$(QUALITY)) $(ONLY_PANEL)

build: build/system-packages  ## The executables in build/bin
	grep -qsxF $(call quote,CMAKE_HOME_DIRECTORY:INTERNAL=$(CURDIR)/cpp) build/CMakeCache.txt || \
	  rm -rf build/CMakeCache.txt build/CMakeFiles build/build.ninja
	test -f build/build.ninja || cmake -S cpp -B build -G Ninja >build/cmake.log || { cat build/cmake.log; exit 1; }
	ninja -C build --quiet

test: build .venv/runtime .venv/dev  ## All tests; ends with the count
	ninja -C build --quiet cpp_tests
	$(PYTHON) -m tests.run

check: build .venv/runtime .venv/dev reference  ## Format, lint and reference
	git ls-files -z '*.hpp' '*.cpp' | xargs -0 .venv/bin/clang-format --dry-run --Werror
	.venv/bin/ruff check --quiet . && .venv/bin/ruff format --quiet --check .
	$(SNAKEFMT) --check --compact-diff Snakefile workflow/rules
	$(SNAKEMAKE) --lint

format: .venv/dev  ## Format every source in place
	git ls-files -z '*.hpp' '*.cpp' | xargs -0 .venv/bin/clang-format -i
	.venv/bin/ruff check --quiet --fix . && .venv/bin/ruff format --quiet .
	$(SNAKEFMT) Snakefile workflow/rules

describe: build .venv/runtime  ## State the programs' options and quantities in schema.yaml and docs/format.*
	$(PYTHON) -m workflow.config.describe

audit: .venv/runtime  ## Check every link from the sources to the figures; PANEL=fig05 draws only that again
	$(PYTHON) -m workflow.provenance.audit --quality $(call quote,$(QUALITY)) $(ONLY_PANEL)

verify: build .venv/runtime  ## Make a sample of the products again and compare; SAMPLE=0.1 PANEL=fig05
	$(PYTHON) -m workflow.provenance.verify --quality $(call quote,$(QUALITY)) --sample $(call quote,$(SAMPLE)) $(ONLY_PANEL)

provenance: .venv/runtime  ## What a product was made from, FILE=figures/standard/fig05.pdf or a copy of it
	$(if $(FILE),,echo 'make provenance: FILE is missing; try make provenance FILE=figures/standard/fig05.pdf'; exit 2)
	$(PYTHON) -m workflow.provenance.tree -- $(call quote,$(FILE))

status: build .venv/runtime  ## Which panels are fresh, their errors and what they cost
	$(PYTHON) -m workflow.provenance.status --quality $(call quote,$(QUALITY))

bench: build .venv/runtime  ## Cost of an event: engine, reference and floor side by side; programs and bare loops
	ninja -C build --quiet benchmarks
	build/bin/benchmarks --benchmark_repetitions=3 --benchmark_enable_random_interleaving=true \
	  --benchmark_report_aggregates_only=true --benchmark_out=build/bench.json
	$(PYTHON) -m workflow.tradeoff.bench_table build/bench.json
	$(PYTHON) -m workflow.tradeoff.bench_programs --programs build/bin

tradeoff: build .venv/runtime  ## Speed against accuracy, measured here: figures/tradeoff
	ninja -C build --quiet reference_pulse reference_open_chain reference_drift
	$(PYTHON) -m workflow.tradeoff.kinetic --programs build/bin --output figures/tradeoff/ext06_kinetic
	$(PYTHON) -m workflow.tradeoff.accuracy --programs build/bin --output figures/tradeoff/ext06
	$(PYTHON) -m workflow.tradeoff.efficiency --programs build/bin --output figures/tradeoff/ext06_efficiency
	$(PYTHON) -m workflow.tradeoff.bias --programs build/bin --output figures/tradeoff/ext06_bias
	$(PYTHON) -m workflow.tradeoff.precision --programs build/bin --output figures/tradeoff/ext06_precision
	$(PYTHON) -m workflow.tradeoff.prediction --programs build/bin --output figures/tradeoff/ext06_prediction
	$(PYTHON) -m workflow.tradeoff.extremes --programs build/bin --quality $(call quote,$(QUALITY)) --output figures/tradeoff/ext08

reference: build/system-packages .venv/dev  ## C++ and Python reference in build/reference; any warning is an error
	mkdir -p build/reference
	doxygen docs/Doxyfile
	PDOC_ALLOW_EXEC=1 $(PYTHON) -W error::UserWarning -m pdoc -o build/reference/python \
	  $$(git ls-files 'workflow/*.py' | sed 's|/|.|g; s|\.py$$||')

lock: .venv/dev  ## Renew both locks of Python packages
	for name in requirements requirements-dev; do \
	  .venv/bin/uv pip compile --quiet --no-header --no-annotate --upgrade --generate-hashes --universal \
	    --python-version 3.11 workflow/environment/$$name.in -o $$name.lock; \
	done

clean:  ## Remove what can be made again, results included
	rm -rf build data/*/ figures/*/ .snakemake .cache

build/system-packages: workflow/environment/system_packages.sh
	mkdir -p build
	bash workflow/environment/system_packages.sh
	touch $@

.venv/runtime: requirements.lock build/system-packages
	echo 'Installing Python packages of requirements.lock into .venv'
	test -x $(PYTHON) || python3 -m venv .venv
	$(PYTHON) -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.lock
	touch $@

.venv/dev: requirements-dev.lock .venv/runtime
	echo 'Installing Python packages of requirements-dev.lock into .venv'
	$(PYTHON) -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements-dev.lock
	touch $@
