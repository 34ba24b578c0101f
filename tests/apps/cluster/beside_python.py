# SPDX-License-Identifier: MIT
"""Compares ph-cluster with the package: libph.sklearn.HDBSCAN on data sets of PH_TEST_DATA, and
libph.cluster_tree on random points. Skipped without NumPy, scikit-learn or the package."""
import json
import os
import sys

try:
    import numpy
    import libph
    from libph.sklearn import HDBSCAN
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, main  # noqa: E402

TEST_DATA = os.environ.get("PH_TEST_DATA", "")
SETS = ["data/klein_900.txt", "data/dragon_2000.txt", "data/o3_1024.txt", "data/torus_2000.txt"]


class BesidePython(ProgramTest):
    def same(self, points, path, *options, **parameters):
        """@return the number of clusters."""
        model = HDBSCAN(**parameters).fit(points)
        self.expect(0, path, *options, "--scores", "-o", "l.npy", "--tree", "t.json", "--quiet")
        found = numpy.load(self.path("l.npy"))
        numpy.testing.assert_array_equal(found[:, 0], model.labels_)
        numpy.testing.assert_array_equal(found[:, 1], model.probabilities_)
        numpy.testing.assert_array_equal(found[:, 2], model.outlier_scores_)
        tree = json.loads(self.read("t.json"))
        # The estimator keeps rows with NaN as points that never join the root.
        tree["clusters"][-1]["size"] += (model.labels_ == -3).sum()
        for name in ("parent", "top", "bottom", "least", "size", "mass"):
            values = [numpy.inf if c[name] is None else c[name] for c in tree["clusters"]]
            numpy.testing.assert_array_equal(values, model.cluster_tree_.clusters[name])
        rows = numpy.flatnonzero(model.labels_ != -3)
        numpy.testing.assert_array_equal(numpy.array(tree["cluster_of"])[rows], model.cluster_tree_.cluster_of[rows])
        return model.labels_.max() + 1

    def test_data_sets(self):
        there = [path for path in SETS if os.path.exists(os.path.join(TEST_DATA, path))]
        if not there:
            self.skipTest(f"PH_TEST_DATA, which is {TEST_DATA!r}, has none of {', '.join(SETS)}")
        for name in there:
            path = os.path.join(TEST_DATA, name)
            points = numpy.loadtxt(path)
            counts = [self.same(points, path),
                      self.same(points, path, "--min-size", "15", "--neighbours", "3",
                                min_cluster_size=15, min_samples=4),
                      self.same(points, path, "--method", "leaf", cluster_selection_method="leaf"),
                      self.same(points, path, "--metric", "manhattan", "--max-size", "50", metric="manhattan",
                                max_cluster_size=50)]
            print(f"{name}: {len(points)} points, clusters {counts}")
            self.assertGreater(max(counts), 1)

    def test_missing_rows_and_copies(self):
        rng = numpy.random.default_rng(1)
        points = numpy.round(rng.normal(rng.integers(0, 3, (400, 1)), .2, (400, 2)), 1)
        points[[3, 77]] = numpy.nan
        numpy.save(self.path("p.npy"), points)
        self.assertGreater(self.same(points, "p.npy", "--format", "points", "--nan", "drop", "--epsilon", "0.15",
                                     cluster_selection_epsilon=.15), 1)

    def test_distances(self):
        rng = numpy.random.default_rng(2)
        points = rng.normal(rng.integers(0, 3, (80, 1)), .1, (80, 2))
        distances = numpy.sqrt(((points[:, None] - points[None]) ** 2).sum(-1))
        numpy.fill_diagonal(distances, 0)
        distances[7, :] = distances[:, 7] = numpy.inf  # a point without neighbours
        distances[7, 7] = 0
        numpy.save(self.path("d.npy"), distances)
        self.assertGreater(self.same(distances, "d.npy", "--format", "distance", metric="precomputed"), 1)

    def test_single_linkage(self):
        points = numpy.random.default_rng(3).normal(size=(200, 2))
        numpy.savetxt(self.path("p.csv"), points, "%r", ",")
        tree = libph.cluster_tree(points, 4)
        run = self.expect(0, "p.csv", "--min-size", "4", "--neighbours", "0", "--quiet")
        numpy.testing.assert_array_equal(numpy.loadtxt(run.stdout.splitlines(), skiprows=1), tree.select().labels)


if __name__ == "__main__":
    main()
