# The house in a few words. Needs GNU make and Python 3.11 or later with venv;
# everything else is installed into .venv/, each file held to the hash in the
# lock. A stamp remembers that, until a lock changes.

PYTHON ?= python3
WORKERS ?= 2
SECONDS ?= 3600

venv := .venv
python := $(venv)/bin/python
pip_flags := install --quiet --disable-pip-version-check
install := $(python) -m pip $(pip_flags)
compile := build/lock/bin/uv pip compile --quiet --no-config --universal --python-version 3.11 \
  --generate-hashes --custom-compile-command 'make lock' $(UPGRADE)
run_stamp := $(venv)/run.stamp
test_stamp := $(venv)/test.stamp
fuzz_stamp := $(venv)/fuzz.stamp

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help run test lint smoke kernels bench gate speed prove mutants docs fuzz images lock clean

help: ## this list
	@echo "make TARGET, where TARGET is one of"
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  \1\t\2/p' $(firstword $(MAKEFILE_LIST)) | expand -t 10

run: $(run_stamp) ## set up, run the shipped bench, write reports/
	@$(python) -m fcl_sim run

test: $(test_stamp) ## set up, check the style, install the wheel, run all tests
	@$(MAKE) --no-print-directory --jobs 2 --output-sync=target lint smoke kernels
	@$(python) -m pytest -n $(WORKERS)

lint: $(test_stamp) ## style, types and the floors of the house
	@$(python) -m ruff check
	@$(python) -m ruff format --check
	@$(python) -m mypy
	@$(venv)/bin/lint-imports --no-logo --cache-dir .import_linter_cache

# The wheel is built from the source distribution, so both are proved; its
# dependencies come from the lock, and pip checks that its own list agrees.
smoke: $(test_stamp) ## build the wheel, install it elsewhere, start a bench from it and run a scenario
	@rm -rf build/smoke && mkdir -p build/smoke/source
	@$(python) -m hatchling build --target sdist --directory build/smoke
	@tar --extract --strip-components 1 --directory build/smoke/source --file build/smoke/*.tar.gz
	@cd build/smoke/source && $(CURDIR)/$(python) -m hatchling build --target wheel --directory ..
	@$(PYTHON) -m venv build/smoke/venv
	@build/smoke/venv/bin/python -m pip $(pip_flags) --require-hashes --requirement requirements-run.lock
	@build/smoke/venv/bin/python -m pip $(pip_flags) --no-deps build/smoke/*.whl
	@build/smoke/venv/bin/python -m pip check
	@elsewhere=$$(mktemp -d) && trap 'rm -rf "$$elsewhere"' EXIT && cd "$$elsewhere" && \
	  command=$(CURDIR)/build/smoke/venv/bin/fcl-sim && $$command new bench >run.log && cd bench && \
	  $$command run scenarios/pi/velocity.toml >../run.log && test -s reports/report.pdf && tail -n 1 ../run.log

kernels: $(test_stamp) ## compile what the tests share (a minute, once)
	@$(python) -m tests.kernels

bench: $(test_stamp) ## measure the speed, against C and other Python libraries
	@$(python) -m benchmarks

gate: $(test_stamp) ## fail where the simulation has become slower beside C (benchmarks/gate.toml)
	@$(python) -m benchmarks --gate benchmarks/gate.toml

speed: $(test_stamp) ## the same, and write it to docs/speed.md
	@$(python) -m benchmarks --write

prove: $(test_stamp) ## compare BASES=100000 random rule bases with the oracle (an hour)
	@$(python) -m tests.engine.prove $(BASES)

mutants: $(test_stamp) ## tell which mutants of the shipped rule bases check and diff see (a quarter of an hour)
	@$(python) -m tests.proof.mutants

docs: $(run_stamp) ## write the pages of docs/ that are generated
	@$(python) -m docs

fuzz: $(fuzz_stamp) ## look for texts that break the FCL reader, for SECONDS=3600
	@$(python) tests/fuzz/fuzz_fcl.py $(SECONDS) build/fuzz

images: docs ## the same: the pictures are generated with the pages

lock: ## write the locks from pyproject.toml; with UPGRADE=--upgrade take the newest releases
	@$(PYTHON) -m venv --clear build/lock
	@build/lock/bin/python -m pip install --quiet --disable-pip-version-check uv
	@$(compile) --group build --group test --group lint --output-file requirements.lock pyproject.toml
	@$(compile) --group build --constraint requirements.lock --output-file requirements-run.lock pyproject.toml
	@$(compile) --group fuzz --output-file requirements-fuzz.lock

clean: ## remove what was installed and written
	rm -rf $(venv) build dist .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find reports -mindepth 1 ! -name README.md -delete

$(run_stamp): requirements-run.lock pyproject.toml hatch_build.py
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "fcl_sim needs Python 3.11 or later, '$(PYTHON)' is not. Name another: make PYTHON=python3.12 $(MAKECMDGOALS)" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
	  { echo "'$(PYTHON)' cannot make virtual environments: on Debian, apt install python3-venv" >&2; exit 1; }
	@echo "Setting up $(venv) (once; takes a minute) ..."
	@$(PYTHON) -m venv --clear $(venv)
	@$(install) --require-hashes --requirement requirements-run.lock
	@$(install) --no-deps --no-build-isolation --editable .
	@touch $@

$(fuzz_stamp): $(run_stamp) requirements-fuzz.lock
	@$(install) --require-hashes --requirement requirements-fuzz.lock
	@touch $@

$(test_stamp): $(run_stamp) requirements.lock
	@echo "Adding what the tests need ..."
	@$(install) --require-hashes --no-build-isolation --use-pep517 --requirement requirements.lock
	@touch $@
