#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes all packages of HEAD and tests them on minimal systems: check_packages.sh [PART]…
#
#   archives    makes dist/ with scripts/package.sh, and checks its checksums and the file
#               list of the source archive
#   build       runs dpkg-buildpackage on these archives, with its tests and without a network
#   lintian     fails on errors and warnings; counts other remarks
#   reproduce   makes archives and packages again in other folders, with a different umask,
#               language, time zone and home
#   install     on a bare Debian 12: installs with apt, makes a first picture, runs Python and a C++
#               program, and measures each; runs autopkgtest
#   elsewhere   runs the static programs on a system with only BusyBox, and on other releases of
#               Debian; measures the time from the archive to the picture
#
# install and elsewhere need root and a Debian mirror (PH_MIRROR; default: debootstrap's own).
# DEB_BUILD_OPTIONS is passed on: noautodbgsym saves minutes. The work folder is
# build/check-packages, or PH_WORK; each part uses the files that earlier parts left in it.
# PH_JOBS: number of parallel compilers.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
work=${PH_WORK:-$root/build/check-packages}
jobs=${PH_JOBS:-$(nproc)}
version=$(sed -n 's/^project(libph VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
source=dist/libph-$version.tar.xz
binary=dist/libph-$version-linux-$(uname -m).tar.xz
mirror=(${PH_MIRROR:+"$PH_MIRROR"})

fail() { echo "check_packages.sh: $1" >&2; exit 1; }

# offline COMMAND: runs a command without a network, because a Debian build has none. Only root can
# remove the network.
offline() { if [ "$(id -u)" -eq 0 ]; then unshare -n -- "$@"; else "$@"; fi; }

# debs FOLDER [OPTIONS]: unpacks the sources in the folder and builds all packages, with these
# additional options.
debs() {
  rm -rf "$1" && mkdir -p "$1"
  cp dist/debian/* "$1"
  (
    export DEB_BUILD_OPTIONS="parallel=$jobs ${DEB_BUILD_OPTIONS:-} ${2:-}"
    cd "$1" && dpkg-source -x libph_*.dsc >/dev/null &&
      cd "libph-$version" && offline dpkg-buildpackage -us -uc
  ) >"$1/build.log" 2>&1 ||
    { tail -n 30 "$1/build.log" >&2; fail "dpkg-buildpackage failed: $1/build.log"; }
}

archives() {
  scripts/package.sh
  /usr/bin/python3 -B tests/packages/archive.py . "$source"
  (cd dist && sha256sum --quiet -c SHA256SUMS)
}

build() {
  debs "$work/one"
  grep -h 'tests passed' "$work/one/build.log" || true
  (cd "$work/one" && ls -l ./*.deb | awk '{ print $5, $9 }')
}

lintian_() {
  local said=$work/lintian.txt
  lintian -EvIL +pedantic --show-overrides "$work"/one/*.changes >"$said" 2>/dev/null || true
  grep -q . "$said" || fail "lintian said nothing at all"
  ! grep '^[EW]: ' "$said" || fail "found errors or warnings of lintian"
  for kind in I P O X C; do echo "$kind: $(grep -c "^$kind: " "$said")"; done
  echo "all it said: $said"
}

# same A B: checks that two files have the same bytes.
same() {
  cmp -s "$1" "$2" && { sha256sum "$1" | sed "s|  .*/|  |"; return; }
  diffoscope --text "$work/diffoscope.txt" "$1" "$2" || true
  fail "$1 and $2 differ: $work/diffoscope.txt"
}

# The name of the second folder has no spaces, because dpkg-buildflags would not map a name with
# spaces to ".". In a source package that dpkg-buildpackage makes, file modes depend on the umask.
# For this reason, the source package in dist/ is compared.
reproduce() {
  (
    umask 027
    export HOME=$work/nowhere TZ=Pacific/Kiritimati LANG=C.UTF-8 LC_ALL=C.UTF-8 USER=somebody
    debs "$work/another/folder/with-a-longer-name" nocheck
  )
  for file in "$work"/one/*.deb; do
    same "$file" "$work/another/folder/with-a-longer-name/$(basename "$file")"
  done
  rm -rf "$work/clone" && git clone -q . "$work/clone"
  (umask 077; TZ=Asia/Tokyo LC_ALL=C.UTF-8 "$work/clone/scripts/package.sh" >/dev/null)
  for file in dist/*.tar.xz dist/*.json dist/debian/*; do same "$file" "$work/clone/$file"; done
}

# bare SUITE: makes a minimal system in a folder.
bare() {
  [ "$(id -u)" -eq 0 ] || fail "a bare system needs root"
  rm -rf --one-file-system "${work:?}/$1"
  debootstrap --variant=minbase "$1" "$work/$1" "${mirror[@]}" >"$work/debootstrap.log" 2>&1 ||
    { tail "$work/debootstrap.log" >&2; fail "debootstrap $1 failed"; }
}

# run_in SYSTEM COMMAND: runs a command in the system, which does not see the host's processes.
run_in() {
  unshare -m -p -f --kill-child sh -c 'mkdir -p "$1/proc" && mount -t proc proc "$1/proc" &&
    exec chroot "$1" /usr/bin/env -i HOME=/root TERM=dumb DEBIAN_FRONTEND=noninteractive \
      PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -ec "$2"' sh "$work/$1" "$2"
}

install_() {
  bare bookworm
  mkdir -p "$work/bookworm/root/debs"
  cp "$work"/one/*.deb "$work/bookworm/root/debs"
  cp -r examples tests/install "$work/bookworm/root"
  echo "== the programs, and a first picture"
  time run_in bookworm 'apt-get update -qq; cd /root/debs
    apt-get install -y -qq --no-install-recommends ./ph-tools_*.deb >/dev/null 2>&1; cd /root
    ph-barcode examples/data/two_circles.csv --plot bars.svg --report loops.html --quiet >/dev/null
    ph-barcode examples/data/two_circles.csv --plot bars.png --output-format none --quiet
    ls -l bars.svg bars.png loops.html | awk "{ print \$5, \$9 }"'
  echo "== Python"
  time run_in bookworm 'cd /root/debs
    apt-get install -y -qq --no-install-recommends ./python3-libph_*.deb >/dev/null 2>&1; cd /
    python3 -c "import libph; print(libph.__version__)
print(libph.rips([[0, 0], [1, 0], [1, 1], [0, 1]]).dgm(1))"'
  echo "== a program in C++"
  time run_in bookworm 'cd /root/debs
    apt-get install -y -qq --no-install-recommends ./libph-dev_*.deb ./libph-c1_*.deb \
      cmake g++ make >/dev/null 2>&1
    mkdir -p /root/tests; mv /root/install /root/tests/; cd /root/tests/install/find_package
    cmake -B /root/build >/dev/null; cmake --build /root/build >/dev/null 2>&1
    /root/build/consumer /root/examples/data/two_circles.csv'
  echo "== autopkgtest"
  bare bookworm
  local tested
  mapfile -t tested < <(find "$work/one" -maxdepth 1 -name '*.deb' ! -name '*-dbgsym_*')
  # Java, which PCL needs, cannot be installed without /proc, and dpkg writes no log without
  # /dev/pts.
  time unshare -m -p -f --kill-child --mount-proc sh -ec 'bed=$1; shift
    mount -t proc proc "$bed/proc"; mount -t devpts devpts "$bed/dev/pts"
    exec autopkgtest "$@" -- chroot "$bed"' \
    sh "$work/bookworm" "${tested[@]}" "$work/one/libph-$version/" >"$work/autopkgtest.log" 2>&1 ||
    { tail -n 40 "$work/autopkgtest.log"; fail "autopkgtest failed"; }
  sed -n '/@@@.* summary/,$p' "$work/autopkgtest.log"
}

# draw SYSTEM: runs the command from the archive's README in the unpacked folder.
draw() {
  tar -C "$work/$1" --strip-components=1 -xf "$binary"
  run_in "$1" "$(sed -n 's/^    \(bin\/ph-barcode .*\)/\1/p' "$work/$1/README.md") >/dev/null"
}

first_picture() {
  echo "== $1"
  time draw "$1"
  run_in "$1" "bin/ph-segment examples/table.pcd --quiet; bin/ph-barcode --version
    for file in bars.svg loops.html; do test -s \$file; done"
  echo "$(grep -c '<path\|<line\|<rect' "$work/$1/bars.svg") elements in bars.svg," \
    "$(stat -c %s "$work/$1/loops.html") bytes in loops.html"
}

elsewhere() {
  rm -rf "$work/busybox" && mkdir -p "$work"/busybox/{bin,usr/bin,proc,tmp,dev,root}
  cp /bin/busybox "$work/busybox/bin"
  ln -s /bin/busybox "$work/busybox/bin/sh" && ln -s /bin/busybox "$work/busybox/usr/bin/env"
  ln -s /bin/busybox "$work/busybox/bin/test"
  : >"$work/busybox/dev/null"
  first_picture busybox
  for suite in bullseye trixie sid; do bare $suite; first_picture $suite; done
}

scripts/setup.sh build page python packages
mkdir -p "$work"
[ $# -gt 0 ] || set -- archives build lintian reproduce install elsewhere
for part; do
  begun=$SECONDS
  echo "==== $part"
  case $part in
    archives | build | reproduce | elsewhere) "$part" ;;
    lintian | install) "${part}_" ;;
    *) fail "found '$part', expected archives, build, lintian, reproduce, install or elsewhere" ;;
  esac
  echo "==== $part: $((SECONDS - begun)) s"
done
