# SPDX-License-Identifier: MIT
"""Computes poses of boxes and grasps from above, for an arm with a parallel gripper.

A pose is a 4 x 4 matrix that maps points of its own frame to the frame of the cloud. Lengths are in
metres. Boxes come from libph: from `scene.objects`, or from `oriented_box` in the JSON of
ph-segment.
"""
from typing import NamedTuple

import numpy as np


class Gripper(NamedTuple):
    """The dimensions of a gripper."""

    opening: float = 0.085   # distance between the fingers when it is open
    finger: float = 0.03     # largest reach of the fingers down the sides of an object
    clearance: float = 0.005  # gap between fingers and object on each side, and above the plane


class Grasp(NamedTuple):
    """A pose of the gripper: x is the closing direction, z the approach."""

    pose: np.ndarray  # its origin is between the tips of the fingers
    width: float      # size of the object along x


class CannotGrasp(ValueError):
    """This gripper cannot grasp this object from above; the message says why."""


def matrix(x, y, z, origin):
    """A pose with these axes. Refuses axes that are not a right-handed frame."""
    result = np.eye(4)
    result[:3] = np.column_stack([x, y, z, origin])
    turn = result[:3, :3]
    if not np.allclose(turn.T @ turn, np.eye(3), atol=1e-6) or np.linalg.det(turn) < 0:
        raise ValueError(f"found axes {turn.T.tolist()}, expected three orthogonal unit vectors, "
                         "right-handed")
    return result


def pose(centre, axes):
    """The pose of a box: x along its longer side on the plane, z along the plane's normal."""
    return matrix(*axes, centre)


def from_above(centre, axes, size, plane, gripper=Gripper(), towards=(1, 0, 0)):
    """The grasp that descends along the normal and closes along the shorter horizontal side.

    plane: a, b, c, d of ax + by + cz + d = 0, the removed plane; its normal points up. towards: a
    direction that selects one of two equal grasps, which differ by half a turn about the approach;
    the x axis of the chosen grasp is nearer to this direction. Raises CannotGrasp.
    """
    centre, axes, size = (np.asarray(value, dtype=float) for value in (centre, axes, size))
    up, offset = np.asarray(plane[:3], dtype=float), float(plane[3])
    if up @ axes[2] < 1 - 1e-6:
        raise ValueError("found a box that does not stand on the plane: its last axis is not the "
                         "normal")
    side = int(np.argmin(size[:2]))
    width = float(size[side])
    needed = width + 2 * gripper.clearance
    if needed > gripper.opening:
        raise CannotGrasp(f"{1000 * width:.0f} mm wide, {1000 * needed:.0f} mm with clearance, and "
                          f"the gripper opens {1000 * gripper.opening:.0f} mm")
    top = centre + size[2] / 2 * up
    height = up @ top + offset
    if height <= 0:
        raise CannotGrasp("it lies below the plane; give the plane that it stands on")
    depth = min(gripper.finger, height - gripper.clearance)
    if depth <= 0:
        raise CannotGrasp(f"{1000 * height:.0f} mm high: too flat to be held at its sides")
    x = axes[side] if axes[side] @ np.asarray(towards, dtype=float) >= 0 else -axes[side]
    return Grasp(matrix(x, np.cross(-up, x), -up, top - depth * up), width)
