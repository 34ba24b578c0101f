# SPDX-License-Identifier: MIT
"""ph-barcode --report: tests the data and the trees on the pages of points, images and
complexes."""
import json
import math
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import files, main  # noqa: E402
from report_reader import NONE  # noqa: E402
from report_test import ReportTest, circle  # noqa: E402


class Data(ReportTest):
    def test_points_are_those_of_the_input(self):
        self.write("p.csv", "x,y,z\n0,1,2\n1e6,-3,0.1\n5,5,5.25\n")
        report = self.report("p.csv")
        self.assertEqual(report.arrays["points/position"].rows(),
                         [(0, 1, 2), (1e6, -3, 0.1), (5, 5, 5.25)])
        self.assertEqual(report.meta["cloud"]["metric"], "euclidean")
        self.assertNotIn("points/index", report)

    def test_many_points_are_quantised(self):
        rng = random.Random(2)
        points = [(rng.random(), 5 * rng.random()) for _ in range(51_000)]
        self.write("p.txt", "".join(f"{x} {y}\n" for x, y in points))
        report = self.report("p.txt", "--max-dim", "0", "-o", "p.csv")
        self.assertEqual(report.arrays["points/position"].type, "u16")
        for (x, y), (u, v) in zip(points, report.arrays["points/position"].rows()):
            self.assertLess(abs(x - u), 1 / 65535)
            self.assertLess(abs(y - v), 5 / 65535)
        self.assertLess(os.path.getsize(self.path("r.html")), 4_000_000)

    def test_points_that_are_left_out_keep_the_numbers_of_the_others(self):
        self.write("p.txt", "0 0\nnan 1\n1 0\n0 2\n")
        report = self.report("p.txt", "--nan", "drop")
        self.assertEqual(report["points/index"], [0, 2, 3])
        self.assertEqual(set(report["bars/birth_cells"]), {0, 2, 3})

    def test_points_in_more_dimensions_are_projected(self):
        self.write("p.txt", "0 0 0 0\n1 2 3 4\n")
        report = self.report("p.txt")
        self.assertEqual(report.arrays["points/position"].rows(), [(0, 0, 0), (1, 2, 3)])
        self.assertEqual(report.meta["cloud"]["projection"], "first 3 of 4 coordinates")

    def test_components_of_the_tree_are_the_living_bars(self):
        self.write("c.txt", circle(50, 0.3, 4) + "9 9\n9 9\n9.1 9\n")
        report = self.report("c.txt")
        finite = [d for dim, _, d in report.bars() if dim == 0]
        for cut in (0.0, 0.05, 0.1, 0.2, 1.0):
            labels = report.leaf_labels(cut)
            self.assertEqual(max(labels), sum(d > cut for d in finite))
        self.assertEqual(len(report["points/leaf"]), 53)
        # Points 50 and 51 are equal.
        self.assertEqual(report["points/leaf"][50], report["points/leaf"][51])

    def test_the_first_cut_is_in_the_widest_gap(self):
        self.write("c.txt", "0\n1\n2\n10\n11\n")
        # The first cut is the geometric mean of 1 and 8, rounded to three digits.
        self.assertEqual(self.report("c.txt").meta["tree"]["cut"], 2.83)
        self.write("c.txt", "0\n1\n2.1\n3.1\n")
        self.assertEqual(self.report("c.txt").meta["tree"]["cut"], 1.1)  # no ratio is large
        self.write("c.txt", "7\n")
        self.assertEqual(self.report("c.txt").meta["tree"]["cut"], 0)

    def test_every_merge_of_a_length_has_its_bar(self):
        self.write("c.txt", circle(40, 0.3, 5))
        report = self.report("c.txt")
        bars = report.bars()
        for bar, value in zip(report["tree/merge_bar"], report["tree/merge_value"]):
            self.assertNotEqual(bar, NONE)
            self.assertEqual(bars[bar][2], value)
        (leaf, bar), = report.arrays["tree/leaf_bar"].rows()
        self.assertEqual(bars[bar], (0, 0, math.inf))
        self.assertEqual(sorted(report["tree/merge_bar"] + [bar]),
                         [i for i, b in enumerate(bars) if b[0] == 0])

    def test_distances_have_a_tree_and_no_points(self):
        self.write("d.txt", "0 1 5\n1 0 4\n5 4 0\n")
        report = self.report("d.txt", "--format", "distance")
        self.assertEqual(report["tree/merge_value"], [1, 4])
        self.assertNotIn("points/position", report)

    def test_samples_and_approximations_have_no_tree(self):
        self.write("c.txt", circle(40, 0.3))
        for option in (("--subsample", "10"), ("--approximate", "0.5")):
            report = self.report("c.txt", *option)
            self.assertNotIn("tree", report.meta)
            self.assertIn("Approximation", report.meta["provenance"]["notes"])

    def test_an_image(self):
        rows, columns = 9, 11
        rng = random.Random(3)
        values = [float(rng.randrange(40)) for _ in range(rows * columns)]
        self.write("i.npy", files.array((rows, columns), values))
        report = self.report("i.npy", "-o", "i.json")
        self.assertEqual(report.arrays["image/values"].shape, [rows, columns])
        self.assertEqual(report["image/values"], values)
        bars = json.loads(self.read("i.json"))["bars"]
        self.assertEqual([v for b in bars for v in b["birth_cell"]["grid"]],
                         report["bars/birth_cells"])
        self.assertEqual(report.meta["image"], {"construction": "vertices"})
        levels = {b["death"] - b["birth"] for b in bars if b["dim"] == 0 and b["death"]}
        self.assertEqual(set(report["tree/merge_level"]), levels)
        for cut in sorted(levels) + [100]:
            self.assertEqual(max(report.leaf_labels(cut)),
                             sum(b["death"] is None or b["death"] - b["birth"] >= cut
                                 for b in bars if b["dim"] == 0))

    def test_an_image_from_above_and_of_cells(self):
        self.write("i.npy", files.array((2, 3), [0, 1, 2, 5, 4, 3]))
        report = self.report("i.npy", "--superlevel")
        self.assertEqual(report["image/values"], [0, 1, 2, 5, 4, 3])
        # Births are the negated values, as the metadata say.
        self.assertNotIn("points/birth", report)
        self.assertIs(report.meta["value"]["negated"], True)
        self.assertEqual(report.meta["value"]["label"], "Value")
        report = self.report("i.npy", "--construction", "cells")
        self.assertNotIn("negated", report.meta["value"])
        self.assertEqual(report.meta["image"], {"construction": "cells"})
        self.assertNotIn("tree", report.meta)

    def test_voxels_that_are_absent_are_no_numbers(self):
        self.write("n.npy", files.array((2, 2), [1, math.nan, 2, 0.5]))
        for way in ([], ["--superlevel"]):
            values = self.report("n.npy", "--nan", "drop", *way)["image/values"]
            self.assertEqual([v for v in values if math.isfinite(v)], [1, 2, 0.5])

    def test_axes_in_space_have_names(self):
        self.write("p.csv", "0,0,0\n2,0,0\n0,3,0\n0,0,4\n")
        report = self.report("p.csv", "--complex", "cubical", "--voxel", "1")
        self.assertEqual(report.meta["image"]["axes"], ["x", "y", "z"])
        self.write("i.npy", files.array((2, 2, 2), range(8)))
        self.assertNotIn("axes", self.report("i.npy").meta["image"])

    def test_without_a_wide_ratio_the_first_cut_is_in_the_widest_difference(self):
        # Minima between walls of height 200, with persistences 100, 95, 90, 80, 77.
        self.write("i.npy", files.array((1, 11), [0, 200, 100, 200, 105, 200, 110, 200, 120, 200, 123]))
        report = self.report("i.npy")
        self.assertEqual(report.meta["tree"]["cut"], 84.9)
        self.assertEqual(max(report.leaf_labels(84.9)), 4)

    def test_a_mesh_without_basins_is_no_comb(self):
        # Heights increase along a strip: each vertex joins the tree at its own value.
        rows = [(x, y) for x in range(6) for y in range(2)]
        faces = [f for x in range(5) for f in ((2 * x, 2 * x + 1, 2 * x + 2),
                                               (2 * x + 1, 2 * x + 2, 2 * x + 3))]
        self.write("m.off", f"OFF\n{len(rows)} {len(faces)} 0\n"
                   + "".join(f"{x} {y} 0\n" for x, y in rows)
                   + "".join("3 %d %d %d\n" % f for f in faces))
        self.write("v.txt", "".join(f"{2 * x + y}\n" for x, y in rows))
        report = self.report("m.off", "--values", "v.txt")
        self.assertEqual(report["tree/leaf_vertices"], [12])
        self.assertEqual(report["tree/merge_value"], [])
        self.assertGreater(report.meta["tree"]["cut"], 0)

    def test_sets_of_voxels_are_those_of_the_json(self):
        rng = random.Random(8)
        for shape in ((9, 11), (5, 6, 7)):
            count = math.prod(shape)
            self.write("i.npy", files.array(shape, [float(rng.randrange(60)) for _ in range(count)]))
            for construction in ("vertices", "cells"):
                report = self.report("i.npy", "--representatives", "voxels", "-o", "i.json",
                                     "--construction", construction)
                self.assertEqual(report.meta["barcodes"][0]["representatives"], "voxels")
                bars = json.loads(self.read("i.json"))["bars"]
                runs, start = report.arrays["voxels/runs"].rows(), report["voxels/start"]
                sets = {bar: runs[start[i]:start[i + 1]]
                        for i, bar in enumerate(report["voxels/bar"])}
                self.assertEqual(sets, {i: [tuple(run) for run in bar["voxels"]]
                                        for i, bar in enumerate(bars) if "voxels" in bar})
                self.assertEqual({bars[i]["dim"] for i in sets}, {0, len(shape) - 1})
                self.assertEqual(report["chains/bar"],
                                 [i for i, bar in enumerate(bars) if "representative" in bar])
                self.assertNotIn("Sets of voxels", report.meta["provenance"].get("notes", {}))

    def test_sets_that_are_too_large_are_left_out_with_a_note(self):
        # A comb: each tooth is one voxel wide, and merges into the next tooth together with all
        # earlier teeth.
        rows, columns = 400, 400
        values = [float(columns - x if x % 2 == 0 else 9999 if y else columns + x)
                  for y in range(rows) for x in range(columns)]
        self.write("i.npy", files.array((rows, columns), values))
        report = self.report("i.npy", "--representatives", "voxels", "--max-dim", "0")
        note = report.meta["provenance"]["notes"]["Sets of voxels"]
        self.assertRegex(note, r"^sets of the \d+ most persistent of \d+ bars")
        runs = len(report.arrays["voxels/runs"].rows())
        self.assertTrue(300_000 < runs <= 400_000, runs)
        self.assertLess(os.path.getsize(self.path("r.html")), 12_000_000)

    def test_images_that_a_page_cannot_show(self):
        for shape in ((8,), (2, 2, 2, 2)):
            count = math.prod(shape)
            self.write("i.npy", files.array(tuple(shape),
                                    [float(i * 7 % 5) for i in range(count)]))
            report = self.report("i.npy", "--format", "npy", "--complex", "cubical")
            self.assertNotIn("image/values", report)
            self.assertNotIn("bars/birth_cells", report)
            self.assertIn("Image", report.meta["provenance"]["notes"])

    def test_simplices_and_meshes(self):
        self.write("s.txt", "0 : 0\n1 : 1\n2 : 0.5\n0 1 : 2\n1 2 : 3\n")
        report = self.report("s.txt", "--format", "simplices")
        self.assertEqual(sorted(report["tree/merge_level"]), [1, 2.5])
        self.write("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
        self.write("v.txt", "3\n1\n2\n")
        report = self.report("m.off", "--values", "v.txt")
        self.assertEqual(report.arrays["points/position"].shape, [3, 3])
        self.assertNotIn("points/leaf", report)

    def edges_of(self, report):
        """The edges in stored order as (value, smaller end, larger end); checks that values never
        decrease."""
        values = report["complex/edge_values"]
        self.assertEqual(values, sorted(values))
        return [(v, *sorted(ends)) for v, ends in zip(values, report.arrays["complex/edges"].rows())]

    def test_edges_are_written_where_the_page_cannot_find_them(self):
        rng = random.Random(11)
        points = [[rng.randrange(50) / 4 for _ in range(4)] for _ in range(30)]
        points[7][2] = math.nan
        def lines(columns):
            return "".join(" ".join(map(str, p[:columns])) + "\n" for p in points)
        self.write("flat.txt", lines(2))
        self.write("deep.txt", lines(4))
        kept = [i for i in range(30) if i != 7]
        metrics = {"manhattan": lambda a, b: sum(abs(x - y) for x, y in zip(a, b)),
                   "chebyshev": lambda a, b: max(abs(x - y) for x, y in zip(a, b)),
                   "euclidean": math.dist}
        for file, columns, metric in (("flat.txt", 2, "manhattan"), ("flat.txt", 2, "chebyshev"),
                                      ("deep.txt", 4, "euclidean")):
            report = self.report(file, "--nan", "drop", "--metric", metric, "--threshold", "6",
                                 "--min-persistence", "-1")
            ids = kept if columns == 4 else range(30)
            distance = metrics[metric]
            expected = [(d, i, j) for i in ids for j in ids if i < j
                        and (d := distance(points[i][:columns], points[j][:columns])) <= 6]
            found = self.edges_of(report)
            self.assertEqual(sorted(e[1:] for e in found), sorted(e[1:] for e in expected))
            for (value, *_), (other, *_) in zip(found, sorted(expected)):
                self.assertAlmostEqual(value, other, 5)
            self.assertNotIn("edges_below", report.meta["cloud"])
        for options in (("--nan", "drop"), ("--metric", "manhattan", "--max-dim", "0")):
            self.assertNotIn("complex/edges", self.report("flat.txt", *options))

    def test_alpha_complexes_name_points_as_in_the_input(self):
        rng = random.Random(14)
        points = [[rng.randrange(40) / 4, rng.random()] for _ in range(40)]
        points[3] = [math.nan, 0.0]
        points[20] = points[21]  # a copy of point 21
        self.write("p.txt", "".join(" ".join(map(str, p)) + "\n" for p in points))
        self.write("w.txt", "".join("0.01\n" if i != 5 else "-9\n" for i in range(40)))
        for options in ((), ("--alpha-values", "squared", "--weights", "w.txt")):
            report = self.report("p.txt", "--complex", "alpha", "--nan", "drop", *options)
            rows = [i for i in range(40) if i != 3]
            self.assertEqual(report["points/index"], rows)
            hidden = {5, 21} if options else set()
            named = {v for ends in report.arrays["complex/edges"].rows() for v in ends}
            self.assertEqual(named, set(rows) - hidden)
            # The tree of the page joins two points at the value at which a chain of balls joins
            # them.
            leaf = report["points/leaf"] if "points/leaf" in report else list(range(len(rows)))
            merges = list(zip(report["tree/merge_level"], report["tree/merge_younger"],
                              report["tree/merge_elder"]))
            for radius in () if options else (0, 0.1, 0.15, 0.3):
                of_leaf = list(range(len(leaf)))
                of_row = list(range(len(rows)))
                def joined(of, a, b):
                    return [of[a] if c == of[b] else c for c in of]
                for level, younger, elder in merges:
                    if level <= radius:
                        of_leaf = joined(of_leaf, younger, elder)
                for i, a in enumerate(rows):
                    for j, b in enumerate(rows[:i]):
                        if math.dist(points[a], points[b]) <= 2 * radius:
                            of_row = joined(of_row, i, j)
                for i in range(len(rows)):
                    self.assertEqual([of_leaf[leaf[j]] == of_leaf[leaf[i]] for j in range(len(rows))],
                                     [of_row[j] == of_row[i] for j in range(len(rows))])

    def test_samples_and_weights_show_their_own_edges(self):
        self.write("p.txt", "0 0\n1 0\n0 1\n9 9\n")
        report = self.report("p.txt", "--subsample", "2")
        self.assertNotIn("metric", report.meta["cloud"])
        self.assertEqual(report.arrays["complex/edges"].rows(), [(0, 3)])
        self.write("w.txt", "0\n3\n0\n1\n")
        report = self.report("p.txt", "--vertex-weights", "w.txt", "--threshold", "5")
        self.assertEqual(report["points/birth"], [0, 3, 0, 1])
        self.assertTrue(all(value >= max(report["points/birth"][v] for v in ends)
                            for value, *ends in self.edges_of(report)))

    def test_of_too_many_edges_the_first_are_there(self):
        rng = random.Random(12)
        self.write("p.txt", "".join(f"{rng.random()} {rng.random()}\n" for _ in range(400)))
        report = self.report("p.txt", "--metric", "manhattan", "--threshold", "3")
        edges = self.edges_of(report)
        self.assertEqual(len(edges), 40_000)
        self.assertAlmostEqual(report.meta["cloud"]["edges_below"], edges[-1][0], 3)
        self.assertGreaterEqual(report.meta["cloud"]["edges_below"] + 1e-6, edges[-1][0])

    def test_a_mesh_has_its_values_edges_and_triangles(self):
        self.write("m.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n5 5 5\n3 0 1 2\n3 1 2 3\n")
        self.write("v.txt", "3\n1\n2\n0.5\n-4\n")
        report = self.report("m.off", "--values", "v.txt")
        self.assertEqual(report["points/birth"], [3, 1, 2, 0.5, -4])
        self.assertEqual(self.edges_of(report), [(1, 1, 3), (2, 1, 2), (2, 2, 3), (3, 0, 1),
                                                 (3, 0, 2)])
        self.assertEqual([sorted(t) for t in report.arrays["complex/triangles"].rows()],
                         [[1, 2, 3], [0, 1, 2]])
        self.assertEqual(report["complex/triangle_values"], [2, 3])

    def test_a_mesh_has_all_its_triangles(self):
        side = 240
        faces = [f"3 {i} {i + 1} {i + side}\n3 {i + 1} {i + side} {i + side + 1}\n"
                 for y in range(side - 1) for i in range(y * side, y * side + side - 1)]
        self.write("m.off", f"OFF\n{side * side} {2 * len(faces)} 0\n"
                   + "".join(f"{i % side} {i // side} 0\n" for i in range(side * side))
                   + "".join(faces))
        self.write("v.txt", "".join(f"{i % 7}\n" for i in range(side * side)))
        report = self.report("m.off", "--values", "v.txt", "--max-dim", "0")
        self.assertEqual(len(report["complex/triangle_values"]), 2 * (side - 1) ** 2)
        self.assertNotIn("triangles_below", report.meta["cloud"])

    def test_the_default_cut_is_below_what_stands_out(self):
        # The largest ratio of consecutive bar lengths, 0.009 : 0.0001, belongs to bars that are far
        # shorter than the longest bar. The cut is therefore at the next largest ratio, 0.5 : 0.01.
        self.write("p.txt", "0\n0.0001\n0.0101\n0.0191\n0.5191\n1.5191\n")
        cut = self.report("p.txt", "--max-dim", "0").meta["tree"]["cut"]
        self.assertTrue(0.01 < cut < 0.5, cut)


if __name__ == "__main__":
    main()
