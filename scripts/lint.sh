#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Layout (clang-format) and naming and habits (clang-tidy) of everything tracked.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build lint
git ls-files '*.hpp' '*.cpp' '*.ipp' ':!tests/headers/violations' | xargs clang-format-14 --dry-run --Werror
cmake --preset dev >/dev/null
git ls-files 'libph/src/*.cpp' 'libsegment/src/*.cpp' 'libreport/*.cpp' 'apps/*.cpp' | grep -v '/pcl/' |
  xargs -P "$(nproc)" -n 4 clang-tidy-19 --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-sign-conversion --extra-arg=-Wno-deprecated-declarations -p build/dev
