# SPDX-License-Identifier: MIT
"""tuning_table.py PH_SEGMENT TUNING.md: checks that the program states and uses the defaults in the
table of docs/how-to/tuning.md."""
import json
import os
import re
import subprocess
import sys
import tempfile

PROGRAM, PAGE = sys.argv[1:3]
METHODS = ("surface", "paper", "supervoxels")
IN_JSON = {"--plane-distance": "plane_distance", "--max-range": "max_range",
           "--plane-noise": "plane_noise", "--distance": "distance", "--steps": "steps",
           "--supervoxels": "spacing"}
IN_CUT = {"--min-persistence": "value", "--cut": "value", "--min-part": "min_part",
          "--min-size": "min_size"}


def rows():
    with open(PAGE, encoding="utf-8") as file:
        lines = [line for line in file if line.startswith("| `--")]
    for line in lines:
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if len(cells) == 7:
            for option in re.findall(r"--[a-z-]+", cells[0]):
                yield option, dict(zip(METHODS, cells[3:6]))


def summary(folder, method):
    """The values that a run reports if only the method is given."""
    cloud = os.path.join(folder, "cloud.xyz")
    with open(cloud, "w", encoding="ascii") as file:
        file.writelines(f"{x / 100} {y / 100} 1\n" for x in range(20) for y in range(20))
    run = subprocess.run([PROGRAM, cloud, "--method", method, "--json", "-", "--quiet"],
                         capture_output=True, check=True)
    return json.loads(run.stdout)


def main():
    text = subprocess.run([PROGRAM, "--help", "all"], capture_output=True, check=True, text=True).stdout
    known = set(re.findall(r"^  (--[a-z-]+)", text, re.MULTILINE))
    table = dict(rows())
    faults = [f"{option}: not an option" for option in table if option not in known]
    if len(table) < 20:
        faults.append(f"{len(table)} options in the table, expected 20 or more")
    checked = 0
    with tempfile.TemporaryDirectory() as folder:
        for method in METHODS:
            made = summary(folder, method)
            for option, cells in table.items():
                cell = cells[method]
                if cell == "–" or option not in {**IN_JSON, **IN_CUT}:
                    continue
                found = (made["options"][IN_JSON[option]] if option in IN_JSON
                         else made["cut"][IN_CUT[option]])
                checked += 1
                if float(cell) != float(found):
                    faults.append(f"{option}, {method}: {cell} in the table, {found} in a run")
    # A run does not report these values, because the size of a voxel also depends on the points.
    voxel = re.search(r"edge of a voxel, metres\s+\(default:\s+([\d.]+),\s+paper:\s+([\d.]+)\)", text)
    stated = tuple(table["--voxel"][method] for method in METHODS)
    if not voxel or stated != (voxel[1], voxel[2], voxel[1]):
        faults.append(f"--voxel: {stated} in the table, {voxel and voxel.groups()} in the help")
    print("\n".join([*faults, f"{checked} defaults compared, {len(faults)} faults"]))
    return 1 if faults or checked < 21 else 0


sys.exit(main())
