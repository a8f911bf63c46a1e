.DEFAULT_GOAL := help
.PHONY: help run test lint types contracts check bench bench-scaling bench-service verify judge docs lock openapi clean
SHELL := /bin/sh
B := .venv/bin
# One BLAS thread in every process: the work is spread over processes, not inside a product.
export OPENBLAS_NUM_THREADS := 1
export OMP_NUM_THREADS := 1

help:  ## show this list
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | awk -F ':.*## ' '{printf "  make %-13s %s\n", $$1, $$2}'

run:  ## install, build the example airframe, start the service, post the demo landings
	@bin/setup && exec $(B)/hardlanding run

test:  ## install and run every test (T=path for a part)
	@bin/setup dev && $(B)/python -m pytest $(T)

lint:  ## formatting and style
	@bin/setup dev && $(B)/ruff format --check . && $(B)/ruff check .

types:  ## static types, strict
	@bin/setup dev && $(B)/mypy

contracts:  ## who may import whom
	@bin/setup dev && $(B)/lint-imports

check: test lint types contracts  ## everything that CI runs
	@$(MAKE) --no-print-directory verify QUICK=1

bench:  ## timings of one landing, side by side in one run
	@bin/setup dev && $(B)/python -m benchmarks.landing

bench-scaling:  ## how a landing's cost grows up to 100,000 elements (SIZES="1 2 4")
	@bin/setup dev && $(B)/python -m benchmarks.scaling $(if $(SIZES),--sizes $(SIZES))

bench-service:  ## how the service keeps up, with a real Postgres and Redis (OPTIONS="--landings 200")
	@bin/setup dev && $(B)/python -m benchmarks.service $(OPTIONS)

verify:  ## compare with independent means, report in var/verify (QUICK=1, ONLY=chapter, DOCS=1)
	@$(if $(QUICK),bin/setup dev,bin/setup peers || bin/setup dev) && $(B)/python -m verification \
	  $(if $(QUICK),--quick) $(if $(ONLY),--only $(ONLY)) $(if $(DOCS),--docs)

judge:  ## fly published accidents and a synthetic fleet, judge every method (QUICK=1, LANDINGS=n, DOCS=1)
	@bin/setup dev && $(B)/python -m verification.judging \
	  $(if $(QUICK),--quick) $(if $(LANDINGS),--landings $(LANDINGS)) $(if $(DOCS),--docs)

docs:  ## draw the figures of README and docs again
	@bin/setup dev && $(B)/python docs/figures/draw.py

openapi:  ## write the snapshot of the interface that the contract test compares
	@bin/setup dev && $(B)/python -m tests.contract.snapshot

lock:  ## resolve the dependencies again
	@bin/setup dev && $(B)/pip install --quiet uv && $(B)/uv lock --upgrade \
	  && $(B)/uv export --quiet --frozen --no-emit-project --no-header --no-annotate --group build --no-group dev -o requirements.lock \
	  && $(B)/uv export --quiet --frozen --no-emit-project --no-header --no-annotate --group build -o requirements-dev.lock \
	  && $(B)/uv export --quiet --frozen --no-emit-project --no-header --no-annotate --group build --group peers -o requirements-peers.lock

clean:  ## remove the environment and all local state
	rm -rf .venv var .pytest_cache .mypy_cache .ruff_cache .import_linter_cache
