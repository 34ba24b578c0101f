# SPDX-License-Identifier: MIT
"""Checks that the output of ph-segment for a scene agrees with scene_oracle.py, and that its parts
are consistent."""
import math

import numpy as np

import scene_files
import scene_oracle as oracle
from scene_oracle import Unsure

# Voxels are adjacent if their centroids are at most a little more than sqrt(3) edges apart. The
# centres of two voxels whose corners touch have this distance.
SURELY_ADJACENT, SURELY_NOT = 1.73, 1.8


class Wrong(Exception):
    pass


def expect(what, found, expected):
    if found != expected:
        raise Wrong(f"{what}: found {found}, expected {expected}")


def require(condition, what):
    if not condition:
        raise Wrong(what)


def same_partition(found, expected):
    """True if the labels are the same up to renaming, where 0 stays 0."""
    pairs = set(zip(found.tolist(), expected.tolist()))
    return len(pairs) == len({f for f, _ in pairs}) == len({e for _, e in pairs}) and \
        all((f == 0) == (e == 0) for f, e in pairs)


def segments_of(names, least, of_point, count):
    """@param names the component of each vertex. @return the segment of each point and of each
    vertex; 0 for none."""
    _, component, voxels = np.unique(names, return_inverse=True, return_counts=True)
    component = component.reshape(-1)
    of_vertex = np.where(voxels[component] >= least, component + 1, 0) if len(names) else names
    labels = np.zeros(count, int)
    labels[of_point >= 0] = of_vertex[of_point[of_point >= 0]]
    return labels, of_vertex


class Check:
    """@param xyz the coordinates as floats. @param summary the output of --json. @param labels of
    the points."""

    def __init__(self, scene, file, asked, summary, labels, said):
        self.scene, self.file, self.asked = scene, file, asked
        self.json, self.labels, self.said = summary, labels, said
        self.xyz = oracle.as_floats(scene.xyz)
        self.voxels, self.beyond, self.rips, self.unsure = None, None, None, ""
        self.counted = False

    def all(self):
        self.input()
        self.segments()
        try:
            self.scene_stages()
        except Unsure as reason:
            self.unsure = str(reason)

    def points_of(self, stage):
        return next(s["points"] for s in self.json["stages"] if s["name"] == stage)

    def input(self):
        j, a, count = self.json, self.asked, len(self.xyz)
        rows, columns = self.file.shape or (1, count)
        expected = {"path": j["input"]["path"], "points": count, "width": columns, "height": rows,
                    "organised": rows > 1}
        expect("input", j["input"], expected)
        expect("number of labels", len(self.labels), count)
        expect("method", j["method"], a.method)
        cut = {"min_size": a.least_voxels(), "value": a.value()}
        cut |= {"min_part": a.least_part()} if a.method != "paper" else {}
        if a.method == "surface":
            cut |= {"objects": not a.parts}
        expect("cut", {name: j["cut"][name] for name in cut}, cut)
        expect("check", j["check"]["ran"], a.check)
        require(not a.check or j["check"]["equal"], "the check found a difference")
        self.options()
        told = a.viewpoint or (self.scene.viewpoint if self.file.viewpoint else (0, 0, 0))
        if list(told) != j["viewpoint"]:
            require(rows > 1 and a.viewpoint is None, f"viewpoint: found {j['viewpoint']}, expected {told}")
            require(self.said is None or "rays of the pixels" in self.said, "another viewpoint without a note")
        if a.voxel is not None or a.method == "paper":
            expect("voxel", j["voxel"], a.voxel_edge())

    def options(self):
        a = self.asked

        def ends(values):
            return [x if math.isfinite(x) else None for x in values]
        expected = {
            "max_range": a.max_range if a.max_range < math.inf else None,
            "crop": a.crop and {"min": ends(a.crop[::2]), "max": ends(a.crop[1::2])}, "plane": a.plane,
            "most_supports": a.most_supports,
            "plane_distance": a.plane_distance or (0.006 if a.method == "paper" else 0.005),
            "plane_noise": a.plane_noise, "viewpoint": a.viewpoint and list(a.viewpoint), "voxel": a.voxel,
            "distance": a.distance, "steps": a.steps or "exact", "spacing": a.spacing, "check": a.check}
        expect("options", self.json["options"], expected)

    def segments(self):
        """Checks the properties of each segment against its points."""
        j, labels = self.json, self.labels
        expect("labels", [s["label"] for s in j["segments"]], list(range(1, len(j["segments"]) + 1)))
        require(set(np.unique(labels)) - {0} == set(range(1, len(j["segments"]) + 1)), "labels without a segment")
        sizes = [s["points"] for s in j["segments"]]
        expect("points", sizes, np.bincount(labels, minlength=len(sizes) + 1)[1:].tolist())
        require(sizes == sorted(sizes, reverse=True), f"segments are not in order: {sizes}")
        touching = {s["label"]: {n["label"]: n["meets_at"] for n in s["neighbours"]} for s in j["segments"]}
        for s in j["segments"]:
            name = f"segment {s['label']}"
            points = self.xyz[labels == s["label"]]
            require(s["voxels"] >= self.asked.least_voxels(), f"{name}: {s['voxels']} voxels are too few")
            require(s["voxels"] <= s["points"], f"{name}: more voxels than points")
            expect(f"{name}: box", [s["box"]["min"], s["box"]["max"]],
                   [points.min(axis=0).tolist(), points.max(axis=0).tolist()])
            self.oriented_box(name, s["oriented_box"], points)
            slack = 1e-8 * j["voxel"] + 1e-11 * abs(points).max()
            if not j["surfaces"]:
                require(np.allclose(s["centroid"], points.mean(axis=0), rtol=0, atol=slack),
                        f"{name}: centroid: found {s['centroid']}, expected {points.mean(axis=0)}")
                expect(f"{name}: role", (s["role"], s["on"]), ("object", s["on"]))
            low, high = np.array(s["box"]["min"]), np.array(s["box"]["max"])
            require((low - slack <= s["centroid"]).all() and (s["centroid"] <= high + slack).all(),
                    f"{name}: centroid out of its box")
            values = [n["meets_at"] for n in s["neighbours"]]
            require(values == sorted(values), f"{name}: neighbours are not in order")
            first = s["neighbours"][0] if values else {"label": 0, "meets_at": None}
            expect(f"{name}: first neighbour", (s["neighbour"], s["meets_at"]), (first["label"], first["meets_at"]))
            require((s["persistence"] is None) == (not values), f"{name}: persistence {s['persistence']}")
            for other, value in touching[s["label"]].items():
                expect(f"{name}: neighbour {other}", touching[other].get(s["label"]), value)

    def oriented_box(self, name, box, points):
        axes, size, centre = np.array(box["axes"]), np.array(box["size"]), np.array(box["centre"])
        require(np.allclose(axes @ axes.T, np.eye(3), atol=1e-9), f"{name}: axes of no length 1")
        require(np.linalg.det(axes) > 0, f"{name}: axes are not right-handed")
        along = points @ axes.T
        slack = 1e-6 * size.max() + 1e-9 * abs(points).max()
        middle = (along.max(axis=0) + along.min(axis=0)) / 2
        require(np.allclose(along.max(axis=0) - along.min(axis=0), size, rtol=0, atol=slack) and
                np.allclose(axes @ centre, middle, rtol=0, atol=slack), f"{name}: oriented box of other points")
        plane = self.json["plane"]
        if plane["found"]:
            require(abs(axes[2] @ plane["normal"]) > 1 - 1e-9, f"{name}: box does not stand on the plane")

    def scene_stages(self):
        """Checks range, plane and voxels; for method paper, also the later stages."""
        j, a = self.json, self.asked
        kept = oracle.in_range(self.xyz, j["viewpoint"], a.max_range, a.crop)
        expect("points in range", self.points_of("range filter"), int(kept.sum()))
        require(not self.labels[~kept].any(), "a label on a point out of range")
        if a.voxel is None and a.method != "paper":
            self.grown_voxel(kept)
        self.beyond = self.before_plane(kept)
        if self.beyond is None:
            return
        self.voxels = oracle.Voxels(self.xyz[self.beyond], j["voxel"])
        expect("voxels", j["complex"]["vertices"], len(self.voxels))
        expect("voxels of the stage", self.points_of("voxel grid"), len(self.voxels))
        if a.method == "paper":
            self.paper()
        else:
            self.counted = True

    def grown_voxel(self, kept):
        """Checks the edge of a voxel without --voxel: at least 5 mm, for method surface at least 4 mm
        per metre of the upper quartile of the ranges, and larger by powers of 1.5 in sparse clouds.
        If a plane is removed, the quartile is only known to be at most the largest range."""
        j = self.json
        least = most = 0.005
        if self.asked.method == "surface" and kept.any():
            ranges = np.sort(np.linalg.norm(self.xyz[kept] - j["viewpoint"], axis=1))
            most = max(least, 0.004 * ranges[-1])
            if not j["plane"]["found"]:
                least = most = max(least, 0.004 * ranges[int(0.75 * (len(ranges) - 1))])
        edges = [j["voxel"] / 1.5 ** k for k in range(5)]
        require(any(least * (1 - 1e-9) <= edge <= most * (1 + 1e-9) for edge in edges), f"voxel {j['voxel']}")

    def before_plane(self, kept):
        """@return a mask of the points in front of the plane; None if the mask cannot be known."""
        j, a, plane = self.json, self.asked, self.json["plane"]
        require(a.plane or not plane["found"], "a plane though it is off")
        if not plane["found"]:
            expect("surfaces", j["surfaces"], [])
            return kept
        normal = np.array(plane["normal"])
        require(abs(normal @ normal - 1) < 1e-9, "normal of no length 1")
        with np.errstate(invalid="ignore", over="ignore"):
            height = self.xyz @ normal + plane["offset"]
        require(normal @ j["viewpoint"] + plane["offset"] >= -1e-9 * abs(self.xyz[kept]).max(initial=0),
                "the normal points away from the sensor")
        require(plane["share"] >= 0.1, "a plane of less than a tenth of the points")
        margin = a.plane_distance or (0.006 if a.method == "paper" else 0.005)
        if a.method != "paper":
            # The base of an object may be within the margin of the plane.
            return None
        near = abs(abs(height[kept]) - margin) < 1e-9 * margin + 1e-14 * abs(self.xyz[kept]).max(initial=0)
        if near.any():
            raise Unsure("a point at the margin of the plane")
        beyond = kept & (height > margin)
        expect("points before the plane", self.points_of("plane"), int(beyond.sum()))
        # Duplicates of a point count once.
        _, once = np.unique(self.xyz[kept] + 0.0, axis=0, return_index=True)
        share = (abs(height[kept][once]) <= margin).mean()
        require(math.isclose(share, plane["share"], rel_tol=1e-9), f"share: found {plane['share']}, expected {share}")
        return beyond

    def of_point(self):
        """The voxel of each point; -1 for none."""
        of_point = np.full(len(self.xyz), -1)
        of_point[self.beyond] = self.voxels.of_point
        return of_point

    def paper(self):
        j, a = self.json, self.asked
        self.rips = oracle.Rips(self.voxels, a.distance, a.steps)
        expect("edges", j["complex"]["edges"], len(self.rips.pairs))
        expect("distance", j["complex"]["distance"], a.distance)
        names = self.rips.components(a.value())
        labels, of_vertex = segments_of(names, a.least_voxels(), self.of_point(), len(self.xyz))
        require(same_partition(self.labels, labels),
                f"labels: found {self.labels.tolist()}, expected {labels.tolist()}")
        self.counted = True
        values, of_edge = self.rips.values(), of_vertex[self.rips.pairs]
        first = {}
        found = np.zeros(len(of_vertex), int)
        found[self.of_point()[self.beyond]] = self.labels[self.beyond]
        for (u, v), value in zip(found[self.rips.pairs].tolist() if len(of_edge) else [], values.tolist()):
            if u != v and u and v:
                first[min(u, v), max(u, v)] = min(value, first.get((min(u, v), max(u, v)), math.inf))
        told = {(s["label"], n["label"]): n["meets_at"] for s in j["segments"] for n in s["neighbours"]
                if s["label"] < n["label"]}
        expect("neighbours", sorted(told), sorted(first))
        slack = 3 * self.voxels.error + 1e-12 * a.distance
        for pair, value in told.items():
            require(abs(value - first[pair]) <= slack, f"segments {pair} meet at {value}, expected {first[pair]}")
        for s in j["segments"]:
            expect("persistence", s["persistence"], s["meets_at"])

    def barcode(self, bars):
        """Checks the bars that --barcode wrote."""
        require(all(d == 0 for d, _, _ in bars), "a bar of another dimension")
        if self.asked.method != "paper" or not self.counted:
            return
        try:
            deaths = sorted(self.rips.deaths())
        except Unsure:
            return
        found = sorted(death for _, _, death in bars if death < math.inf)
        deaths = [d for d in deaths if d > 0]
        require(all(birth == 0 for _, birth, _ in bars), "a component of the Rips complex that is born late")
        slack = 3 * self.voxels.error + 1e-12 * self.asked.distance
        require(len(found) == len(deaths) and all(abs(f - d) <= slack for f, d in zip(found, deaths)),
                f"barcode: found {found}, expected {deaths}")
        expect("bars that never die", len(bars) - len(found), len(self.voxels) - len(self.rips.deaths()))

    def tree(self, tree):
        """Checks the tree that --tree FILE.json wrote."""
        j, a = self.json, self.asked
        fault = oracle.replay(tree)
        require(fault is None, f"tree: {fault}")
        for name in ("method", "voxel", "viewpoint", "surfaces", "noise", "cut"):
            expect(f"tree: {name}", tree[name], j[name])
        expect("tree: edges", tree["edges"], j["complex"]["edges"])
        expect("tree: vertices", len(tree["vertices"]), j["complex"]["vertices"])
        of_point, count = np.array(tree["vertex_of_point"], int), len(tree["vertices"])
        expect("tree: points", len(of_point), len(self.xyz))
        of_vertex = np.zeros(count, int)
        for v, label in zip(of_point.tolist(), self.labels.tolist()):
            require(v >= 0 or label == 0, "a label on a point without a vertex")
            if label:
                require(of_vertex[v] in (0, label), f"vertex {v} has two labels")
                of_vertex[v] = label
        for s in j["segments"]:
            expect(f"segment {s['label']}: voxels", s["voxels"], int((of_vertex == s["label"]).sum()))
        if self.voxels is not None:
            self.vertices(tree, of_point)
        if a.method != "paper":
            self.cut(tree, of_point, of_vertex)

    def vertices(self, tree, of_point):
        require((of_point == self.of_point()).all(), "points are in other voxels than expected")
        expect("points of the voxels", [v["points"] for v in tree["vertices"]], self.voxels.counts.tolist())
        centroids = np.array([v["centroid"] for v in tree["vertices"]]).reshape(-1, 3)
        require((abs(centroids - self.voxels.centroids) <= self.voxels.error).all(), "centroids")
        if self.asked.method == "paper":
            require(all(v["birth"] == 0 for v in tree["vertices"]), "a voxel that is born late")

    def cut(self, tree, of_point, of_vertex):
        """For methods surface and supervoxels: checks that segments are basins, or unions of
        basins."""
        a, count = self.asked, len(tree["vertices"])
        centroids = np.array([v["centroid"] for v in tree["vertices"]]).reshape(-1, 3)
        births = np.array([math.inf if v["birth"] is None else v["birth"] for v in tree["vertices"]])
        require((births >= 0).all(), "a birth below 0")
        graph = oracle.Voxels.__new__(oracle.Voxels)
        graph.centroids, graph.cells, graph.edge, graph.error = centroids, centroids, tree["voxel"], 0
        graph.exact = np.zeros(count, bool)
        pairs, lengths = oracle.close_pairs(graph, SURELY_NOT * tree["voxel"] * 1.00000123)
        surely = pairs[lengths < SURELY_ADJACENT * tree["voxel"]]
        require(len(surely) <= tree["edges"] <= len(pairs), f"edges: found {tree['edges']}, expected between "
                f"{len(surely)} and {len(pairs)}")
        known = {(min(p), max(p)) for p in pairs.tolist()}
        forest = oracle.Sets(count)
        for m in tree["merges"]:
            u, v = m["edge"]
            require((min(u, v), max(u, v)) in known, f"merge of {u} and {v}, which are not adjacent")
            expect("value of a merge", m["value"], max(births[u], births[v]))
            forest.join(u, v)
        trees = forest.names()
        for u, v in surely.tolist():
            require(trees[u] == trees[v] or math.isinf(max(births[u], births[v])), f"{u} and {v} never join")
        if a.method == "supervoxels" and count:
            self.seeds(centroids, births)
        names = oracle.basins(tree["merges"], count, a.value(), a.least_part())
        entered = np.isfinite(births)
        is_plain = a.method == "supervoxels" or a.parts
        for name in np.unique(names[entered]):
            require(len(set(of_vertex[entered & (names == name)])) == 1, "a basin in two segments")
        if is_plain and all(s["role"] == "support" for s in self.json["surfaces"]) and len(self.json["surfaces"]) <= 1:
            labels, _ = segments_of(names, a.least_voxels(), of_point, len(self.xyz))
            require(same_partition(self.labels, labels),
                    f"cut: found {self.labels.tolist()}, expected {labels.tolist()}")
        self.meetings(pairs, lengths, births, of_vertex)
        for s in self.json["segments"]:
            if s["meets_at"] is not None:
                expect(f"segment {s['label']}: persistence", s["persistence"],
                       s["meets_at"] - births[of_vertex == s["label"]].min())

    def seeds(self, centroids, births):
        """Checks that no voxel is farther from a seed than requested."""
        seeds = centroids[births == 0]
        apart = np.sqrt(((centroids[:, None] - seeds[None]) ** 2).sum(axis=2).min(axis=1)) if len(seeds) else np.inf
        require(np.max(apart) <= self.asked.spacing * (1 + 1e-9), f"a voxel is {np.max(apart)} from all seeds")

    def meetings(self, pairs, lengths, births, of_vertex):
        """Checks the values at which segments meet. Each lies between the value for all edges that
        may exist and the value for only the edges that certainly exist."""
        told = {(s["label"], n["label"]): n["meets_at"] for s in self.json["segments"] for n in s["neighbours"]}
        for far, sign in ((SURELY_ADJACENT, 1), (9, -1)):
            first = {}
            for (u, v), length in zip(pairs.tolist(), lengths.tolist()):
                a, b = of_vertex[u], of_vertex[v]
                if a != b and a and b and length < far * self.json["voxel"]:
                    value = max(births[u], births[v])
                    for pair in ((a, b), (b, a)):
                        first[pair] = min(value, first.get(pair, math.inf))
            if sign > 0:
                require(all(told.get(p, math.inf) is None or told.get(p, math.inf) <= v for p, v in first.items()),
                        f"neighbours: found {told}, expected {first}")
            else:
                require(all(p in first and (v is None or v >= first[p]) for p, v in told.items()),
                        f"neighbours: found {told}, expected at most {first}")

    def stored(self, content, tree):
        """Compares --tree FILE.tree with the tree in JSON."""
        stored = scene_files.read_tree(content)
        for name in ("method", "voxel", "viewpoint", "edges"):
            expected = self.json["complex"]["edges"] if name == "edges" else self.json[name]
            expect(f"stored tree: {name}", stored[name], expected)
        if tree is None:
            return
        expect("stored tree: vertices of points", stored["vertex_of_point"].tolist(), tree["vertex_of_point"])
        expect("stored tree: centroids", stored["centroids"].tolist(), [v["centroid"] for v in tree["vertices"]])
        expect("stored tree: counts", stored["counts"].tolist(), [v["points"] for v in tree["vertices"]])
        expect("stored tree: births", [b if b < math.inf else None for b in stored["births"].tolist()],
               [v["birth"] for v in tree["vertices"]])
        expect("stored tree: merges", [(v, {a, b}) for v, a, b in stored["merges"]],
               [(m["value"], set(m["edge"])) for m in tree["merges"]])

    def cloud(self, content, with_labels=True):
        """Checks the cloud of -o: the same points with all their fields. With --coloured, each
        segment has one colour."""
        columns, shape = scene_files.read_cloud(content)
        if shape is not None:
            expect("rows and columns", shape, self.file.shape or (1, len(self.xyz)))
        found, given = scene_files.unpacked(columns), scene_files.unpacked(dict(self.file.fields))
        # PCD stores coordinates in single precision, unless they are very large.
        near = np.nanmax([np.abs(given[c]) for c in "xyz"], initial=0) <= 1024
        single = not with_labels or (content.startswith(b"# .PCD") and near)
        for name, values in given.items():
            if not with_labels and name not in "xyz":
                continue
            name = "label_in" if name == "label" else name
            if content.startswith(b"# .PCD") and name in ("nx", "ny", "nz"):
                name = f"normal_{name[1]}"
            elif content.startswith(b"ply") and name in ("normal_x", "normal_y", "normal_z"):
                name = f"n{name[7]}"
            require(name in found, f"no field {name}")
            values = oracle.as_floats(values) if single and name in "xyz" else values
            exact = np.array_equal(found[name].astype("f8"), values.astype("f8"), equal_nan=True)
            if self.scene.depth is not None and not exact:
                exact = np.allclose(found[name], values, rtol=2e-7, equal_nan=True)
            require(exact, f"field {name}: found {found[name].tolist()}, expected {values.tolist()}")
        if with_labels:
            return expect("field label", found["label"].tolist(), self.labels.tolist())
        colours = {}
        for label, *colour in zip(self.labels.tolist(), *(found[c].tolist() for c in ("red", "green", "blue"))):
            if label == 0:
                require(len(set(colour)) == 1, f"found {colour} on a point without a label, expected grey")
            else:
                expect(f"colour of segment {label}", colour, colours.setdefault(label, colour))
        return None
