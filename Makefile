# Front door. `make help` lists what it can do.
#
# Every recipe runs in an environment of its own: .SHELLFLAGS below starts it with nothing but what is
# named there, so no variable of the caller's shell changes a result. Options are arguments of make. Their values are
# checked before anything else happens, and are text, in which neither make nor the shell expands anything; only what make
# itself executes before it reads a Makefile (PANEL!=..., a variable's name that expands, --eval) is beyond any Makefile.

$(if $(wildcard workflow/environment/arguments.py),,$(error run make in the project's folder, or make -C FOLDER))
override GIVEN := $(foreach name,$(.VARIABLES),$(if $(filter command,$(origin $(name))),$(name)))
$(foreach name,$(GIVEN),$(eval override $(name) := $$(value $(name))))

# The shell that checks the arguments would read one of them up to its first line break only.
override define newline


endef
$(if $(findstring $(newline),$(MAKECMDGOALS)$(foreach name,$(GIVEN),$(value $(name)))),$(error no argument may hold a line break))

QUALITY := standard
JOBS :=
PANEL :=
FRESH :=
FULL :=
FILE :=
CRATE :=
SEED :=
REPLICAS :=
PROFILE :=
BATCH := 30
ACCOUNT :=
PARTITION :=
SAMPLE := 0.1
SECONDS := 60

override quote = '$(subst ','\'',$1)'

.DEFAULT_GOAL := help
.NOTPARALLEL:
.SILENT:
.DELETE_ON_ERROR:
MAKEFLAGS += --no-builtin-rules

# What reaches the network only; the locks' hashes vouch for the content.
NETWORK := PIP_INDEX_URL PIP_EXTRA_INDEX_URL PIP_TRUSTED_HOST PIP_CERT PIP_CONFIG_FILE PIP_FIND_LINKS \
  PIP_DEFAULT_TIMEOUT SSL_CERT_FILE http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY
override SHELL := /usr/bin/env
override .SHELLFLAGS := -i HOME=$(call quote,$(value HOME)) PATH=/opt/homebrew/bin:/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin \
  LC_ALL=C.UTF-8 TZ=UTC SOURCE_DATE_EPOCH=1230768000 \
  PYTHONHASHSEED=0 PYTHONSAFEPATH=1 PYTHONNOUSERSITE=1 PYTHONDONTWRITEBYTECODE=1 PYTHONUNBUFFERED=1 \
  OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MPLBACKEND=Agg MPLCONFIGDIR=.cache/matplotlib \
  XDG_CACHE_HOME=$(call quote,$(CURDIR)/.cache) $(foreach name,$(NETWORK),$(if $(value $(name)),$(name)=$(call quote,$(value $(name))))) \
  /bin/bash -euo pipefail -c

# What would change results or hide failures without a word.
override FLAGS := $(filter-out -%,$(firstword $(MAKEFLAGS)))
$(if $(findstring e,$(FLAGS)),$(error make -e is not admitted: variables of the environment would change results))
$(if $(findstring i,$(FLAGS)),$(error make -i is not admitted: it would hide failures))
$(if $(findstring t,$(FLAGS))$(findstring q,$(FLAGS)),$(error make -t and -q are not admitted: they would do nothing, without a word))
$(if $(findstring --eval,$(MAKEFLAGS))$(MAKEFILES),$(error make --eval and MAKEFILES are not admitted: they would change results))
# Of -o and -W, with which a goal would be left out, make tells a Makefile nothing; the system does.
override WORDS := $(shell tr '\0' '\n' </proc/$$PPID/cmdline 2>/dev/null | grep -Em1 '^(-[BbdeiknpqrRsStvw]*[oW]|--(old|new|assume|what))' || true)
$(if $(WORDS),$(error make -o and -W are not admitted: they would leave out what is to be done, without a word))
override CHECK := python3 -I workflow/environment/arguments.py $(foreach goal,$(MAKECMDGOALS),$(call quote,$(goal))) \
  $(foreach name,$(GIVEN),$(call quote,$(name)=$(value $(name))))
override FAULT := $(if $(GIVEN),$(shell $(CHECK)))
$(if $(FAULT),$(error $(FAULT)))
$(if $(and $(GIVEN),$(filter-out 0,$(.SHELLSTATUS))),$(error the arguments cannot be checked: python3 is needed))

$(if $(filter panel,$(MAKECMDGOALS)),$(if $(PANEL),,$(error make panel: PANEL is missing; try make panel PANEL=fig05)))

# Who may not write here is told so before anything is tried, and in which folders compiler and Snakemake do not work.
WRITING := $(filter-out help audit verify provenance status,$(MAKECMDGOALS))
override hash := \#
override UNNAMED := $(if $(WRITING),$(shell test "$$PWD" = "$$(printf %s "$$PWD" | tr -d '[]{}"\\$(hash)$$\n')" || echo yes))
$(if $(UNNAMED),$(error the path of this folder has one of [ ] { } " \ $(hash) $$ or a line break, which cmake, ccache or Snakemake \
  take for something else: move the project to another one))
PLACES := . build data figures .venv .snakemake .cache
override CLOSED := $(if $(WRITING),$(shell for each in $(PLACES); do test ! -e $$each || test -w $$each || echo $$each; done))
$(if $(CLOSED),$(error you may not write in $(CURDIR) ($(CLOSED)): copy the project to a folder of your own; \
  make audit, verify, provenance and status need no write access))

# What the recipes below and ninja open without a question; the rest is looked at by what opens it (workflow/lib/places.py).
OPENED := build/system-packages build/dev-packages build/CMakeCache.txt build/build.ninja build/.ninja_log build/.ninja_deps
override MISPLACED := $(if $(WRITING),$(shell for each in $(OPENED); do test ! -e $$each || test -f $$each || echo $$each; done))
$(if $(MISPLACED),$(error $(MISPLACED): no file lies where a file belongs; move it away))

override PYTHON := .venv/bin/python -P workflow/environment/launch.py
override WITHOUT_PACKAGES := python3 -I workflow/environment/launch.py
YES := yes 1
EFFORT := $(call quote,$(QUALITY)$(if $(SEED),_seed=$(SEED))$(if $(REPLICAS),_replicas=$(REPLICAS)))
AT_EFFORT := $(if $(filter-out standard,$(QUALITY)), QUALITY=$(QUALITY))$(if $(SEED), SEED=$(SEED))$(if $(REPLICAS), REPLICAS=$(REPLICAS))
$(foreach name,JOBS PANEL FILE CRATE SAMPLE PROFILE BATCH ACCOUNT PARTITION SECONDS,$(if $($(name)),$(eval override $(name) := $$(call quote,$$($(name))))))
ON_THIS_MACHINE = --cores $(or $(JOBS),$(shell env -u OMP_NUM_THREADS nproc 2>/dev/null || sysctl -n hw.ncpu))
ON_A_CLUSTER = --workflow-profile profiles/$(PROFILE) $(if $(JOBS),--jobs $(JOBS)) \
  $(if $(ACCOUNT)$(PARTITION),--default-resources $(if $(ACCOUNT),slurm_account=$(ACCOUNT)) $(if $(PARTITION),slurm_partition=$(PARTITION)))
override SNAKEMAKE := $(PYTHON) workflow.execution.alone $(if $(PROFILE),$(ON_A_CLUSTER),$(ON_THIS_MACHINE)) \
  --config quality=$(EFFORT) $(if $(PROFILE),batch=$(BATCH)) $(if $(PANEL),panel=$(PANEL)) $(if $(filter $(YES),$(FRESH)),fresh=yes)
SNAKEFMT := .venv/bin/snakefmt --no-format-shell --line-length 110
ONLY_PANEL := $(if $(PANEL),--panel=$(PANEL))
COMPARE = $(if $(SEED)$(REPLICAS)$(filter $(YES),$(FRESH)),$(PYTHON) workflow.provenance.compare --quality $(EFFORT))

.PHONY: help figures panel report gallery build test test-long check lint tidy sanitize fuzz coverage mutants format describe reference lock audit verify provenance status \
  cost crate bench timings tradeoff clean system-packages dev-packages installed runtime dev
help:  ## This list
	sed -nE 's/^([a-z-]+):.*  ## (.*)/make \1\t\2/p' Makefile | expand -t 16
	echo 'Options: QUALITY=smoke|standard|paper|deep  PANEL=fig05  FRESH=yes  SEED=7  REPLICAS=200  JOBS=2'
	echo 'For developers: SECONDS=60  SAMPLE=0.1'
	echo 'On a cluster (docs/cluster.md): PROFILE=slurm  BATCH=30  ACCOUNT=physics  PARTITION=short'

figures: build runtime  ## Build, simulate and draw every figure into figures/QUALITY
	$(SNAKEMAKE) --logger progress -- figures
	$(COMPARE)
	echo Figures are in figures/$(EFFORT)
	$(if $(filter report,$(MAKECMDGOALS)),,echo $(call quote,Next: make report$(AT_EFFORT) judges the claims of the paper by them))

panel: build runtime  ## The same for one panel, PANEL=fig05; FRESH=yes simulates it anew
	$(SNAKEMAKE) --logger progress -- panel
	$(if $(COMPARE),$(COMPARE) $(ONLY_PANEL))
	echo The panel is figures/$(EFFORT)/$(PANEL).pdf, .png, .svg and .csv

report: figures  ## The report that judges the paper's claims: figures/QUALITY/report.html and .md
	$(PYTHON) workflow.report.write --quality $(EFFORT)
	echo The report is figures/$(EFFORT)/report.html, for a browser, and report.md

gallery: runtime  ## docs/gallery and the answer in README.md, from the best that is here; verdicts of QUALITY
	$(PYTHON) workflow.report.gallery --quality $(EFFORT)

crate: build runtime  ## Figures, data, code and runs as an RO-Crate in build/crate; PANEL=fig05 packs one panel
	$(PYTHON) workflow.provenance.crate --quality $(EFFORT) $(ONLY_PANEL)

build: system-packages  ## The executables in build/bin
	test ! -e build/CMakeCache.txt || grep -qsxF $(call quote,CMAKE_HOME_DIRECTORY:INTERNAL=$(CURDIR)/cpp) build/CMakeCache.txt || \
	  rm -rf build/CMakeCache.txt build/CMakeFiles build/build.ninja
	$(WITHOUT_PACKAGES) workflow.environment.build_by_content
	test -f build/build.ninja || cmake -S cpp -B build -G Ninja >build/cmake.log || { cat build/cmake.log; exit 1; }
	bash workflow/environment/compile.sh
	$(WITHOUT_PACKAGES) workflow.environment.build_by_content --built

test: dev build  ## All tests; ends with the count
	bash workflow/environment/compile.sh cpp_tests
	$(PYTHON) tests.run

test-long: dev build  ## The same and tests that take minutes, on a Slurm of one node too
	test -x /usr/sbin/slurmctld || { apt-get update --quiet=2 && \
	  apt-get install --quiet=2 --yes --no-install-recommends slurm-wlm munge; } || echo 'no Slurm: its tests are skipped'
	bash workflow/environment/compile.sh cpp_tests
	$(PYTHON) tests.run --long

check: lint tidy  ## All that looks at sources without running them

lint: dev build reference  ## Format, lint, types and reference: seconds
	git ls-files -z '*.hpp' '*.cpp' | xargs -0 .venv/bin/clang-format --dry-run --Werror
	.venv/bin/ruff check --quiet . && .venv/bin/ruff format --quiet --check .
	.venv/bin/mypy --no-error-summary
	$(SNAKEFMT) --check --compact-diff Snakefile workflow/rules
	$(SNAKEMAKE) --lint

tidy: dev build  ## clang-tidy over the C++ sources that have changed since they were clean; minutes at first
	$(PYTHON) workflow.environment.tidy

sanitize: dev  ## C++ tests and programs under AddressSanitizer, UBSan and ThreadSanitizer; ends with the count
	$(PYTHON) tests.sanitize

fuzz: dev  ## Random command lines, configuration files and checkpoints, each for SECONDS=60
	$(PYTHON) tests.fuzz $(SECONDS)

coverage: dev  ## Lines of C++ and of the workflow that tests execute
	$(PYTHON) tests.cover

mutants: dev build  ## Changes the code at a SAMPLE=0.1 of its places, one at a time: which do no test notice?
	$(PYTHON) tests.mutants $(SAMPLE)

format: dev  ## Format every source in place
	git ls-files -z '*.hpp' '*.cpp' | xargs -0 .venv/bin/clang-format -i
	.venv/bin/ruff check --quiet --fix . && .venv/bin/ruff format --quiet .
	$(SNAKEFMT) Snakefile workflow/rules

describe: build runtime  ## State the programs' options and quantities in schema.yaml and docs/format.*
	$(PYTHON) workflow.config.describe

audit: installed  ## Check every link from the sources to the figures; PANEL=fig05 draws only that again; CRATE=FILE compares
	$(PYTHON) workflow.provenance.audit --quality $(EFFORT) $(ONLY_PANEL) $(if $(CRATE),--crate=$(CRATE))

verify: installed  ## Make a sample of the products again and compare; SAMPLE=0.1 PANEL=fig05
	$(PYTHON) workflow.provenance.verify --quality $(EFFORT) --sample $(SAMPLE) $(ONLY_PANEL)

provenance: installed  ## What a product was made from, FILE=figures/standard/fig05.pdf or a copy of it
	$(if $(FILE),,echo 'make provenance: FILE is missing; try make provenance FILE=figures/standard/fig05.pdf'; exit 2)
	$(PYTHON) workflow.provenance.tree $(if $(filter $(YES),$(FULL)),--full) -- $(FILE)

status: installed  ## Which panels are fresh, their errors and what they cost
	$(PYTHON) workflow.provenance.status --quality $(EFFORT)

cost: build runtime  ## CPU and wall time of a quality on this machine, foretold without a run; PANEL=fig05
	$(PYTHON) workflow.tradeoff.forecast --programs build/bin --quality $(EFFORT) $(ONLY_PANEL) $(if $(PROFILE),--batch $(BATCH))

bench: dev-packages build runtime  ## Cost of an event: engine, reference and floor side by side; programs and bare loops
	bash workflow/environment/compile.sh benchmarks
	build/bin/benchmarks --benchmark_repetitions=3 --benchmark_enable_random_interleaving=true \
	  --benchmark_report_aggregates_only=true --benchmark_out=build/bench.json
	$(PYTHON) workflow.tradeoff.bench_table build/bench.json
	$(PYTHON) workflow.tradeoff.bench_programs --programs build/bin

timings: build runtime  ## Measure the timings that make cost starts from anew, if they are to be shipped
	$(PYTHON) workflow.tradeoff.timings --programs build/bin

tradeoff: dev-packages build runtime  ## Speed against accuracy, measured here: figures/tradeoff
	bash workflow/environment/compile.sh reference_pulse reference_open_chain reference_drift
	$(PYTHON) workflow.tradeoff.kinetic --programs build/bin --output figures/tradeoff/ext06_kinetic
	$(PYTHON) workflow.tradeoff.accuracy --programs build/bin --output figures/tradeoff/ext06
	$(PYTHON) workflow.tradeoff.efficiency --programs build/bin --output figures/tradeoff/ext06_efficiency
	$(PYTHON) workflow.tradeoff.bias --programs build/bin --output figures/tradeoff/ext06_bias
	$(PYTHON) workflow.tradeoff.precision --programs build/bin --output figures/tradeoff/ext06_precision
	$(PYTHON) workflow.tradeoff.prediction --programs build/bin --output figures/tradeoff/ext06_prediction
	$(PYTHON) workflow.tradeoff.extremes --programs build/bin --quality $(EFFORT) --output figures/tradeoff/ext08

reference: dev  ## C++ and Python reference in build/reference; any warning is an error
	mkdir -p build/reference
	doxygen docs/Doxyfile
	PDOC_ALLOW_EXEC=1 .venv/bin/python -P -W error::UserWarning workflow/environment/launch.py pdoc -o build/reference/python \
	  $$(git ls-files 'workflow/*.py' | sed 's|/|.|g; s|\.py$$||')

lock: dev  ## Renew the locks of Python packages
	for name in requirements requirements-build requirements-dev; do \
	  .venv/bin/uv pip compile --quiet --no-header --no-annotate --upgrade --generate-hashes --universal \
	    --python-version 3.11 workflow/environment/$$name.in -o $$name.lock; \
	done

clean:  ## Remove what can be made again, results included
	$(WITHOUT_PACKAGES) workflow.environment.packages --idle
	rm -rf build data/*/ figures/*/ .snakemake .cache

system-packages:
	cmp -s workflow/environment/system_packages.sh build/system-packages || \
	  { bash workflow/environment/system_packages.sh && mkdir -p build && \
	    cp workflow/environment/system_packages.sh build/system-packages; }

# What was configured without them knows no tests, and is configured again.
dev-packages: system-packages
	cmp -s workflow/environment/system_packages.sh build/dev-packages || \
	  { bash workflow/environment/system_packages.sh dev && cp workflow/environment/system_packages.sh build/dev-packages; }
	test ! -f build/build.ninja || grep -q cpp_tests build/build.ninja || cmake build >build/cmake.log

# For what looks and changes nothing: packages are installed where there are none, and not repaired. Nor is anything of
# them started that is not as it was installed: it could say of itself that it is.
installed:
	test -x .venv/bin/python || $(WITHOUT_PACKAGES) workflow.environment.packages requirements-build.lock requirements.lock
	$(WITHOUT_PACKAGES) workflow.environment.packages --check

runtime: system-packages
	$(WITHOUT_PACKAGES) workflow.environment.packages requirements-build.lock requirements.lock

dev: dev-packages
	$(WITHOUT_PACKAGES) workflow.environment.packages requirements-build.lock requirements.lock requirements-dev.lock
