# SPDX-License-Identifier: MIT
"""Runs all reference cases through a built ph-barcode: reference_cases.py PROGRAM.

The environment variable PH_TEST_DATA names the folder with the cases."""
import os
import subprocess
import sys

program, data = sys.argv[1], os.environ.get("PH_TEST_DATA", "")
driver = os.path.join(data, "tools", "run_cases.py")
if not data or not os.path.exists(driver):
    print(f"SKIPPED: PH_TEST_DATA, which is {data!r}, has no tools/run_cases.py: no reference case is tested")
    sys.exit(77)
sys.exit(subprocess.run([sys.executable, "-B", driver, program]).returncode)
