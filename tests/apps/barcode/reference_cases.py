# SPDX-License-Identifier: MIT
"""All reference cases through a built ph-barcode: reference_cases.py PROGRAM SHARED-FOLDER."""
import os
import subprocess
import sys

program, shared = sys.argv[1:3]
driver = os.path.join(shared, "tools", "run_cases.py")
if not os.path.exists(driver):
    print(f"SKIPPED: the reference cases are not here ({driver})")
    sys.exit(77)
sys.exit(subprocess.run([sys.executable, "-B", driver, program]).returncode)
