#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads the output of ph-segment --json - for a stream, and prints the nearest object of each
frame: ph-segment recording/ --json - | 16_frames.py"""
import json
import math
import sys


def distance(segment, viewpoint):
    return math.dist(segment["oriented_box"]["centre"], viewpoint)


for line in sys.stdin:  # each frame arrives as soon as it is done
    frame = json.loads(line)
    path = frame["input"]["path"]
    if "exit_code" in frame:  # a failed frame; the next frames follow
        print(f"{path}: failed", flush=True)
    elif not frame["segments"]:
        print(f"{path}: nothing", flush=True)
    else:
        nearest = min(frame["segments"], key=lambda s: distance(s, frame["viewpoint"]))
        print(f"{path}: {len(frame['segments'])} objects, number {nearest['label']} is nearest, "
              f"{distance(nearest, frame['viewpoint']):.2f} m away", flush=True)
