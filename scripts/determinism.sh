#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# determinism.sh [COMPILER-LEVEL[-ARCH]|Nehalem|max]…: checks that all variants write the same
# bytes. A variant such as clang-O2 or gcc-O3-v3 is a build with a compiler (gcc or clang), a level
# (O0 to O3) and instructions: x86-64 (default), v3 (AVX2, FMA) or v4 (AVX-512). The variants
# Nehalem (SSE 4.2) and max (AVX2, FMA) are processors that QEMU emulates; they run the programs of
# REFERENCE. platforms.sh checks 64-bit ARM and other C++ libraries. REFERENCE: the build to compare
# with (default: build/release, built here); JOBS: number of parallel jobs. The last lines show the
# counts of each variant.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}
# Makes ccache share results between clones, including precompiled headers.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true
export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
programs=(ph-barcode ph-cluster ph-distance ph-segment ph-vectorise)
summary=()

build_with() {
  local variant=$1 compiler level arch
  IFS=- read -r compiler level arch <<<"$variant"
  local flags=-$level compilers=(-D CMAKE_C_COMPILER=gcc -D CMAKE_CXX_COMPILER=g++)
  [ "$compiler" = gcc ] || compilers=(-D CMAKE_C_COMPILER=clang-19 -D CMAKE_CXX_COMPILER=clang++-19)
  [ -z "$arch" ] || flags+=" -march=x86-64-$arch"
  # The build type is not Release, which would set an optimisation level. The programs are not
  # linked statically, because valgrind checks them as well.
  cmake -G Ninja -B "build/determinism/$variant" "${compilers[@]}" -D CMAKE_BUILD_TYPE=None \
    -D CMAKE_CXX_FLAGS="$flags" -D PH_UNITY=ON -D PH_STATIC_PROGRAMS=OFF -D PH_WITH_REPORT=OFF \
    -D PH_BUILD_TESTS=OFF -D PH_BUILD_EXAMPLES=OFF -D PH_INSTALL=OFF >/dev/null
  cmake --build "build/determinism/$variant" -j "$jobs" --target "${programs[@]}"
}

[ $# -gt 0 ] || set -- gcc-O{0,1,2,3} gcc-O3-v{3,4} clang-O{0,1,2,3} clang-O3-v3 Nehalem max
scripts/setup.sh build determinism
if [ -z "${REFERENCE:-}" ]; then
  REFERENCE=build/release
  cmake --preset release >/dev/null
  cmake --build --preset release -j "$jobs" --target "${programs[@]}"
fi

failed=0
for variant; do
  emulator=()
  case $variant in
    gcc-O[0-3]|gcc-O[0-3]-v[34]|clang-O[0-3]|clang-O[0-3]-v[34])
      build_with "$variant" || { summary+=("$variant: not built"); failed=1; continue; }
      other=build/determinism/$variant
      case $variant in  # an emulator runs instructions that this processor lacks
        *-v3) grep -qw avx2 /proc/cpuinfo || emulator=(qemu-x86_64-static -cpu max) ;;
        *-v4) grep -qw avx512f /proc/cpuinfo || { summary+=("$variant: built, not run: no AVX-512 here"); continue; } ;;
      esac ;;
    Nehalem|max) other=$REFERENCE emulator=(qemu-x86_64-static -cpu "$variant") ;;
    *) echo "determinism.sh: found '$variant', expected such as gcc-O0, clang-O3-v3, Nehalem or max" >&2; exit 64 ;;
  esac
  log=build/determinism/$variant.log
  mkdir -p build/determinism
  python3 -B tests/platforms/same_outputs.py "$REFERENCE" "$other" "${emulator[@]}" | tee "$log" || failed=1
  summary+=("$variant: $(tail -1 "$log")")
done
printf '%s\n' "${summary[@]}"
exit "$failed"
