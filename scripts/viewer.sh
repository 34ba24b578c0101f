#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the report page, viewer/build/report-template.html, and runs its tests in headless
# Chromium: viewer.sh [build|test]. Installs missing packages first.
set -euo pipefail
cd "$(dirname "$0")/../viewer"

../scripts/setup.sh viewer
npm ci --no-audit --no-fund
npm run --silent build
if [ "${1:-test}" = test ]; then npm run --silent test; fi
