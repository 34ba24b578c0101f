#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# coverage.sh: the lines of the readers that their tests, the samples, their prefixes and the seeds of
# fuzzing reach. Exits 1 below 95 % in all. COVERAGE_BUILD: another build folder.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${COVERAGE_BUILD:-build/coverage}
least=95

scripts/setup.sh build coverage
cmake --preset coverage -B "$build" >/dev/null
cmake --build "$build" -j "$(nproc)" --target io_read_tests io_write_tests truncation_tests fuzz_replay
find "$build" -name '*.gcda' -delete
# A test of time means nothing in a build without optimisation.
for test in libph/io_read_tests libph/io_write_tests fuzz/truncation_tests; do
  "$build/tests/$test" --gtest_brief=1 --gtest_filter=-Gzip.BombsEndSoon
done
"$build/tests/fuzz/fuzz_replay" tests/corpus "$build/tests/fuzz/samples"

# What only writes is not counted.
gcovr --root . --object-directory "$build" --filter libph/src/io/ \
  --exclude 'libph/src/io/(bytes/output_file|clouds/cloud_write|barcodes/barcode_(io|json|binary|text))\.[ch]pp' \
  --fail-under-line "$least"
