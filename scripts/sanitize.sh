#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# sanitize.sh [asan-ubsan|tsan|debug|valgrind|integers]…: builds with what finds faults while it runs, runs the
# C++ tests with few random inputs, and the programs over the commands of tests/platforms, whose
# outputs have to be those of build/release. Without arguments: the first four. Installs what is missing.
#   asan-ubsan  Clang: addresses, leaks, undefined behaviour, numbers that do not fit an integer
#   tsan        Clang: threads
#   debug       GCC: the checks of libstdc++'s debug mode
#   valgrind    each eighth of the commands, without CGAL: memory that was never written
#   integers    Clang: a list, to be judged, of where integers wrap or lose digits, which is defined
# EVERY=N: each Nth of the commands; SECONDS_EACH: what takes longer is left out, and counted;
# REFERENCE: the build to compare with (default: build/release, built here); JOBS: how many at a time;
# TESTS: a regular expression of the tests that are run. A line for each kind comes last.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}
# What was compiled in another clone counts here, precompiled headers included.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true
export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
programs=(ph-barcode ph-distance ph-segment ph-vectorise)
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1
export PATH=/usr/lib/llvm-19/bin:$PATH  # llvm-symbolizer
export PH_TEST_PATIENCE=20  # what is checked takes longer
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

# outputs KIND BUILD [WHAT RUNS IT…]: the commands, and the line that counts them.
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
      # In debug mode each search in a sorted range looks at all of it.
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
      # Each place once, however often it is met.
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
