#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# sanitize.sh [asan-ubsan|tsan|debug|valgrind|integers]…: builds with run-time checks, runs the C++
# tests with few random inputs, and then runs the commands of tests/platforms, whose outputs must
# equal the outputs of build/release. By default, the first four kinds run. Installs missing
# packages first.
#   asan-ubsan  Clang checks addresses, leaks, undefined behaviour, and conversions to integers
#   tsan        Clang checks threads
#   debug       GCC with the checks of libstdc++'s debug mode
#   valgrind    checks for reads of memory that was never written; every eighth command, no CGAL
#   integers    Clang lists, for review, the places where integers wrap or lose digits legally
# EVERY=N: every Nth command; SECONDS_EACH: commands that take longer are left out and counted;
# REFERENCE: the build to compare with (default: build/release, built here); JOBS: number of parallel
# jobs; TESTS: a regular expression of the tests to run. The last lines show the result of each
# kind.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}
# Makes ccache share results between clones, including precompiled headers.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true
export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
programs=(ph-barcode ph-cluster ph-distance ph-segment ph-vectorise)
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1
export PATH=/usr/lib/llvm-19/bin:$PATH  # the folder of llvm-symbolizer
export PH_TEST_PATIENCE=20  # programs with checks run more slowly
export UBSAN_OPTIONS=print_stacktrace=1 TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1
summary=()

reference() {
  [ -z "${REFERENCE:-}" ] || return 0
  REFERENCE=build/release
  cmake --preset release >/dev/null
  cmake --build --preset release -j "$jobs" --target "${programs[@]}"
}

build() {
  local kind=$1
  shift
  cmake --preset "$kind" >/dev/null && cmake --build --preset "$kind" -j "$jobs" "$@" ||
    { summary+=("$kind: not built"); return 1; }
}

# outputs KIND BUILD [LAUNCHER…]: runs the commands of tests/platforms, and prints the line that
# states how many ran.
outputs() {
  local kind=$1 status=0
  shift
  python3 -B tests/platforms/same_outputs.py --every "${EVERY:-1}" --seconds "${SECONDS_EACH:-600}" \
    "$REFERENCE" "$@" | tee "build/$kind.log" || status=$?
  counts+="${counts:+; }$(tail -1 "build/$kind.log")"
  return "$status"
}

tests() {
  local status=0
  ctest --test-dir "build/$1" -L quick -R "${TESTS:-.}" -j "$jobs" --output-on-failure --no-tests=error \
    --output-junit "$PWD/build/$1/tests.xml" || status=$?
  counts=$(awk -F'"' '/^[ \t]*tests=/ { tests = $2 } /^[ \t]*failures=/ { failed = $2 } /<testcase/ { exit }
    END { printf "%d of %d test programs passed", tests - failed, tests }' "build/$1/tests.xml")
  return "$status"
}

run() {
  local kind=$1 status=0 counts=
  case $kind in
    asan-ubsan|tsan|debug)
      build "$kind" || return
      tests "$kind" || status=$?
      # The debug mode is slow: each search in a sorted range checks the whole range.
      if [ "$kind" = debug ]; then SECONDS_EACH=${SECONDS_EACH:-20}; fi
      outputs "$kind" "build/$kind" || status=$? ;;
    valgrind)
      build valgrind --target "${programs[@]}" || return
      EVERY=${EVERY:-8} outputs valgrind build/valgrind valgrind -q --error-exitcode=99 --leak-check=full \
        --show-leak-kinds=definite --errors-for-leak-kinds=definite || status=$? ;;
    integers)
      build integers --target "${programs[@]}" || return
      rm -rf build/integers/reports && mkdir build/integers/reports
      UBSAN_OPTIONS=log_path=$PWD/build/integers/reports/run outputs integers build/integers || status=$?
      # Lists each place in the code once, however often it was reported.
      cat build/integers/reports/* 2>/dev/null | grep 'runtime error' | sed "s#$PWD/##" |
        sed -E 's/(: runtime error: [a-z -]*).*/\1/' | sort -u | tee build/integers/places.txt
      counts="$(wc -l <build/integers/places.txt) places; $counts" ;;
    *) echo "sanitize.sh: found '$kind', expected asan-ubsan, tsan, debug, valgrind or integers" >&2; return 64 ;;
  esac
  summary+=("$kind: $counts")
  return "$status"
}

[ $# -gt 0 ] || set -- asan-ubsan tsan debug valgrind
scripts/setup.sh build sanitize
reference
failed=0
for kind; do run "$kind" || failed=1; done
printf '%s\n' "${summary[@]}"
exit "$failed"
