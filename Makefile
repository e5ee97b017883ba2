# `make` and `make test` are all that a newcomer needs; `make help` lists the rest.
# Where there is no make, as on Windows, CONTRIBUTING.md has the same commands spelt out.

VENV = .venv
# The first Python on the path that is new enough, unless one is named: make PYTHON=python3.12
PYTHON = $(shell for python in python3 python3.13 python3.12 python3.11 python3.10 python; do \
	"$$python" -c 'import sys; sys.exit(sys.version_info < (3, 10))' 2>/dev/null \
	&& echo "$$python" && break; done)

IN := $(VENV)/bin
# What decodes and generates is there first, and is light. What builds pages and packages, tests and
# lints is added to it when it is first called for: each is a group in pyproject.toml.
READY := $(VENV)/.ready
TO_BUILD := $(VENV)/.ready-build
TO_TEST := $(VENV)/.ready-test
TO_LINT := $(VENV)/.ready-lint
# All of ours in one command, so that pip looks for none of them elsewhere.
OURS := --editable . --editable ./codegen
# Libraries that are packages of their own, as far as they are generated.
LIBRARIES := $(patsubst %/pyproject.toml,./%,$(wildcard generated/*/pyproject.toml))
OURS += $(addprefix --editable ,$(LIBRARIES))
PINS := --constraint constraints.txt
BENCH_VENV := .tools/bench
MUTATION_VENV := .tools/mutation
# What is installed without what it asks for: a toolkit of windows, which it does not use.
ALONE_test := pylx16a
PINS_VENV := .tools/pins
# How many tests run at once. Many only wait, so more than there are cores; 0 is one after another.
WORKERS = 3
# The tests of a file follow each other in one process, which works out once what they share.
AT_ONCE = -n $(WORKERS) --dist loadfile
# Which of the tests, for `quick`: all.
TESTS =
# How many tests of each file of tests/world are a sample; others each day, or those of a SEED.
SAMPLE = 3
SEED =
# Those of no sample: `make packages` and `make newcomer` run all of theirs, and each of the
# afternoon is all tests once more.
WHOLE = afternoon newcomer packages
# Where the pages go.
SITE = build/site
# Where libraries are generated that carry what ours share, to be handed on alone, beside the virtual
# devices that they bring.
CARRYING = build/carrying
# The address where they will be, for a sitemap and the like.
BASE =
# What a release is called.
VERSION =
# Which mutants, and how many of them: make mutants ONLY='framewire.client.*' SAMPLE=60 SEED=7
ONLY =

# Where Python keeps nothing of what it has compiled, each process of the tests compiles it again.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := all
# Two that add to one environment at once would spoil it.
.NOTPARALLEL:
.PHONY: all test quick library test-all sample coverage lint style types current diff format fuzz soak mutants bench docs docs-tools wheel packages release newcomer pins venv clean help

all: $(READY)  ## Check the spec, generate everything, decode a recorded noisy line (plain `make`)
	$(IN)/framegen check
	$(IN)/framegen generate
	$(IN)/busservo decode --direction any tests/captures/noisy_line.bin
	$(IN)/python examples/virtual_arm.py

test: $(TO_TEST)  ## Run the tests
	$(IN)/python -m pytest $(AT_ONCE)

quick: $(TO_TEST)  ## Run the tests with fewer examples
	HYPOTHESIS_PROFILE=quick $(IN)/python -m pytest -q $(AT_ONCE) $(TESTS)

library: $(VENV)/.ready-library  ## Run tests of the library with fewer examples: make library TESTS=tests/unit/runtime/client
	HYPOTHESIS_PROFILE=quick $(IN)/python -m pytest -q $(AT_ONCE) $(TESTS)

test-all: $(TO_TEST) $(TO_LINT)  ## Run tests/world as well, and eight times as many examples
	HYPOTHESIS_PROFILE=all $(IN)/python -m pytest $(AT_ONCE)
	HYPOTHESIS_PROFILE=all $(IN)/python -m pytest -n $(WORKERS) tests/world

sample: $(TO_TEST) $(TO_LINT)  ## Run some of tests/world: make sample SAMPLE=5 SEED=7
	$(IN)/python -m pytest -n $(WORKERS) tests/world $(foreach file,$(WHOLE),--ignore tests/world/test_$(file).py) --sample $(SAMPLE) $(if $(SEED),--seed $(SEED))

coverage: $(TO_TEST)  ## Measure which lines and branches the quick tests reach, commands included
	$(IN)/coverage erase
	HYPOTHESIS_PROFILE=quick $(IN)/coverage run -m pytest -q
	$(IN)/coverage combine -q
	$(IN)/coverage report

lint: style types current  ## Lint, look at the format, check types, and that the output is up to date

style: $(TO_LINT)  ## Lint, and look at the format
	$(IN)/ruff check
	$(IN)/ruff format --check

types: $(TO_LINT) $(TO_TEST)  ## Check types, those of the tests included
	$(IN)/mypy
	$(IN)/pyright --pythonpath $(IN)/python

current: $(READY)  ## See that what is generated is up to date
	$(IN)/framegen generate --check

diff: $(READY)  ## Compare the specs with what was released of them, and say what breaks
	$(IN)/framegen diff

format: $(TO_LINT)  ## Mend what ruff can mend
	$(IN)/ruff check --fix
	$(IN)/ruff format

fuzz: $(TO_TEST)  ## Search for new counterexamples, for long; change the specs, and cross them
	HYPOTHESIS_PROFILE=fuzz $(IN)/python -m pytest
	$(IN)/python -m pytest tests/world/test_contract.py --sample all
	$(IN)/python -m pytest -n $(WORKERS) tests/world/test_crossed.py --sample 2000 --seed $(or $(SEED),$$(date +%s))

bench:  ## Measure the library against its peers
	@$(MAKE) --no-print-directory $(BENCH_VENV)/.ready-bench VENV=$(BENCH_VENV)
	@command -v npm >/dev/null && npm install --silent --no-package-lock --prefix benchmarks/peers/kaitai || true
	$(BENCH_VENV)/bin/python -m benchmarks

docs: $(READY)  ## Build the site: make docs SITE=html BASE=https://where.it/will/be
	rm -rf $(SITE)
	$(IN)/framegen docs --strict --out $(SITE) $(if $(BASE),--base '$(BASE)')

docs-tools:  ## Install what the tests of the reference need of Node.js: a validator, axe-core
	@mkdir -p .tools/node
	@cp tests/unit/site/package.json .tools/node/
	npm install --prefix .tools/node --silent --no-audit --no-fund --no-package-lock

soak: $(TO_TEST)  ## Ask a hundred thousand times, with faults, and see that nothing leaks or is lost
	$(IN)/python -m tests.soak

# Set and dict in the names of tests need the same order in every process.
mutants:  ## Change the code in many small ways, and list the changes that no test sees
	@$(MAKE) --no-print-directory $(MUTATION_VENV)/.ready-mutation VENV=$(MUTATION_VENV)
	rm -rf mutants
	mkdir -p mutants/src
	cp -R generated/busservo codegen/framegen runtime/framewire mutants/src
	cp -R tests spec docs pyproject.toml mutants
	cd mutants && PYTHONHASHSEED=0 ../$(MUTATION_VENV)/bin/python -m tests.mutate \
		'$(or $(ONLY),*)' $(if $(filter command line,$(origin SAMPLE)),$(SAMPLE) $(SEED))
	cd mutants/mutants && HYPOTHESIS_PROFILE=quick PYTHONHASHSEED=0 \
		../../$(MUTATION_VENV)/bin/python -m tests.mutants '$(or $(ONLY),*)'

wheel: $(TO_BUILD)  ## Build dist/: a wheel and a source distribution of each package
	rm -rf dist $(CARRYING)
	mkdir -p $(CARRYING)
	cp -R simulator $(CARRYING)
	$(IN)/python -m build --no-isolation --outdir dist .
	$(IN)/python -m build --no-isolation --outdir dist codegen
	for name in $(notdir $(LIBRARIES)); do \
		$(IN)/framegen generate spec/$$name.yaml --target python --runtime carried --out $(CARRYING) && \
		$(IN)/python -m build --no-isolation --outdir dist $(CARRYING)/generated/$$name || exit; \
	done

# Nothing is published: dist/ holds files that can be handed on.
release: $(TO_TEST)  ## Check all, set the version, tag it, and build dist/: make release VERSION=0.2.0
	$(IN)/python .ci/release.py --check '$(VERSION)'
	$(MAKE) lint test packages
	$(IN)/python .ci/release.py '$(VERSION)'
	$(MAKE) wheel

packages: $(TO_TEST)  ## Build the packages, and try them in empty environments
	$(IN)/python -m pytest -n $(WORKERS) tests/world/test_packages.py

newcomer:  ## Follow README and guides in a new clone, with the system's own Python
	.ci/newcomer

# The oldest Python makes them: what it can install, all others can.
pins:  ## Renew constraints.txt: make pins PYTHON=python3.10
	rm -rf $(PINS_VENV)
	$(MAKE) --no-print-directory $(PINS_VENV)/.ready-test $(PINS_VENV)/.ready-lint VENV=$(PINS_VENV) PINS=
	sed '/^[^#]/d' constraints.txt >$(PINS_VENV)/constraints.txt
	$(PINS_VENV)/bin/python -m pip freeze --exclude-editable >>$(PINS_VENV)/constraints.txt
	cp $(PINS_VENV)/constraints.txt constraints.txt

venv: $(READY) $(TO_TEST) $(TO_LINT)  ## Only make the virtual environment, with all that tests and lints need

# Made anew only when what it is made of has changed.
$(READY): pyproject.toml codegen/pyproject.toml constraints.txt
	@test -n "$(PYTHON)" || { \
		echo "No Python 3.10 or newer is on the path. Install one, or: make PYTHON=/where/it/is"; \
		exit 1; }
	@test -e $(IN)/python || "$(PYTHON)" -c 'import ensurepip, venv' 2>/dev/null || { \
		echo "$(PYTHON) cannot make virtual environments: its venv or ensurepip is missing."; \
		echo "On Debian and Ubuntu: sudo apt install python3-venv"; \
		exit 1; }
	@test -e $(IN)/python || { echo "Making $(VENV) with $$("$(PYTHON)" --version)"; \
		"$(PYTHON)" -m venv $(VENV); }
	@$(IN)/python -m pip --version >/dev/null 2>&1 || $(IN)/python -m ensurepip
	@echo "Installing what $(VENV) needs (only the first time)"
	@$(IN)/python -m pip install -qq $(PINS) $(OURS)
	@touch $@

# A group of pyproject.toml. A pip older than 25.1 knows no --group.
$(VENV)/.ready-%: $(READY)
	@echo "Installing what \`$*\` needs (only the first time)"
	@$(IN)/python -m pip install -qq --upgrade "pip>=25.1"
	@$(IN)/python -m pip install -qq $(PINS) --group $*
	@$(if $(ALONE_$*),$(IN)/python -m pip install -qq $(PINS) --no-deps $(ALONE_$*))
	@touch $@

clean:  ## Remove everything that these commands make, the virtual environments included
	rm -rf .venv .tools build dist html mutants .coverage .coverage.*
	rm -rf .hypothesis .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

help:  ## Show this
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-10s %s\n", $$1, $$2}' $(MAKEFILE_LIST)
