#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# lint.sh [layout|clang-tidy|cppcheck|analyzer]…: runs static checks, by default all of them. layout
# checks the format of all C++ with clang-format; clang-tidy checks the names and idioms of
# libraries and programs, and cppcheck searches them for faults; analyzer runs GCC's analyzer on C,
# the only language that it supports. Installs missing packages first. The last lines show the
# result of each check. tests/analysis lists false positives.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}

sources() { git ls-files 'libph/src/*.cpp' 'libsegment/src/*.cpp' 'libreport/*.cpp' 'apps/*.cpp'; }

layout() {
  files=$(git ls-files '*.hpp' '*.cpp' '*.ipp' ':!tests/headers/violations')
  xargs clang-format-14 --dry-run --Werror <<<"$files"
}

clang-tidy() {
  files=$(sources | grep -vE '/pcl/|/windows/')
  cmake --preset dev >/dev/null &&
    xargs -P "$jobs" -n 4 clang-tidy-19 --quiet --warnings-as-errors='*' \
      --extra-arg=-Wno-sign-conversion --extra-arg=-Wno-deprecated-declarations -p build/dev <<<"$files"
}

cppcheck() {
  files=$(sources)
  mkdir -p build/cppcheck
  xargs cppcheck --std=c++20 --enable=warning,portability --quiet --error-exitcode=1 \
    --suppressions-list=tests/analysis/cppcheck.txt --cppcheck-build-dir=build/cppcheck -j "$jobs" \
    --template='{file}:{line}: {severity}: {message} [{id}]' -I . -I libph/include \
    -I libsegment/include -I libreport/include <<<"$files"
}

analyzer() {
  files=$(git ls-files '*.c')
  xargs -n 1 gcc -O1 -Wall -Wextra -Werror -fanalyzer -I libph/include -o /dev/null -c <<<"$files"
}

[ $# -gt 0 ] || set -- layout clang-tidy cppcheck analyzer
scripts/setup.sh build lint
summary=() failed=0
for kind; do
  case $kind in
    layout|clang-tidy|cppcheck|analyzer) ;;
    *) echo "lint.sh: found '$kind', expected layout, clang-tidy, cppcheck or analyzer" >&2; exit 64 ;;
  esac
  said=clean
  "$kind" || { said="something was found, see above"; failed=1; }
  summary+=("$kind: $(wc -l <<<"$files") files, $said")
done
printf '%s\n' "${summary[@]}"
exit "$failed"
