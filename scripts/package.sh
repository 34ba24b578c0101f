#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the archives for distribution in dist/: package.sh [source|binary]… (default: both)
#
#   libph-VERSION.tar.xz               the sources of HEAD, with the bundled report page
#   debian/                            the sources as a Debian source package
#   libph-VERSION-linux-MACHINE.tar.xz the programs, linked statically, for any Linux on MACHINE
#   libph-VERSION-linux-MACHINE.spdx.json   the contents of the programs (SPDX 2.3)
#   SHA256SUMS
#
# The same commit with the same Debian packages gives the same bytes. PH_JOBS: number of parallel
# compilers.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C TZ=UTC
umask 022

version=$(sed -n 's/^project(libph VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
name=libph-$version
target=$name-linux-$(uname -m)
dist=$PWD/dist
work=$PWD/build/package

fail() { echo "package.sh: $1" >&2; exit "$2"; }

# pack FOLDER ARCHIVE: packs the files, sorted by name, with root as the owner and with the time of
# the commit.
pack() {
  tar -C "$(dirname "$1")" --sort=name --format=ustar --owner=0 --group=0 --numeric-owner \
    --mode=u+rwX,go+rX,go-w --mtime="@$SOURCE_DATE_EPOCH" -c "$(basename "$1")" |
    xz -9 --threads=1 >"$2"
  echo "${2#"$PWD"/}: $(stat -c %s "$2") bytes"
}

# add_page: adds the report page, and the original files of the npm packages that are bundled in it.
add_page() {
  (cd viewer && npm ci --no-audit --no-fund --prefer-offline --silent && npm run --silent build)
  mkdir -p "$1/viewer/build"
  cp viewer/build/report-template.html viewer/build/report-template.inputs "$1/viewer/build"
  (
    cd viewer
    packages=$(sed -nE 's!^(node_modules/(@[^/]+/)?[^/]+)/.*!\1!p' build/report-template.inputs | sort -u)
    for package in $packages; do printf '%s\n' "$package/package.json" "$package/LICENSE"; done
    grep ^node_modules/ build/report-template.inputs
  ) | tar -C viewer -c -T - | tar -C "$1/viewer" -x
}

make_source() {
  git diff-index --quiet HEAD -- || fail "found changes that are not committed, expected none: the archive is that of HEAD" 65
  scripts/setup.sh page
  rm -rf "$work/source" && mkdir -p "$work/source"
  git archive --prefix="$name/" HEAD | tar -C "$work/source" -x
  add_page "$work/source/$name"
  pack "$work/source/$name" "$dist/$name.tar.xz"
  # Without SOURCE_DATE_EPOCH, dpkg-source takes the time from debian/changelog, as in
  # dpkg-buildpackage.
  rm -rf "$dist/debian" && mkdir "$dist/debian"
  cp "$dist/$name.tar.xz" "$dist/debian/libph_$version.orig.tar.xz"
  git -c tar.umask=0022 archive --prefix=debian/ HEAD:debian | tar -C "$work/source/$name" -x
  (cd "$dist/debian" && unset SOURCE_DATE_EPOCH && dpkg-source -b "$work/source/$name" >/dev/null)
}

readme() {
  cat <<END
# libph $version: ph-barcode, ph-cluster, ph-distance, ph-segment and ph-vectorise

They run on any Linux of $(uname -m), and need nothing else. A first picture:

    bin/ph-barcode examples/two_circles.csv --plot bars.svg --report loops.html --output-format none

bars.svg and loops.html open in a browser. \`man -l share/man/man1/ph-barcode.1\` is the manual.
libph is MIT (LICENSE). What else is in the programs, and under which licences, is in licences/ and
libph.spdx.json; portions are copyright The FreeType Project (www.freetype.org). glibc is LGPL:
$name.tar.xz builds the programs anew, with another one if you like.
END
}

# Builds the programs from the source archive, which shows that the archive is complete.
make_binary() {
  scripts/setup.sh build
  [ -f "$dist/$name.tar.xz" ] || make_source
  rm -rf "$work/binary" && mkdir -p "$work/binary"
  tar -C "$work/binary" -xf "$dist/$name.tar.xz"
  local tree=$work/binary/$name stage=$work/binary/$target
  local build=$tree/build
  cmake -S "$tree" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    "-DCMAKE_CXX_FLAGS=-ffile-prefix-map=$tree=." -DPH_UNITY=ON \
    -DPH_BUILD_TESTS=OFF -DPH_BUILD_EXAMPLES=OFF -DPH_WITH_CGAL=OFF \
    -DPH_STATIC_PROGRAMS=ON -DPH_WITH_FREETYPE=ON -DPH_WITH_REPORT=ON >"$work/binary.log"
  cmake --build "$build" -j "${PH_JOBS:-$(nproc)}" >>"$work/binary.log" ||
    { tail -n 40 "$work/binary.log" >&2; fail "the build failed; all it said: $work/binary.log" 70; }
  cmake --install "$build" --prefix "$stage" --component programs --strip >>"$work/binary.log"
  mkdir "$stage/examples"
  cp "$tree/examples/data/two_circles.csv" "$tree/examples/data/table.pcd" "$stage/examples"
  cp "$tree/LICENSE" "$stage"
  readme >"$stage/README.md"
  python3 -B "$tree/scripts/sbom.py" "$build" -o "$stage/libph.spdx.json" --licences "$stage/licences"
  cp "$stage/libph.spdx.json" "$dist/$target.spdx.json"
  pack "$stage" "$dist/$target.tar.xz"
}

SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
mkdir -p "$dist"
for what in "${@:-source binary}"; do
  for part in $what; do
    case $part in
      source) make_source ;;
      binary) make_binary ;;
      *) fail "found '$part', expected source or binary" 64 ;;
    esac
  done
done
(cd "$dist" && sha256sum -- libph-* debian/* >SHA256SUMS)
