#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs a test of the page for CTest: run.sh FILE [ARGUMENTS]. Exit code 77, with the reason, if a
# required tool is missing.
set -eu
here=${0%/*}
skip() {
  echo "SKIPPED: $1 (scripts/viewer.sh installs it)"
  exit 77
}
command -v node >/dev/null || skip "no node"
[ -d "$here/../node_modules/playwright-core" ] || skip "no npm packages in viewer/"
[ -x "${CHROMIUM:-/usr/bin/chromium}" ] || skip "no Chromium"
[ -f "${PH_REPORT_TEMPLATE:-$here/../build/report-template.html}" ] || skip "no built page"
file=$1
shift
exec node "$here/$file" "$@"
