#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the documentation as a site, build/site/html/index.html: site.sh [FOLDER]. Installs missing
# packages first. The programs and the Python module are taken from build/release, or from
# PH_BUILD_DIR. If one is missing, its pages are left out with a message.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh docs
build=${PH_BUILD_DIR:-build/release}
found=(--folder "${1:-build/site}")
for name in barcode cluster distance segment vectorise; do
  program=$build/apps/$name/ph-$name
  [ ! -x "$program" ] || found+=("--$name" "$program")
done
for package in "$build/python" python; do
  if PYTHONPATH=$package /usr/bin/python3 -B -c 'import libph._core' 2>/dev/null; then
    found+=(--package "$package")
    break
  fi
done
exec /usr/bin/python3 -B docs/site/build.py "${found[@]}"
