#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Regenerates the pictures of the pages: make.py [BUILD], by default build/release.

pages/     what the commands of pages draw (tests/docs/commands_in_pages.py compares them)
gallery/   the reports of gallery.md as a browser shows them; left out without Chromium
vectors.png  what vectors.py draws; left out without matplotlib
*.png      what python/examples draws; left out without the compiled module and matplotlib
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

IMAGES = Path(__file__).resolve().parent
ROOT = IMAGES.parents[1]
sys.path.insert(0, str(ROOT / "tests/docs"))
from commands_in_pages import commands_of, pages_with_commands, pictures_of  # noqa: E402

# For each example, its picture here and its data, if any.
EXAMPLES = {"cluster_moons": ["cluster-moons"], "cluster_tree": ["cluster-tree"],
            "grow_loop": ["grow-loop"], "clouds_to_features": ["clouds-to-features"],
            "two_circles": ["two-circles", ROOT / "examples/data/two_circles.csv"],
            "textures": ["textures"], "molecule": ["molecule"], "growing_discs": ["growing-discs"],
            "noise_band": ["noise-band"], "sweeping_level": ["sweeping-level"],
            "delay_embedding": ["delay-embedding", ROOT / "examples/data/pulse.csv"]}
CHROMIUM = ["--headless", "--no-sandbox", "--hide-scrollbars", "--use-gl=angle", "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader", "--window-size=1000,700", "--virtual-time-budget=6000"]


def run_commands(page, folder, environment):
    shutil.copytree(ROOT / "examples", folder / "examples")
    for command, _ in commands_of(page):
        subprocess.run(command, shell=True, cwd=folder, env=environment, check=True, stdout=subprocess.DEVNULL)


def draw_pages(environment):
    for page in pages_with_commands():
        names = pictures_of(page)
        if not names:
            continue
        with tempfile.TemporaryDirectory() as folder:
            run_commands(page, Path(folder), environment)
            for name in names:
                shutil.copy(Path(folder, name), IMAGES / "pages" / name)
                print(f"pages/{name}")


def photograph_reports(environment):
    chromium = shutil.which("chromium")
    if chromium is None:
        print("left out: gallery/, for there is no Chromium")
        return
    with tempfile.TemporaryDirectory() as folder:
        run_commands(ROOT / "docs/gallery.md", Path(folder), environment)
        for report in sorted(Path(folder).glob("*.html")):
            picture = IMAGES / "gallery" / f"{report.stem}.png"
            subprocess.run([chromium, *CHROMIUM, f"--screenshot={picture}", report.as_uri()], check=True,
                           stderr=subprocess.DEVNULL)
            print(f"gallery/{picture.name}")


def run_examples(environment):
    for name, (picture, *data) in EXAMPLES.items():
        done = subprocess.run([sys.executable, ROOT / f"python/examples/{name}.py", *data, IMAGES / f"{picture}.png"],
                              env=environment, check=False)
        print(f"{picture}.png" if done.returncode == 0 else f"left out: {picture}.png")


def draw_vectors(environment):
    done = subprocess.run([sys.executable, IMAGES / "vectors.py", ROOT / "examples/data/bars/circles.csv",
                           IMAGES / "vectors.png"], env=environment, check=False)
    print("vectors.png" if done.returncode == 0 else "left out: vectors.png")


def main():
    build = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release").resolve()
    path = [*(str(build / "apps" / name) for name in ("barcode", "segment", "vectorise")), os.environ["PATH"]]
    packages = [str(build / "python"), str(ROOT / "python")]
    environment = {**os.environ, "PATH": os.pathsep.join(path), "PYTHONPATH": os.pathsep.join(packages)}
    for folder in ("pages", "gallery"):
        (IMAGES / folder).mkdir(exist_ok=True)
    draw_pages(environment)
    photograph_reports(environment)
    draw_vectors(environment)
    run_examples(environment)


if __name__ == "__main__":
    main()
