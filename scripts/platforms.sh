#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# platforms.sh [clang-libcxx|aarch64|mingw]…: builds libraries and programs for another C++ library,
# another processor or another system, by default for all three, and runs the tests of libph there.
# Installs missing packages first. The last line for each platform shows the counts. JOBS: number of
# parallel jobs.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}
# Makes ccache share results between clones, including precompiled headers.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true
export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime

# The libraries for the other processor are unpacked, not installed. This needs neither root nor a
# foreign architecture in dpkg, and versions need not match the versions of local packages.
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

# Packages for Windows are unpacked in the same way; libpng and FreeType are built from Debian's
# sources.
unpack_mingw() {
  local root=$PWD/build/mingw-root
  [ -e "$root/complete" ] && return
  rm -rf "$root"
  mkdir -p "$root"/apt/{lists/partial,cache/archives/partial,sources}
  sed 's/^Types: .*/Types: deb deb-src/' /etc/apt/sources.list.d/debian.sources >"$root/apt/sources/debian.sources"
  local apt=(apt-get -qq -o Dir::State::Lists="$root/apt/lists" -o Dir::Cache="$root/apt/cache"
             -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$root/apt/sources"
             -o APT::Sandbox::User= -o Debug::NoLocking=1)
  "${apt[@]}" update
  local release
  release=$(. /etc/os-release && echo "$VERSION_CODENAME")
  (cd "$root/apt" && "${apt[@]}" download libeigen3-dev libcli11-dev libfmt-dev libz-mingw-w64-dev &&
    "${apt[@]}" source --download-only "libpng1.6/$release" "freetype/$release")
  local file
  for file in "$root"/apt/*.deb; do dpkg -x "$file" "$root"; done
  for file in "$root"/apt/*.dsc; do dpkg-source -x "$file" "${file%%_*}"; done
  local here=$root/usr/x86_64-w64-mingw32
  rm "$here/lib/libz.dll.a"  # without it, zlib is linked statically
  build_archive() {
    local source=$1
    shift
    cmake -S "$source" -B "$source/build" -G Ninja -D CMAKE_TOOLCHAIN_FILE="$PWD/cmake/mingw-w64.cmake" \
      -D CMAKE_BUILD_TYPE=Release -D CMAKE_INSTALL_PREFIX="$here" "$@"
    cmake --build "$source/build" -j "$jobs"
    cmake --install "$source/build"
  }
  build_archive "$root/apt/libpng1.6" -D PNG_SHARED=OFF -D PNG_TESTS=OFF
  build_archive "$root/apt/freetype" -DFT_DISABLE_{HARFBUZZ,BROTLI,BZIP2,PNG}=ON -DFT_REQUIRE_ZLIB=ON
  rm -r "$root/apt"
  touch "$root/complete"
}

test_libph() {
  ctest --test-dir "build/$1/tests/libph" -j "$jobs" -LE quick --output-on-failure --no-tests=error \
    --output-junit "$PWD/build/$1/tests.xml"
}

# Checks that the programs of another platform print and write the same bytes as the programs built
# here.
compare_outputs() {
  cmake --preset release >/dev/null
  cmake --build --preset release -j "$jobs" --target ph-barcode ph-cluster ph-distance ph-segment ph-vectorise
  python3 tests/platforms/same_outputs.py build/release "$@"
}

run() {
  local platform=$1 status=0
  scripts/setup.sh build "$platform"
  case $platform in
    aarch64) unpack_arm64 ;;
    mingw) unpack_mingw
      export WINEPREFIX=$PWD/build/wine WINEDEBUG=-all
      # Sets up Wine's folder first: programs that start together would each set it up.
      [ -d "$WINEPREFIX" ] || /usr/lib/wine/wine64 wineboot --init >/dev/null 2>&1
      # The server stays for 60 s, because a program cannot start while the previous server is
      # shutting down.
      /usr/lib/wine/wineserver -p60 || true ;;
  esac
  cmake --preset "$platform"
  cmake --build --preset "$platform" -j "$jobs"
  case $platform in
    clang-libcxx) test_libph "$platform" || status=$?
      compare_outputs "build/$platform" || status=$? ;;
    aarch64)  # emulated, hence a tenth of the random inputs and ten times the time limit
      PH_TEST_SEEDS=0.1 PH_TEST_PATIENCE=10 test_libph "$platform" || status=$?
      compare_outputs "build/$platform" qemu-aarch64-static || status=$? ;;
    mingw) PH_TEST_SEEDS=0.1 PH_TEST_PATIENCE=10 test_libph "$platform" || status=$?
      compare_outputs "build/$platform" /usr/lib/wine/wine64 || status=$? ;;
    *) echo "platforms.sh: found '$platform', expected clang-libcxx, aarch64 or mingw" >&2; return 64 ;;
  esac
  awk -F'"' -v platform="$platform" '/^[ \t]*tests=/ { tests = $2 } /^[ \t]*failures=/ { failed = $2 }
    /^[ \t]*skipped=/ { skipped = $2 } /<testcase/ { exit }
    END { printf "%s: %d passed, %d failed, %d skipped\n", platform, tests - failed - skipped, failed, skipped }' \
    "build/$platform/tests.xml"
  return "$status"
}

[ $# -gt 0 ] || set -- clang-libcxx aarch64 mingw
failed=0
for platform; do run "$platform" || failed=1; done
exit "$failed"
