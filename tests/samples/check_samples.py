# SPDX-License-Identifier: MIT
"""check_samples.py PH_BARCODE PH_SEGMENT: checks that the programs read every sample that is meant
for them."""
import os
import subprocess
import sys
import tempfile

import samples


def arguments_of(sample):
    return [argument.format(sample.name) for argument in sample.arguments]


def run(sample, programs, folder):
    """@return what is wrong, or nothing."""
    for name in sample.needs:
        needed = next(s for s in samples.SAMPLES if s.name == name)
        with open(os.path.join(folder, name), "wb") as file:
            file.write(needed.content)
    with open(os.path.join(folder, sample.name), "wb") as file:
        file.write(sample.content)
    done = subprocess.run([programs[sample.program], *arguments_of(sample)], cwd=folder, text=True,
                          capture_output=True, timeout=60, check=False)
    if done.returncode != 0:
        return f"exit code {done.returncode}: {done.stderr.strip()}"
    return "" if done.stdout else "no output"


def main():
    programs = {"ph-barcode": os.path.abspath(sys.argv[1]), "ph-segment": os.path.abspath(sys.argv[2])}
    faults = tried = 0
    for sample in samples.SAMPLES:
        if not sample.program:
            continue
        with tempfile.TemporaryDirectory() as folder:
            fault = run(sample, programs, folder)
        tried += 1
        if fault:
            faults += 1
            print(f"{sample.reader}/{sample.name}: {fault}")
    print(f"{tried} samples, {faults} not read")
    sys.exit(1 if faults or not tried else 0)


if __name__ == "__main__":
    main()
