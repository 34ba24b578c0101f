#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds everything, warnings as errors, and runs all tests. Installs what is missing first.
# Prints the counts last.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=$(nproc)

scripts/setup.sh build test
cmake --preset release -DPH_WITH_PCL=ON -DPH_BUILD_TESTS=ON -DPH_BUILD_EXAMPLES=ON
cmake --build --preset release -j "$jobs"

# ph::core and ph::io alone: neither PCL nor the programs' libraries.
cmake -S . -B build/core -G Ninja -DPH_BUILD_TESTS=OFF -DPH_BUILD_APPS=OFF -DPH_BUILD_EXAMPLES=OFF
cmake --build build/core -j "$jobs"

ctest --test-dir build/release -j "$jobs" --output-on-failure --no-tests=error "$@"
