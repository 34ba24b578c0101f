# SPDX-License-Identifier: MIT
"""Makes ten frames of a still scene, seen by a nearly still camera."""
import struct
import zlib

import numpy as np

FRAMES = 10
TURN, SHIFT = np.deg2rad(0.2), 0.002  # standard deviations of the camera's pose
EYE = np.array([0.0, -0.9, 0.9])      # x right, y away, z up; the camera looks down at 45 degrees
ROOM_CAMERA = (340.0, 340.0, 319.5, 239.5)
BLOCKS = np.array([                   # the least and largest coordinates of each block
    [(-0.6, -0.5, -0.02), (0.6, 0.5, 0.0)], [(-0.12, -0.05, 0.0), (0.06, 0.09, 0.13)],
    [(-0.07, -0.02, 0.13), (0.02, 0.07, 0.2)], [(0.13, -0.05, 0.0), (0.27, 0.07, 0.11)],
    [(-0.5, 0.6, -0.1), (0.5, 0.62, 1.5)]])
TABLE, LARGE, SMALL, BESIDE, WALL = range(5)


def turned(vector):
    """The rotation about a vector, by an angle equal to its length."""
    angle = np.linalg.norm(vector)
    x, y, z = vector / angle if angle else vector
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def pose(rng):
    return turned(rng.normal(size=3) * TURN / np.sqrt(3)), rng.normal(size=3) * SHIFT / np.sqrt(3)


def room(rng, moves=True):
    """The depth, in metres, of a table with boxes in front of a wall; and the number of the block
    that each pixel shows."""
    fx, fy, cx, cy = ROOM_CAMERA
    v, u = np.mgrid[:480, :640]
    c = np.sqrt(0.5)
    # The camera's forward axis points away and down.
    from_camera = np.array([[1, 0, 0], [0, -c, c], [0, -c, -c]])
    rays = np.stack([(u - cx) / fx, (v - cy) / fy, np.ones(u.shape)], -1)
    turn, shift = pose(rng) if moves else (np.eye(3), np.zeros(3))
    rays = rays @ turn.T @ from_camera.T
    eye = EYE + shift
    with np.errstate(divide="ignore"):
        ends = (BLOCKS[:, :, None, None] - eye) / rays
    near, far = ends.min(1).max(-1), ends.max(1).min(-1)
    entry = np.where((near > 0) & (near < far), near, np.inf)
    block = np.where(np.isfinite(entry.min(0)), entry.argmin(0), -1)
    depth = np.where(block >= 0, entry.min(0), np.nan)
    return depth + 0.0005 * depth**2 * rng.normal(size=depth.shape), block


def seen_again(depth, camera, noise, rng):
    """A frame from a camera that has moved a little. Single pixels that the resampling leaves empty
    are filled. @param noise standard deviation of the depth at one metre, in metres; it grows with
    the square of the depth."""
    fx, fy, cx, cy = camera
    height, width = depth.shape
    z = depth + noise * depth**2 * rng.normal(size=depth.shape)
    v, u = np.mgrid[:height, :width]
    is_there = depth > 0
    points = np.stack([(u - cx) * z / fx, (v - cy) * z / fy, z], -1)[is_there]
    turn, shift = pose(rng)
    points = points @ turn.T + shift
    x = np.rint(points[:, 0] * fx / points[:, 2] + cx).astype(int)
    y = np.rint(points[:, 1] * fy / points[:, 2] + cy).astype(int)
    kept = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    seen = np.full(depth.shape, np.inf)
    np.minimum.at(seen, (y[kept], x[kept]), points[kept, 2])
    around = np.pad(seen, 1, constant_values=np.inf)
    near = np.sort([around[1:-1, :-2], around[1:-1, 2:], around[:-2, 1:-1], around[2:, 1:-1]], 0)
    torn = np.isinf(seen) & np.isfinite(near[2])
    seen[torn] = near[1][torn]
    return np.where(np.isfinite(seen), seen, np.nan)


def noise_on(depth, camera, plane):
    """The scatter of the depth about a plane, scaled to a depth of one metre, because scatter grows
    with the square of the depth."""
    fx, fy, cx, cy = camera
    v, u = np.mgrid[:depth.shape[0], :depth.shape[1]]
    a, b, c, d = plane
    away = (a * (u - cx) / fx + b * (v - cy) / fy + c) * depth + d
    on = (depth > 0) & (depth < 2) & (np.abs(away) < 0.012 * np.maximum(1, depth**2))
    return 1.4826 * np.median(np.abs(away[on] / depth[on]**2))


def read_png(path):
    """Reads a PNG image that has one channel of 16 bits."""
    data = path.read_bytes()
    at, packed, width, height = 8, b"", 0, 0
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, bits, channels = struct.unpack_from(">IIBB", data, at + 8)
            assert (bits, channels) == (16, 0), path
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += size + 12
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 2 * width)
    image = np.zeros((height, 2 * width), np.uint8)
    before = np.zeros(2 * width, int)
    for row, line in enumerate(rows):
        image[row] = before = _unfiltered(int(line[0]), line[1:].astype(int), before)
    return image.reshape(height, width, 2) @ np.array([256, 1])


def _unfiltered(filter_, line, above):
    """Undoes the filter of a row of a PNG with two bytes per pixel."""
    if filter_ in (0, 2):
        return (line + (above if filter_ else 0)) & 255
    if filter_ == 1:
        return line.reshape(-1, 2).cumsum(0).ravel() & 255
    row, left, corner = line.tolist(), [0, 0], [0, 0]
    for i, (value, b) in enumerate(zip(row, above.tolist())):
        a, c = left[i % 2], corner[i % 2]
        if filter_ == 3:
            guess = (a + b) // 2
        else:
            p, q, r = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            guess = a if p <= q and p <= r else b if q <= r else c
        row[i] = left[i % 2] = (value + guess) & 255
        corner[i % 2] = b
    return np.array(row)
