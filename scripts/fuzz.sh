#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# fuzz.sh [TARGET [libFuzzer options…]]: looks for bytes that break what tests/fuzz promises. Without
# a target: each for a minute. What it learns stays in build/fuzz/corpus/TARGET, what it finds in
# build/fuzz/findings/TARGET. FUZZ_BUILD: another build folder.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${FUZZ_BUILD:-build/fuzz}
[ $# -gt 0 ] && target=$1 && shift

scripts/setup.sh build fuzz
cmake --preset fuzz -B "$build" >/dev/null
cmake --build "$build" --target fuzz samples
programs=$build/tests/fuzz

fuzz() {
  local target=$1 dictionary
  shift
  for dictionary in "$target" "${target%%_*}" numbers; do
    [ -f "tests/fuzz/dictionaries/$dictionary.dict" ] && break
  done
  local seeds=("$programs/samples")
  [ -d "tests/corpus/$target" ] && seeds+=("tests/corpus/$target")
  mkdir -p "$build/corpus/$target" "$build/findings/$target"
  ln -sf fuzz "$programs/fuzz_$target"
  "$programs/fuzz_$target" "$build/corpus/$target" "${seeds[@]}" -max_len=4096 -timeout=5 \
    -rss_limit_mb=2048 -malloc_limit_mb=80 -artifact_prefix="$build/findings/$target/" \
    -dict="tests/fuzz/dictionaries/$dictionary.dict" -print_final_stats=1 "$@"
}

if [ -n "${target:-}" ]; then
  fuzz "$target" "$@"
else
  for target in $("$programs/fuzz" --targets); do fuzz "$target" -max_total_time=60; done
fi
