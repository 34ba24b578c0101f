#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Regenerates the pictures of frames in gallery.md: frames.py SCENES [BUILD], by default
build/release.

SCENES is a folder with frames of the modified Object Segmentation Database as PCD. Needs Pillow.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
SIZE = (400, 300)
# The section shown of each frame: left, upper, width; all are 4 : 3.
FRAMES = {"learn23": (110, 90, 420), "learn27": (160, 140, 360), "learn29": (160, 90, 340),
          "learn33": (60, 150, 440), "test46": (80, 120, 480), "test60": (100, 90, 520)}


def main(scenes, build="build/release"):
    program = ROOT / build / "apps/segment/ph-segment"
    with tempfile.TemporaryDirectory() as folder:
        for name, (x, y, width) in FRAMES.items():
            picture = Path(folder, f"{name}.png")
            subprocess.run([program, Path(scenes, f"{name}.pcd"), "--picture", picture, "--quiet"],
                           check=True)
            part = Image.open(picture).crop((x, y, x + width, y + width * 3 // 4)).resize(SIZE)
            few = part.quantize(128, kmeans=3, dither=Image.Dither.NONE)
            few.save(ROOT / f"docs/images/gallery/frame-{name}.png", optimize=True)
            print(f"gallery/frame-{name}.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
