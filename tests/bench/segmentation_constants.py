# SPDX-License-Identifier: MIT
"""bench/scenes/constants.py: the constants of a source are found, each change of the table gives
other values, and a frame with another F is counted."""
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

try:
    import numpy
except ModuleNotFoundError:
    print("SKIPPED: no NumPy")
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench/scenes"))
import constants  # noqa: E402
import declarations  # noqa: E402

SOURCE = """
#include "0.25.hpp"
constexpr double kA = 3, kB = 0.5;  // constexpr double kComment = 4;
static constexpr std::size_t kC = 1 << 18, kD = kC;
inline constexpr Margin kE{0.02, 1'000};
constexpr std::array<int, 2> kF = {5, 6};
constexpr char kG = '7';
if constexpr (sizeof(int) == 4) return 8;
"""


def constant(name):
    return next(c for c in declarations.constants_in(SOURCE) if c.name == name)


class Declarations(unittest.TestCase):
    def test_names_values_and_places(self):
        found = declarations.constants_in(SOURCE)
        self.assertEqual([(c.name, c.value) for c in found],
                         [("kA", "3"), ("kB", "0.5"), ("kC", "1 << 18"), ("kE", "0.02, 1'000"), ("kF", "{5, 6}")])
        for c in found:
            self.assertEqual(SOURCE[c.begin:c.end], c.value)


class Changes(unittest.TestCase):
    def test_values(self):
        for name, change, values in (("kA", "x 1.5 and / 1.5", ["4.5", "2"]),
                                     ("kE", "x 1.5 and / 1.5", ["0.03, 1500", "0.0133333, 666.667"]),
                                     ("kF", "x 1.5 and / 1.5", ["{8, 9}", "{3, 4}"]),
                                     ("kB", "+ 1 and - 1", ["1.5", "-0.5"]),
                                     ("kC", "to 1 << 17 and 1 << 19", ["1 << 17", "1 << 19"]),
                                     ("kA", "to 7", ["7"]), ("kA", "off: -1", ["-1"])):
            with self.subTest(change):
                self.assertEqual(list(constants.values(constant(name), change).values()), values)
        with self.assertRaises(SystemExit):
            constants.values(constant("kA"), "x 2")

    def test_each_change_of_the_table_gives_other_values(self):
        for row in constants.read():
            path = ROOT / constants.LIBRARY / row["file"]
            known = [c for c in declarations.constants_in(path.read_text()) if c.name == row["name"]]
            if row["change"].startswith("none: ") or not known:  # tests/headers/constants.py finds lost ones
                continue
            with self.subTest(f"{row['file']}: {row['name']}"):
                values = constants.values(known[0], row["change"]).values()
                self.assertNotIn(known[0].value, values)
                self.assertEqual(len(set(values)), len(values))


class Counts(unittest.TestCase):
    ROW = {"file": "src/methods.cpp", "name": "kAdjacent", "change": "x 1.5 and / 1.5",
           "visible": "", "generated": "", "rare": ""}

    def measured(self, builds, scores, row=ROW, changes=4):
        """The cells of a row of a real constant. @param builds for each change, first on visible and
        generated frames and then on rare ones, whether it compiles. @param scores for each change
        that compiles, F of objects and of parts of each frame."""
        row = dict(row)
        copy = mock.Mock()
        copy.build.side_effect = [None if good else constants.Failure("no") for good in builds]
        frames = [constants.Frame(group, path, "", ()) for group, path in
                  (("visible", "a"), ("visible", "b"), ("generated", "c"), ("rare", "d"))]
        baseline = {name: [0.9, 0.8] for name in "abcd"}
        with mock.patch.object(constants, "scores_of", side_effect=scores), mock.patch("sys.stderr"):
            constants.measure(row, copy, frames, baseline, {})
        self.assertEqual(copy.restore.call_count, changes)
        return row["visible"], row["generated"], row["rare"]

    def test_a_frame_counts_once_if_objects_or_parts_differ(self):
        same, good = [0.9, 0.8], [True] * 4
        self.assertEqual(
            self.measured(good, [[0.88, 0.8], [0.905, 0.8], same, [0.9, 0.9], same, same, same, same]),
            ("1 / 2", "0 / 1", "0 / 1"))
        self.assertEqual(
            self.measured(good, [same, [0.9, 0.82], same, same, same, [0, 0], same, [0.8, 0.8]]),
            ("1 / 2", "1 / 1", "1 / 1"))

    def test_rare_frames_are_for_constants_that_few_others_feel(self):
        self.assertEqual(self.measured([True] * 2, [[0, 0]] * 6, changes=2), ("2 / 2", "1 / 1", ""))
        known = {**self.ROW, "visible": "1 / 2", "generated": "0 / 1"}
        self.assertEqual(self.measured([True] * 2, [[0, 0]] * 2, known, changes=2),
                         ("1 / 2", "0 / 1", "1 / 1"))

    def test_a_change_that_does_not_compile_is_told(self):
        fault = "; / 1.5: does not compile"
        self.assertEqual(self.measured([True, False] * 2, [[0.5, 0.5], [0.9, 0.8], [0.9, 0.8], [0, 0]]),
                         ("1 / 2" + fault, "0 / 1" + fault, "1 / 1" + fault))
        self.assertEqual(self.measured([False] * 4, []), ("x 1.5 and / 1.5: does not compile",) * 3)


class Runs(unittest.TestCase):
    def test_a_run_that_fails_scores_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            truth = pathlib.Path(folder, "truth.npy")
            numpy.save(truth, numpy.array([1, 20, 20]))
            frame = constants.Frame("visible", pathlib.Path("no.pcd"), truth, [])
            self.assertEqual(constants.scores_of("/bin/false", frame, {}), [0.0, 0.0])


if __name__ == "__main__":
    unittest.main()
