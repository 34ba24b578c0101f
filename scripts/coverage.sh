#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# coverage.sh [readers|engines]…: measures the share of lines that tests reach, by default for both
# parts of the code. Exits with 1 if a share is below its minimum.
#   readers  at least 99 %: by the reader tests, the samples, their prefixes, the fuzzing seeds, the
#            corpus of bad inputs, and random runs
#   engines  at least 97 % of libph/src (except files and pictures) and of the internal headers: by
#            the C++ tests with a fiftieth of their random inputs
# COVERAGE_BUILD: another build folder. The last lines show the result of each part.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${COVERAGE_BUILD:-build/coverage}
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true
export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
export PH_TEST_PATIENCE=20  # the code is not optimised
summary=()
failed=0

# report NAME LEAST ARGUMENT…: prints gcovr's report for some files, and fails below a share of
# LEAST percent.
report() {
  local name=$1 least=$2 table=$build/$1.txt
  shift 2
  # Threads count executions without a lock, because locks would make tests far slower. As a result,
  # a counter may become negative.
  gcovr --root . --object-directory "$build" --gcov-ignore-parse-errors --fail-under-line "$least" \
    "$@" -o "$table" || failed=1
  cat "$table"
  summary+=("$name: $(awk '$1 == "TOTAL" { print $3 " of " $2 " lines, " $4 }' "$table"), at least $least %")
}

readers() {
  cmake --build "$build" -j "$(nproc)" --target io_read_tests io_write_tests truncation_tests fuzz_replay \
    ph-barcode ph-cluster ph-segment ph-distance ph-vectorise peak
  # Tests of speed are meaningless in a build without optimisation.
  for test in libph/io_read_tests libph/io_write_tests fuzz/truncation_tests; do
    "$build/tests/$test" --gtest_brief=1 --gtest_filter=-Gzip.BombsEndSoon
  done
  "$build/tests/fuzz/fuzz_replay" tests/corpus "$build/tests/fuzz/samples"
  # Tests may fail in this build because it is slow, or because gcov prints messages on standard
  # error. The tests of a release build are the reliable ones.
  ctest --test-dir "$build" --no-tests=error \
    -R '^(faults_corpus|random_runs|samples_are_read|ph_barcode_(formats|guesses|guesses_tables|masks|stored))$' ||
    echo "coverage.sh: what failed is counted all the same"
  # Code that only writes files is not counted.
  report readers 99 --filter libph/src/io/ \
    --exclude 'libph/src/io/(bytes/output_file|clouds/cloud_write|complexes/surface_write|barcodes/barcode_(io|json|binary|text))\.[ch]pp'
}

engines() {
  cmake --build "$build" -j "$(nproc)" --target tests/libph/all
  for test in "$build"/tests/libph/*_tests; do
    case $test in *io_*) continue ;; esac
    PH_TEST_SEEDS=0.02 "$test" --gtest_brief=1
  done
  report engines 97 --filter libph/src/ --filter libph/include/ph/detail/ \
    --exclude 'libph/src/(io|plot|c|gpu|core/system)/'
}

[ $# -gt 0 ] || set -- readers engines
for part; do
  case $part in
    readers|engines) ;;
    *) echo "coverage.sh: found '$part', expected readers or engines" >&2; exit 64 ;;
  esac
done
scripts/setup.sh build coverage
cmake --preset coverage -B "$build" >/dev/null
for part; do
  find "$build" -name '*.gcda' -delete
  "$part"
done
printf '%s\n' "${summary[@]}"
exit "$failed"
