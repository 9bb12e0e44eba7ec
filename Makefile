# Everything a newcomer needs, on Debian 12 with nothing but git and make installed.
#
#   make demo      build, merge two stiffeners into the caisson, show what came out
#   make figures   draw the figures of docs/figures.md anew
#   make test      build and run the tests
#   make build     build only; the program is build/release/meshgraft
#   make sanitize  the tests again, under the address and undefined-behaviour sanitizers
#   make soak      the laws on new random scenes, SCENES (1000) each; prints the seed of each failure
#   make bench     measure speed and memory, beside CGAL doing the same
#   make validation  analyse merged meshes and meshes made from CAD, side by side
#   make method    lay the methods of filling beside each other (docs/method.md)
#   make format    lay out the sources with clang-format
#   make lint      names and common mistakes, with clang-tidy
#   make clean     remove build/

JOBS := $(shell nproc)
SCENES := 1000
SOURCES = $(shell git ls-files 'include/*.hpp' 'src/*.[ch]pp' 'tests/*.[ch]pp' 'bench/*.[ch]pp' 'validation/*.[ch]pp' \
  'tools/*.[ch]pp' 'examples/*.cpp')

.PHONY: demo figures test build sanitize soak bench validation method format lint clean packages
.DEFAULT_GOAL := build

demo: build/release/build.ninja
	cmake --build build/release --target meshgraft_cli meshgraft_draw
	tools/demo build/release build/demo

figures: build/release/build.ninja
	cmake --build build/release --target write_figures meshgraft_draw
	tools/figures build/release docs/images

test: build
	ctest --preset release -j $(JOBS)

build: build/release/build.ninja
	cmake --build build/release

sanitize: packages
	cmake --preset sanitize
	cmake --build build/sanitize
	ctest --preset sanitize -j $(JOBS)

soak: build
	@failed=0; \
	for program in build/release/tests/*/*_test; do \
	  echo "== $$program"; \
	  RC_PARAMS="max_success=$(SCENES)" "$$program" --gtest_brief=1 || failed=1; \
	done; exit $$failed

bench:
	tools/install-packages build bench
	cmake --preset bench
	cmake --build build/bench
	build/bench/bench/meshgraft_bench build/bench/meshgraft build/bench/scenes

validation:
	tools/install-packages build validation
	cmake --preset release
	cmake --build build/release --target meshgraft_cli meshgraft_study
	validation/run build/release build/validation

method: build/release/build.ninja
	cmake --build build/release --target meshgraft_methods meshgraft_orders meshgraft_draw
	validation/run-methods build/release build/method

format:
	tools/install-packages lint
	clang-format -i $(SOURCES)

# Debian's default clang-tidy (14) does not understand the ranges of g++ 12; clang 19 refuses the headers of CGAL that
# bench/peer_cgal.cpp needs.
lint:
	tools/install-packages build bench lint
	cmake --preset bench
	clang-format --dry-run --Werror $(SOURCES)
	printf '%s\n' $(filter-out tests/% bench/peer_cgal.cpp,$(filter %.cpp,$(SOURCES))) | \
	  xargs -P $(JOBS) -n 1 clang-tidy-19 --quiet --extra-arg=-Wno-error -p build/bench

clean:
	rm -rf build

build/release/build.ninja: packages
	cmake --preset release

packages:
	@tools/install-packages build
