#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that everything that a forge is told to run exists: workflows.py ROOT.

ROOT/.github/workflows has YAML files. Each file states its events and permissions. Each job says
where it runs, and has a time limit and steps. Each step runs a command or uses an action of a
stated version. A program must belong to the runner image or be an executable file of this
repository. Presets must exist in CMakePresets.json, with a build preset and a test preset of the
same name if they are built and tested. Sets must exist in scripts/setup.sh, platforms in
scripts/platforms.sh, and so on. Forms of .github/ISSUE_TEMPLATE have a name, a description and a
body. Exit code 77: PyYAML is missing, or there is no such folder, as in an archive of the sources.
"""
import itertools
import json
import os
import re
import shlex
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
OF_THE_IMAGE = {"apt-get", "git", "cmake", "ctest"}
WORD = re.compile(r"\$\{\{ *matrix\.([\w-]+) *\}\}")


def names_of_presets(kind):
    presets = json.loads((SOURCE / "CMakePresets.json").read_text(encoding="utf-8"))
    return {preset["name"] for preset in presets[kind + "Presets"] if not preset.get("hidden")}


def cases_of(script):
    """The words that a script accepts, which are the patterns of the `case` that reports invalid
    ones."""
    text = (SOURCE / script).read_text(encoding="utf-8")
    patterns = re.findall(r"^ +([a-z][\w|-]*)\)(?: |$)", text, re.MULTILINE)
    return {word for pattern in patterns for word in pattern.split("|")}


def variants(text, matrix):
    """A command with its matrix variables replaced: one text for each combination of their
    values."""
    names = sorted(set(WORD.findall(text)))
    for values in itertools.product(*(matrix.get(name, [None]) for name in names)):
        chosen = dict(zip(names, values))
        yield WORD.sub(lambda match: str(chosen[match[1]]), text)


def preset_faults(words):
    kind = "test" if words[0] == "ctest" else "build" if "--build" in words else "configure"
    if words[0] in ("cmake", "ctest"):
        preset = words[words.index("--preset") + 1] if "--preset" in words[:-1] else None
        if preset not in names_of_presets(kind):
            yield f"{' '.join(words)}: found no such {kind} preset in CMakePresets.json"


def command_faults(command):
    for part in re.split(r"&&|\n", command):
        words = shlex.split(part)
        if not words:
            continue
        program = words[0]
        if program not in OF_THE_IMAGE and not os.access(SOURCE / program, os.X_OK):
            yield f"{part.strip()}: found no program {program}"
        if program in ("scripts/setup.sh", "scripts/platforms.sh", "scripts/sanitize.sh", "scripts/lint.sh"):
            for word in set(words[1:]) - cases_of(program):
                yield f"{part.strip()}: {program} does not know {word}"
        yield from preset_faults(words)


def job_faults(job):
    if not job.get("runs-on"):
        yield "found no runs-on"
    if not job.get("timeout-minutes"):
        yield "found no timeout-minutes"
    matrix = job.get("strategy", {}).get("matrix", {})
    for step in job.get("steps") or [{}]:
        if ("run" in step) == ("uses" in step):
            yield "found a step with neither or both of run and uses"
        if "uses" in step and not re.fullmatch(r"[\w./-]+@v\d[\w.]*", step["uses"]):
            yield f"{step['uses']}: found no version of an action"
        for command in variants(step.get("run", ""), matrix):
            yield from command_faults(command)


def workflow_faults(content):
    # PyYAML reads the key `on` as true.
    if not content.get("on", content.get(True)):
        yield "found no events"
    if not content.get("permissions"):
        yield "found no permissions"
    for name, job in content.get("jobs", {}).items():
        yield from (f"{name}: {fault}" for fault in job_faults(job))


def form_faults(content):
    for key in ("name", "description", "body"):
        if not content.get(key):
            yield f"found no {key}"


def main():
    try:
        import yaml
    except ImportError:
        print("skipped: PyYAML is missing; scripts/setup.sh docs installs it")
        return 77
    forge = Path(sys.argv[1]).resolve() / ".github"
    if not forge.is_dir():
        print(f"skipped: found no {forge}")
        return 77
    faults, count = [], 0
    for folder, check in (("workflows", workflow_faults), ("ISSUE_TEMPLATE", form_faults)):
        for file in sorted((forge / folder).glob("*.yml")):
            count += 1
            try:
                content = yaml.safe_load(file.read_text(encoding="utf-8"))
            except yaml.YAMLError as error:
                faults.append(f"{file.name}: {error}")
                continue
            faults += [f"{file.name}: {fault}" for fault in check(content)]
    print("\n".join([*faults, f"{count} files, {len(faults)} faults"]))
    return 1 if faults or not count else 0


if __name__ == "__main__":
    sys.exit(main())
