# SPDX-License-Identifier: Apache-2.0
# The everyday commands; each does what is missing first. The build itself is CMake's (CMakePresets.json).

SUITES ?= lean
BUILD := build/release
OUT := out
# The distribution's `c++` may be any compiler; ours is g++ unless asked otherwise (make CXX=clang++-16 ...).
ifeq ($(origin CXX),default)
CXX := g++
endif
JOBS := $(shell nproc)

.DEFAULT_GOAL := help
PREFIX ?= /usr/local
.PHONY: help demo build web test bench install deb validate robustness fuzz docs format tidy setup

help: ## this list
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "  make %-10s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

setup: ## install the Debian packages that are missing (packages.txt)
	@tools/setup.sh lean

$(BUILD)/build.ninja: | setup
	cmake --preset release -B $(BUILD) -DCMAKE_CXX_COMPILER=$(CXX)

build: setup $(BUILD)/build.ninja ## the program: build/release/sconce
	ninja -C $(BUILD) sconce

web: setup $(BUILD)/build.ninja ## the page of sconce export --web and serve: build/release/web (needs npm)
	@tools/setup.sh web && cmake --preset release -B $(BUILD) >/dev/null
	ninja -C $(BUILD) web

install: setup $(BUILD)/build.ninja ## the program, its data and documents, sconce-runtime: below PREFIX (/usr/local); DESTDIR works
	ninja -C $(BUILD) sconce sconce-runtime
	cmake --install $(BUILD) --prefix $(PREFIX)

deb: setup $(BUILD)/build.ninja ## the same as a Debian package: out/sconce_*.deb
	ninja -C $(BUILD) sconce sconce-runtime
	cpack --config $(BUILD)/CPackConfig.cmake -B $(OUT) && rm -rf $(OUT)/_CPack_Packages

demo: build ## bake our bathroom and picture it in four moods: out/demo/
	scenes/demo.sh $(BUILD) $(OUT)/demo

# The suite `lean` leaves out what needs large packages (label big); SUITES=all adds it.
test: setup $(BUILD)/build.ninja ## build everything and run the tests; SUITES=all for the whole suite
	$(if $(filter all,$(SUITES)),@tools/setup.sh lean all web && cmake --preset release -B $(BUILD) >/dev/null)
	$(if $(filter all,$(SUITES)),ninja -C $(BUILD) web)
	ninja -C $(BUILD)
	ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS) $(if $(filter all,$(SUITES)),,-LE big)

bench: setup ## run the benchmarks: bench/results/
	cmake --preset release -B build/bench -DCMAKE_CXX_COMPILER=$(CXX) -DSCONCE_BENCH=ON
	ninja -C build/bench run_bench

# Values known from elsewhere beside ours.
validate: setup $(BUILD)/build.ninja ## compute docs/validation.md
	ninja -C $(BUILD) validation
	$(BUILD)/tests/validation $(or $(SCONCE_TEST_DATA),../shared/data) docs/validation.md

# Once as it is built for use, once with sanitizers.
robustness: build ## broken files of other people's test suites: docs/robustness.md
	cmake --preset dev -B build/dev -DCMAKE_CXX_COMPILER=$(CXX)
	ninja -C build/dev sconce
	ninja -C $(BUILD) robustness
	$(BUILD)/tests/robustness $(or $(SCONCE_TEST_DATA),../shared/data) docs/robustness.md $(BUILD)/sconce build/dev/sconce

# Reads broken files until RUNS inputs per reader are through, those of earlier runs included; TARGETS="gltf obj" takes some (tests/fuzz).
fuzz: build ## RUNS=1000000 made-up inputs to every reader (clang): bench/results/fuzz.md
	@tools/setup.sh dev
	cmake --preset fuzz
	ninja -C build/fuzz fuzz
	tests/fuzz/run.sh $(BUILD)/sconce build/fuzz $(or $(SCONCE_TEST_DATA),../shared/data) $(or $(RUNS),1000000) $(TARGETS)

docs: build ## write docs/cli.md, out of every verb's --help
	$(BUILD)/sconce help --markdown > docs/cli.md.new && mv docs/cli.md.new docs/cli.md

format: ## clang-format over all sources
	@tools/setup.sh dev
	git ls-files '*.cpp' '*.h' | xargs clang-format-16 -i

tidy: setup ## clang-tidy over all sources
	@tools/setup.sh dev
	cmake --preset tidy
	ninja -C build/tidy
