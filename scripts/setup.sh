#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the missing Debian packages of the named sets: setup.sh SET… The sets are build, page,
# demo, test, python, viewer, docs, packages, lint, fuzz, coverage, determinism, sanitize,
# clang-libcxx, aarch64 and mingw.
set -euo pipefail

build=(build-essential cmake ninja-build pkg-config ccache libeigen3-dev libfmt-dev
       zlib1g-dev libpng-dev libfreetype-dev fonts-dejavu-core libcli11-dev)
demo=(python3-numpy python3-skimage libcgal-demo)
# Programs that tests compare with, and tools that tests use.
test=(libgtest-dev libbenchmark-dev libpcl-dev libcgal-dev ripser python3-gudhi python3-numpy librsvg2-bin git
      python3-open3d jq strace
      locales zsh fish man-db groff mandoc abigail-tools slurm-wlm
      libopenmpi-dev openmpi-bin libmpich-dev mpich)
# The Python package, and the packages that its tests compare with.
python=(python3-dev pybind11-dev python3-numpy python3-scipy python3-sklearn python3-pandas
        python3-matplotlib python3-skimage pymol-data python3-pytest python3-mypy python3-venv python3-nbclient
        python3-ipykernel python3-distributed)
# The tools that bundle the report page; Node may also be installed without Debian's package.
page=()
command -v npm >/dev/null || page=(nodejs npm)
viewer=("${page[@]}" chromium)  # the tests in a browser need it as well
# Tools that make the documentation site.
docs=(python3-sphinx python3-myst-parser furo python3-breathe python3-sphinx-copybutton doxygen git
      python3-jsonschema hunspell hunspell-en-gb)
# Tools that make Debian packages, and tools that test them.
packages=(debhelper dh-python fakeroot xz-utils git libgtest-dev libpcl-dev libcgal-dev lintian diffoscope-minimal
          debootstrap autopkgtest busybox-static)
lint=(clang-format-14 clang-tidy-19 cppcheck libgtest-dev libcgal-dev)
fuzz=(clang-19 libclang-rt-19-dev libgtest-dev libcgal-dev)
coverage=(gcovr libgtest-dev libcgal-dev)
determinism=(clang-19 libcgal-dev qemu-user-static)
# Valgrind needs the symbols of the C library. For libstdc++'s debug mode, fmt and GoogleTest are
# compiled from source.
sanitize=(clang-19 libclang-rt-19-dev llvm-19 valgrind libc6-dbg googletest libgtest-dev libcgal-dev)
# Packages for scripts/platforms.sh, which compiles GoogleTest and fmt from source.
clang_libcxx=(clang-19 libc++-19-dev libc++abi-19-dev libunwind-19-dev googletest)
aarch64=(g++-aarch64-linux-gnu qemu-user-static googletest)
mingw=(g++-mingw-w64-x86-64-posix wine64 googletest dpkg-dev)

wanted=()
for set in "${@:-build}"; do
  case $set in
    build) wanted+=("${build[@]}") ;;
    page) wanted+=("${page[@]}") ;;
    demo) wanted+=("${page[@]}" "${demo[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    python) wanted+=("${build[@]}" "${python[@]}") ;;
    viewer) wanted+=("${viewer[@]}") ;;
    docs) wanted+=("${docs[@]}") ;;
    packages) wanted+=("${packages[@]}") ;;
    lint) wanted+=("${lint[@]}") ;;
    fuzz) wanted+=("${fuzz[@]}") ;;
    coverage) wanted+=("${coverage[@]}") ;;
    determinism) wanted+=("${determinism[@]}") ;;
    sanitize) wanted+=("${sanitize[@]}") ;;
    clang-libcxx) wanted+=("${clang_libcxx[@]}") ;;
    aarch64) wanted+=("${aarch64[@]}") ;;
    mingw) wanted+=("${mingw[@]}") ;;
    *) echo "setup.sh: found '$set', expected build, page, demo, test, python, viewer, docs, packages, lint, fuzz, coverage, determinism, sanitize, clang-libcxx, aarch64 or mingw" >&2; exit 64 ;;
  esac
done

missing=()
for package in "${wanted[@]}"; do
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
    missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
echo "installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
log=$(mktemp)
trap 'rm -f "$log"' EXIT
{
  "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"
} >"$log" 2>&1 || { cat "$log" >&2; exit 69; }
