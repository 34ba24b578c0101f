# SPDX-License-Identifier: MIT
"""Runs programs that segment a single frame: ph-segment and its peers, through one interface."""
import argparse
import csv
import json
import pathlib
import re
import shlex
import subprocess

import point_clouds

OURS = "libph"


class Program:
    """NAME and COMMAND of a program. In the command, {input} stands for the PCD file, {folder} and
    {name} for its folder and its name without .pcd, {output} for a path without an ending, to which
    the program appends .npy, .pgm or .pcd, and {outputs} for the folder of that path. Words
    KEY=VALUE may precede the command: background=B means that labels up to B are not segments, and
    stages=FILE names the file with the seconds of each stage, which is CSV with columns t_NAME or
    the JSON of ph-segment.

    """

    def __init__(self, name, command):
        self.name, self.text = name, command
        self.settings = {}
        self._words = shlex.split(command)
        while self._words and (
            setting := re.fullmatch(r"(background|stages)=(.*)", self._words[0])
        ):
            self.settings[setting[1]] = setting[2]
            self._words.pop(0)

    @property
    def makes_supervoxels(self):
        """True if the program makes supervoxels, which are pieces of objects and have their own
        scores."""
        return "supervoxels" in self.name

    @property
    def is_ours(self):
        return self.name.split()[0] == OURS

    def _filled(self, text, scene, output):
        values = {
            "input": scene,
            "folder": scene.parent,
            "name": scene.stem,
            "output": output,
            "outputs": output.parent,
        }
        return re.sub(r"{(\w+)}", lambda m: str(values.get(m[1], m[0])), text)

    def command(self, scene, folder):
        return [self._filled(word, scene, folder / scene.stem) for word in self._words]

    def labels(self, scene, folder):
        """Runs the program and returns one label per point; 0 means no segment."""
        folder.mkdir(parents=True, exist_ok=True)
        run = subprocess.run(
            self.command(scene, folder), capture_output=True, text=True, check=False
        )
        labels = point_clouds.read_labels(folder / scene.stem)
        if run.returncode != 0 or labels is None:
            raise RuntimeError(
                f"{self.name}: {scene.name}: exit {run.returncode}, "
                f"{'no' if labels is None else 'with'} labels: {run.stderr[-400:]}"
            )
        for file in folder.glob(f"{scene.stem}.*"):
            file.unlink()
        background = int(self.settings.get("background", 0))
        labels[labels <= background] = 0
        return labels

    def stages(self, scene, folder):
        """The seconds of each stage of the last run, or nothing."""
        if "stages" not in self.settings:
            return {}
        path = pathlib.Path(self._filled(self.settings["stages"], scene, folder / scene.stem))
        if path.suffix == ".json":
            summary = json.loads(path.read_text())
            stages = {stage["name"]: stage["seconds"] for stage in summary["stages"]}
            return {"load": summary["timings"]["read"], **stages}
        with path.open() as file:
            last = list(csv.DictReader(file))[-1]
        return {
            key[2:]: float(value)
            for key, value in last.items()
            if key.startswith("t_") and key != "t_total" and value
        }


def peer(text):
    """The program of an argument NAME = COMMAND."""
    name, equals, command = text.partition(" = ")
    if not equals or "{input}" not in command and "{name}" not in command:
        raise argparse.ArgumentTypeError(f"{text!r}: expected NAME = COMMAND with {{input}} in it")
    return Program(name.strip(), command.strip())


def ours(build, options=""):
    program = shlex.quote(str(build / "apps/segment/ph-segment"))
    # Measures the stages on one thread. The check of the tree runs by default and is timed as a
    # separate stage.
    return Program(
        f"{OURS} {options}".strip(),
        f"stages={{output}}.json {program} {{input}} --quiet --threads 1 "
        f"--labels {{output}}.npy --json {{output}}.json {options}",
    )
