#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# platforms.sh [clang-libcxx|aarch64]…: builds libraries and programs for another C++ library or
# another processor, and runs the tests of libph; without arguments: for each. Installs what is missing
# first. The last line of each shows the counts. JOBS: how many at a time.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}
# What was compiled in another clone counts here, precompiled headers included.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true
export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime

# The libraries for the other processor, unpacked and not installed: neither root nor a foreign
# architecture in dpkg is needed, and no package here has to have the version of one there.
unpack_arm64() {
  local root=$PWD/build/aarch64-root
  [ -e "$root/complete" ] && return
  rm -rf "$root"
  mkdir -p "$root/apt/lists/partial" "$root/apt/cache/archives/partial"
  local apt=(apt-get -qq -o Dir::State::Lists="$root/apt/lists" -o Dir::Cache="$root/apt/cache"
             -o APT::Architectures::=arm64 -o APT::Sandbox::User= -o Debug::NoLocking=1)
  "${apt[@]}" update
  (cd "$root/apt" && "${apt[@]}" download libeigen3-dev libcli11-dev \
    {zlib1g-dev,zlib1g,libpng-dev,libpng16-16,libfreetype-dev,libfreetype6,libbrotli-dev,libbrotli1,libfmt-dev,libfmt9}:arm64)
  local package
  for package in "$root"/apt/*.deb; do dpkg -x "$package" "$root"; done
  rm -r "$root/apt"
  touch "$root/complete"
}

test_libph() {
  ctest --test-dir "build/$1/tests/libph" -j "$jobs" -LE quick --output-on-failure --no-tests=error \
    --output-junit "$PWD/build/$1/tests.xml"
}

# What programs print and write is the same bytes as here.
compare_outputs() {
  cmake --preset release >/dev/null
  cmake --build --preset release -j "$jobs" --target ph-barcode ph-distance ph-segment ph-vectorise
  python3 tests/platforms/same_outputs.py build/release "$@"
}

run() {
  local platform=$1 status=0
  scripts/setup.sh build "$platform"
  [ "$platform" != aarch64 ] || unpack_arm64
  cmake --preset "$platform"
  cmake --build --preset "$platform" -j "$jobs"
  case $platform in
    clang-libcxx) test_libph "$platform" || status=$?
      compare_outputs "build/$platform" || status=$? ;;
    aarch64)  # instructions are translated: a tenth of the random inputs, ten times as long
      PH_TEST_SEEDS=0.1 PH_TEST_PATIENCE=10 test_libph "$platform" || status=$?
      compare_outputs "build/$platform" qemu-aarch64-static || status=$? ;;
    *) echo "platforms.sh: found '$platform', expected clang-libcxx or aarch64" >&2; return 64 ;;
  esac
  awk -F'"' -v platform="$platform" '/^[ \t]*tests=/ { tests = $2 } /^[ \t]*failures=/ { failed = $2 }
    /^[ \t]*skipped=/ { skipped = $2 } /<testcase/ { exit }
    END { printf "%s: %d passed, %d failed, %d skipped\n", platform, tests - failed - skipped, failed, skipped }' \
    "build/$platform/tests.xml"
  return "$status"
}

[ $# -gt 0 ] || set -- clang-libcxx aarch64
failed=0
for platform; do run "$platform" || failed=1; done
exit "$failed"
