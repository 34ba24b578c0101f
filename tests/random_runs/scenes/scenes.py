# SPDX-License-Identifier: MIT
"""Random small scenes, and random options of ph-segment that fit the scenes."""
import dataclasses
import math

import numpy as np


@dataclasses.dataclass
class Scene:
    kind: str
    xyz: np.ndarray  # n x 3, float64; NaN is a hole
    size: float = 0.3  # the approximate size of the scene
    shape: tuple = None  # rows and columns, if organised
    colours: np.ndarray = None
    normals: np.ndarray = None
    extra: list = dataclasses.field(default_factory=list)  # further fields: pairs of name and array
    viewpoint: tuple = (0.0, 0.0, 0.0)
    voxel: float = None  # a voxel size that causes ties
    depth: np.ndarray = None
    depth_scale: float = 1000
    camera: tuple = None


def blobs(rng, np_rng, size):
    parts = [np_rng.normal(np_rng.uniform(-size, size, 3), size * rng.choice([0.02, 0.1, 0.3]),
                           (rng.randint(1, 60), 3)) for _ in range(rng.randint(1, 5))]
    return np.concatenate(parts)


def table(rng, np_rng, size):
    """A plane in any direction, with boxes and blobs on it."""
    n = rng.choice([10, 15, 25, 40])
    side = np.linspace(-size, size, n)
    x, y = (a.reshape(-1) for a in np.meshgrid(side, side))
    noise = rng.choice([0, 0, 0.001, 0.005]) * size
    parts = [np.stack([x, y, np_rng.normal(0, 1, n * n) * noise], 1)]
    for _ in range(rng.randint(0, 4)):
        low, wide = np_rng.uniform(-0.7, 0.5, 2) * size, np_rng.uniform(0.1, 0.4, 3) * size
        points = np_rng.uniform(0, 1, (rng.randint(5, 150), 3)) * wide
        parts.append(points + [*low, 0])
    cloud = np.concatenate(parts)
    turn, _ = np.linalg.qr(np_rng.normal(0, 1, (3, 3)))
    if rng.random() < 0.5:
        turn = np.diag([1.0, 1.0, -1.0])  # objects rise towards the sensor
    return cloud @ turn.T + [0, 0, 2.5 * size]


def relief(rng, np_rng, size):
    """A dense surface with valleys where basins meet: bumps, ridges or steps side by side."""
    n = rng.choice([15, 25, 35])
    side = np.linspace(-size / 2, size / 2, n)
    x, y = (a.reshape(-1) for a in np.meshgrid(side, side))
    waves, high = np_rng.uniform(1, 3, 2) * 2 * np.pi / size, size * rng.choice([0.03, 0.1, 0.2])
    way = rng.randrange(3)
    z = np.sin(waves[0] * x) * np.sin(waves[1] * y) if way == 0 else \
        abs(np.sin(waves[0] * x)) if way == 1 else np.floor(2 * np.sin(waves[0] * x) + np.cos(waves[1] * y))
    z = z * high + np_rng.normal(0, 1, n * n) * rng.choice([0, 0.01, 0.1]) * high
    return np.stack([x, y, 2 * size - z], 1)


def lattice(rng, np_rng, step):
    """Points whose coordinates are multiples of a power of two: all sums are exact, and there are
    ties."""
    shape = rng.choice([(6, 6, 6), (12, 12, 1), (60, 1, 1), (4, 20, 3)])
    count = rng.randint(1, 150)
    return np.stack([np_rng.integers(-n // 2, n - n // 2, count) for n in shape], 1) * step


def organised(rng, np_rng):
    """Depths of a table and boxes in front of a pinhole camera, as floats in metres, for each
    pixel."""
    rows, columns = rng.choice([(2, 2), (4, 6), (12, 16), (24, 32), (36, 48)])
    focal = columns * rng.choice([0.8, 1.0, 2.0])
    camera = (float(focal), float(focal * rng.choice([1, 1, 1.125])), (columns - 1) / 2, (rows - 1) / 2)
    u, v = np.meshgrid(np.arange(columns), np.arange(rows))
    ray_y = (v - camera[3]) / camera[1]
    # y points down; the table is below and extends backwards.
    depth = 0.5 / np.maximum(0.3 * ray_y + 0.4, 0.1)
    depth = np.minimum(depth, rng.choice([1.3, 1.8, 5.0]))
    for _ in range(rng.randint(0, 4)):
        top, left = rng.randrange(rows), rng.randrange(columns)
        place = np.s_[top:top + rng.randint(1, rows), left:left + rng.randint(1, columns)]
        depth[place] = np.minimum(depth[place], rng.uniform(0.5, 1.2))
    depth += np_rng.normal(0, rng.choice([0, 0.001, 0.003]), depth.shape)
    depth[np_rng.random(depth.shape) < rng.choice([0, 0, 0.1, 0.5])] = np.nan
    return depth, camera


def points_of_depth(depth, camera, scale):
    """The points in metres, by the definition of a pinhole camera."""
    fx, fy, cx, cy = camera
    rows, columns = depth.shape
    u, v = (a.astype(float) for a in np.meshgrid(np.arange(columns), np.arange(rows)))
    raw = depth.astype("f8")
    z = np.where((raw > 0) & np.isfinite(raw), raw, np.nan) / scale
    return np.stack([(u - cx) * z / fx, (v - cy) * z / fy, z], 2).reshape(-1, 3)


def depth_scene(rng, np_rng):
    metres, camera = organised(rng, np_rng)
    if rng.random() < 0.4:
        depth = metres.astype(rng.choice(["f4", "f8"]))
        scale = rng.choice([1, 1, 1000])
        depth *= scale
        if rng.random() < 0.2:
            depth[np_rng.random(depth.shape) < 0.1] = rng.choice([0, -1, np.inf])
    else:
        scale = rng.choice([1000, 1000, 5000, 10000])
        depth = np.clip(np.nan_to_num(metres * scale), 0, 65535).astype("u2")
    xyz = points_of_depth(depth, camera, scale).astype("f4").astype("f8")
    scene = Scene("depth", xyz, 1.0, depth.shape, depth=depth, depth_scale=scale, camera=camera)
    if rng.random() < 0.4:
        scene.colours = np_rng.integers(0, 256, (depth.size, 3))
    return scene


def random_scene(rng, np_rng):
    kind = rng.choice(["blobs"] * 3 + ["lattice"] * 3 + ["table"] * 3 + ["organised"] * 2 + ["depth"] * 3
                      + ["relief"] * 3 + ["few", "flat", "grid"])
    if kind == "depth":
        return depth_scene(rng, np_rng)
    size, voxel, shape = 0.3, None, None
    if kind == "blobs":
        xyz = blobs(rng, np_rng, size) + [0, 0, rng.choice([0, 1])]
    elif kind == "lattice":
        voxel = 2.0 ** rng.randint(-9, -3)
        xyz, size = lattice(rng, np_rng, voxel * rng.choice([0.25, 0.5, 1, 2])), 12 * voxel
    elif kind == "table":
        xyz = table(rng, np_rng, size)
    elif kind == "relief":
        xyz = relief(rng, np_rng, size)
    elif kind == "organised":
        metres, camera = organised(rng, np_rng)
        xyz, shape, size = points_of_depth(metres, camera, 1.0), metres.shape, 1.0
    elif kind == "few":
        xyz = np_rng.normal(0, 0.1, (rng.choice([0, 1, 1, 2, 3]), 3))
    elif kind == "flat":  # all points on a plane or a line
        xyz = np_rng.uniform(-0.3, 0.3, (rng.randint(3, 200), 3)) * rng.choice([[1, 1, 0], [1, 0, 0], [0, 0, 0]])
        xyz = xyz + [0, 0, 0.7]
    else:  # rows and columns that do not form a picture
        shape = rng.randint(2, 12), rng.randint(1, 12)
        xyz = np_rng.normal(0, 0.1, (shape[0] * shape[1], 3))
    scene = Scene(kind, xyz, size, shape, voxel=voxel)
    disturb(rng, np_rng, scene)
    count = len(scene.xyz)
    if rng.random() < 0.4:
        scene.colours = np_rng.integers(0, 256, (count, 3))
    if rng.random() < 0.2:
        scene.normals = np_rng.normal(0, 1, (count, 3))
    if rng.random() < 0.15:
        scene.extra.append((rng.choice(["label", "intensity", "curvature"]),
                            np_rng.integers(0, 9, count).astype(rng.choice(["u4", "u1", "i2", "f4"]))))
    return scene


def disturb(rng, np_rng, scene):
    xyz = scene.xyz
    if len(xyz) > 1 and rng.random() < 0.2 and scene.shape is None:  # adds duplicates
        again = np_rng.integers(0, len(xyz), rng.randint(1, 30))
        xyz = np.concatenate([xyz, xyz[again]])
    if rng.random() < 0.2 and len(xyz):
        xyz = xyz.copy()
        xyz[np_rng.random(len(xyz)) < rng.choice([0.02, 0.3, 1]), rng.randrange(3)] = np.nan
    if rng.random() < 0.1 and len(xyz):
        xyz = xyz.copy()
        xyz[rng.randrange(len(xyz))] = [rng.choice([1e3, -1e6, 1e20, 1e-30]) for _ in range(3)]
    if rng.random() < 0.12:  # uses another unit
        factor = 2.0 ** rng.choice([-60, -20, -10, 10, 20, 60])
        xyz, scene.size = xyz * factor, scene.size * factor
        scene.voxel = scene.voxel and scene.voxel * factor
    if rng.random() < 0.2:
        scene.viewpoint = tuple(float(rng.choice([0, 0.5, -0.25, 1])) * scene.size for _ in range(3))
    if rng.random() < 0.8:
        xyz = xyz.astype("f4").astype("f8")
    scene.xyz = xyz


@dataclasses.dataclass
class Asked:
    """The options that determine the labels, as numbers."""
    method: str = "surface"
    voxel: float = None
    max_range: float = 2.0
    crop: list = None
    plane: bool = True
    most_supports: int = 8
    plane_distance: float = None
    plane_noise: float = 0.005
    viewpoint: tuple = None
    distance: float = 0.025
    steps: int = 10  # 0 for exact values
    cut: float = None
    min_part: int = None
    min_size: int = None
    parts: bool = False
    spacing: float = 0.03
    allow_empty: bool = False
    cut_name: str = "--cut"
    check: bool = True

    def voxel_edge(self):
        return self.voxel or (0.01 if self.method == "paper" else 0.005)

    def least_voxels(self):
        return self.min_size or (1 if self.method == "supervoxels" else 32)

    def value(self):
        default = {"surface": 1, "paper": self.distance, "supervoxels": 0}[self.method]
        return default if self.cut is None else self.cut

    def least_part(self):
        return self.min_part or (8 if self.method == "supervoxels" else 200)

    def options(self):
        """The options as words of a command line."""
        out = []
        if self.method == "supervoxels":
            out += [["--supervoxels", repr(self.spacing)]]
        elif self.method != "surface":
            out += [["--method", self.method]]
        defaults = Asked(self.method)
        for name in ("voxel", "max_range", "plane_distance", "plane_noise", "distance"):
            if getattr(self, name) != getattr(defaults, name):
                out += [["--" + name.replace("_", "-"), repr(getattr(self, name))]]
        for name in ("crop", "viewpoint"):
            if getattr(self, name) is not None:
                out += [[f"--{name}=" + ",".join(map(repr, getattr(self, name)))]]
        out += [] if self.plane else [["--plane", "off"]]
        out += [["--plane", str(self.most_supports)]] if self.most_supports != 8 else []
        out += [["--steps", str(self.steps or "exact")]] if self.steps != 10 else []
        out += [] if self.check else [["--no-check"]]
        out += [["--allow-empty"]] if self.allow_empty else []
        return out + self.cut_options(self.cut_name)

    def cut_options(self, name="--cut"):
        """The options that a stored tree accepts as well."""
        out = [[name, repr(self.cut)]] if self.cut is not None else []
        for name in ("min_part", "min_size"):
            if getattr(self, name) is not None:
                out += [["--" + name.replace("_", "-"), repr(getattr(self, name))]]
        return out + ([["--parts"]] if self.parts else [])


def other_cut(rng, asked, scene):
    """Random values for the options of a cut."""
    if rng.random() < 0.5:
        asked.cut = {"surface": rng.choice([0.0, 0.1, 0.5, 3.0, 100.0]),
                     "supervoxels": rng.choice([0.0, 0.03, 0.3, 5.0]) * scene.size,
                     "paper": asked.distance * rng.choice([0.0, 0.33, 0.55, 0.75, 1.0])}[asked.method]
    if rng.random() < 0.8:
        asked.min_size = rng.choice([1, 1, 2, 3, 10, 50])
    if asked.method != "paper" and rng.random() < 0.7:
        asked.min_part = rng.choice([1, 1, 2, 5, 20])
    if asked.method == "surface":
        asked.parts = rng.random() < 0.6


def random_options(rng, scene):
    """@return random options as an Asked."""
    asked = Asked(rng.choice(["paper", "paper", "surface", "surface", "supervoxels"]))
    size = scene.size
    if rng.random() < 0.9 or size > 10 or size < 0.01:
        asked.voxel = scene.voxel if scene.voxel and rng.random() < 0.7 else \
            size * rng.choice([0.01, 0.03, 0.05, 0.1, 0.3, 2]) * rng.choice([1, 1, rng.uniform(0.5, 2)])
    edge = asked.voxel_edge()
    if asked.method == "paper" and rng.random() < 0.9:
        asked.distance = edge * rng.choice([0, 1, 1.5, 2, 2, 3, rng.uniform(0, 4)])
    if asked.method == "paper":
        asked.steps = rng.choice([10, 10, 0, 0, 1, 3, 5000])
    if asked.method == "supervoxels":
        asked.spacing = edge * rng.choice([1, 2, 5, rng.uniform(1, 8)])
    if size > 2 or rng.random() < 0.5:
        asked.max_range = rng.choice([math.inf, math.inf, size, size * 3, 2 * size * rng.random(), 0.0])
    if rng.random() < 0.2:
        ends = sorted(rng.choice([-1, 0, 0.5, 1, -0.25, math.inf, -math.inf, rng.random()]) for _ in range(2))
        asked.crop = [x * size if math.isfinite(x) else x for x in [*ends, -math.inf, math.inf, *ends]]
    if rng.random() < 0.5:
        asked.plane = False
    elif rng.random() < 0.5 or size > 10 or size < 0.01:
        asked.plane_distance = size * rng.choice([0.001, 0.01, 0.05])
    if asked.plane and asked.method == "surface" and rng.random() < 0.2:
        asked.most_supports = rng.choice([1, 2, 255])
    if asked.plane and asked.method != "paper" and rng.random() < 0.3:
        asked.plane_noise = rng.choice([0.0, 0.001, 0.02])
    if rng.random() < 0.2:
        asked.viewpoint = tuple(float(rng.choice([0, 0, 1, -0.5, 2])) * size for _ in range(3))
    asked.check = rng.random() < 0.7
    asked.allow_empty = rng.random() < (0.7 if len(scene.xyz) == 0 else 0.03) and scene.depth is None
    other_cut(rng, asked, scene)
    if asked.method != "paper" and rng.random() < 0.4:
        asked.cut_name = "--min-persistence"
    return asked
