#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Shows the objects of Open3D clouds, each as an Open3D cloud with its oriented box.

    open3d_objects.py CLOUD… [--viewpoint X Y Z] [--opening METRES] [--save FOLDER]
"""
import argparse
import sys
from pathlib import Path

import numpy as np

import libph as ph
from grasps import CannotGrasp, Gripper, from_above

try:
    import open3d as o3d
except ImportError:
    sys.exit("open3d_objects.py: Open3D is missing: apt install python3-open3d, or "
             "pip install open3d; libph itself takes arrays and does not need it")


def objects_of(cloud, **options):
    """Returns the segmentation and, for each object, its row, its points as a cloud, and its
    box."""
    scene = ph.segment(np.asarray(cloud.points), **options)
    for thing in scene.objects:
        points = cloud.select_by_index(np.flatnonzero(scene.labels == thing.label))
        # Axes are rows in libph and columns in Open3D.
        box = o3d.geometry.OrientedBoundingBox(thing.centre, thing.axes.T, thing.size)
        yield scene, thing, points, box


def grasp_of(scene, thing, gripper):
    """Describes the grasp, or says why there is none."""
    if scene.meta.get("plane") is None:
        return "no plane, so nobody knows what is above"
    try:
        grasp = from_above(thing.centre, thing.axes, thing.size, scene.meta["plane"], gripper)
    except CannotGrasp as reason:
        return f"no grasp: {reason}"
    place = ", ".join(f"{x:.3f}" for x in grasp.pose[:3, 3])
    return f"grasp at ({place}), {1000 * grasp.width:.0f} mm wide"


def main():
    parser = argparse.ArgumentParser(description="Objects of clouds that Open3D reads.")
    parser.add_argument("clouds", nargs="+", metavar="CLOUD", type=Path)
    parser.add_argument("--viewpoint", nargs=3, type=float, default=(0, 0, 0),
                        help="where the sensor stood (default: the origin)")
    parser.add_argument("--opening", type=float, default=Gripper().opening,
                        help="of the gripper, metres")
    parser.add_argument("--save", type=Path, metavar="FOLDER", help="write each object as PLY")
    options = parser.parse_args()
    gripper = Gripper(opening=options.opening)
    for path in options.clouds:
        cloud = o3d.io.read_point_cloud(str(path))
        if cloud.is_empty():
            print(f"{path.name}: no points")
            continue
        for scene, thing, points, box in objects_of(cloud, viewpoint=options.viewpoint):
            size = " x ".join(f"{1000 * x:.0f}" for x in box.extent)
            print(f"{path.name}: object {thing.label}: {len(points.points)} points, {size} mm, "
                  f"{grasp_of(scene, thing, gripper)}")
            if options.save:
                options.save.mkdir(parents=True, exist_ok=True)
                file = options.save / f"{path.stem}-{thing.label}.ply"
                o3d.io.write_point_cloud(str(file), points)


if __name__ == "__main__":
    main()
