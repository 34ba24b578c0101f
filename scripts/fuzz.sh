#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# fuzz.sh [--fast] [TARGET [libFuzzer options…]]: searches for bytes that break the promises in
# tests/fuzz. Without a target, each target runs for a minute. Learned inputs stay in
# build/fuzz/corpus/TARGET, findings in build/fuzz/findings/TARGET. FUZZ_BUILD: another build folder.
# --fast: two to six times as many executions, without sanitizers and with only readers and command
# lines instrumented; afterwards, the learned inputs run with sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${FUZZ_BUILD:-build/fuzz}
fast=
[ "${1:-}" = --fast ] && fast=$build-fast && shift
[ $# -gt 0 ] && target=$1 && shift

scripts/setup.sh build fuzz
cmake --preset fuzz -B "$build" >/dev/null
cmake --build "$build" --target fuzz samples
if [ -n "$fast" ]; then
  cmake --preset fuzz-fast -B "$fast" >/dev/null
  cmake --build "$fast" --target fuzz
fi

fuzz() {
  local target=$1 dictionary
  shift
  for dictionary in "$target" "${target##*_}" "${target%%_*}" numbers; do
    dictionary=tests/fuzz/dictionaries/$dictionary.dict
    [ -f "$dictionary" ] && break
  done
  if [[ $target == *_arguments ]]; then  # the options and their choices are taken from the help
    "$build/tests/fuzz/fuzz" --help-of "$target" |
      grep -oE -- '--?[a-z][a-z-]*|[[:alnum:]-]+(\|[[:alnum:]-]+)+' | tr '|' '\n' | sort -u |
      sed 's/.*/"&"/' | cat "$dictionary" - >"$build/$target.dict"
    dictionary=$build/$target.dict
  fi
  local corpus=$build/corpus/$target findings=$build/findings/$target
  local seeds=("$build/tests/fuzz/samples")
  [ -d "tests/corpus/$target" ] && seeds+=("tests/corpus/$target")
  mkdir -p "$corpus" "$findings"
  local options=(-max_len=4096 -timeout=5 -rss_limit_mb=2048 "-artifact_prefix=$findings/"
    "-dict=$dictionary" -print_final_stats=1)
  local program
  for program in "$build" ${fast:+"$fast"}; do ln -sf fuzz "$program/tests/fuzz/fuzz_$target"; done
  [ -z "$fast" ] || "$fast/tests/fuzz/fuzz_$target" "$corpus" "${seeds[@]}" "${options[@]}" "$@"
  "$build/tests/fuzz/fuzz_$target" "$corpus" "${seeds[@]}" "${options[@]}" -malloc_limit_mb=80 \
    "$@" ${fast:+-runs=0}
}

if [ -n "${target:-}" ]; then
  fuzz "$target" "$@"
else
  for target in $("$build/tests/fuzz/fuzz" --targets); do fuzz "$target" -max_total_time=60; done
fi
