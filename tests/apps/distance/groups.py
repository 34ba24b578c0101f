# SPDX-License-Identifier: MIT
"""ph-distance --groups: compares the loss with its definition, and the p-value with its exact value
over all ways to assign the labels."""
import itertools
import json
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, main  # noqa: E402
from diagrams import INF, csv_of, rows_of  # noqa: E402

# Deaths of barcodes with one bar each. The distance between two such barcodes is the difference
# between their deaths, as long as this difference is small.
DEATHS = [20.0, 21.5, 20.25, 23.0, 24.0, 21.0, 23.5]
WORDS = ["low", "low", "low", "high", "high", "low", "high"]


def loss_of(deaths, words, power):
    """The loss by the definition. For each group of n barcodes, the powers of the distances are
    summed over ordered pairs, and the sum is divided by 2 n (n - 1). The loss is the total of all
    groups."""
    loss = 0.0
    for word in set(words):
        own = [death for death, w in zip(deaths, words) if w == word]
        within = sum(abs(x - y)**power for x, y in itertools.permutations(own, 2))
        loss += within / (2 * len(own) * (len(own) - 1))
    return loss


class GroupsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.names = [self.write(f"{i}.csv", csv_of([(1, 0, death)])) for i, death in enumerate(DEATHS)]
        self.write("groups.txt", "\n".join(WORDS) + "\n")

    def result(self, *options, code=0):
        return self.expect(code, *self.names, "--groups", "groups.txt", *options)

    def test_loss_and_p(self):
        for power in (1, 2, 0.5):
            rows = rows_of(self.result("--shuffles", "4000", "--power", str(power), "--output-format", "csv").stdout)
            self.assertEqual(len(rows), 1)
            row = rows[0]
            loss = loss_of(DEATHS, WORDS, power)
            self.assertAlmostEqual(float(row["loss"]), loss, places=12)
            self.assertEqual([row[name] for name in ("dim", "distance", "order", "ground", "shuffles", "seed")],
                             ["1", "bottleneck", "inf", "inf", "4000", "0"])
            self.assertEqual(float(row["power"]), power)
            dealt = [loss_of(DEATHS, ["low" if i in low else "high" for i in range(7)], power)
                     for low in itertools.combinations(range(7), 4)]
            exact = sum(x <= loss * (1 + 1e-12) for x in dealt) / len(dealt)
            # The tolerance is five standard deviations of the share of shuffles, plus one shuffle.
            self.assertLess(abs(float(row["p"]) - exact), 5 * math.sqrt(exact * (1 - exact) / 4000) + 1 / 4000)

    def test_groups_that_do_not_differ(self):
        self.write("groups.txt", "a\nb\na\nb\na\nb\na\n")
        row, = rows_of(self.result("--output-format", "csv").stdout)
        self.assertGreater(float(row["p"]), 0.2)

    def test_what_is_written(self):
        text = self.result("--shuffles", "99", "--seed", "5", "--dim", "1").stdout
        self.assertRegex(text, r"^bottleneck distance \(order inf, ground norm inf\) of 7 barcodes: low 4, high 3\n"
                         r"H1  p 0\.\d+, loss [\d.]+ \(99 shuffles, power 1, seed 5\)\n$")
        found = json.loads(self.result("--shuffles", "99", "--seed", "5", "--output-format", "json").stdout)
        self.assertEqual((found["groups"], found["shuffles"], found["power"], found["seed"]), (WORDS, 99, 1, 5))
        test, = found["tests"]
        self.assertEqual(f"H1  p {test['p']}, loss {test['loss']} (99 shuffles, power 1, seed 5)", text.splitlines()[1])
        self.assertEqual([d["value"] for d in found["distances"]],
                         [abs(x - y) for x, y in itertools.combinations(DEATHS, 2)])
        # The option --matrix does not change the result. Anybody can recompute the result from the
        # matrix.
        self.assertEqual(self.result("--shuffles", "99", "--seed", "5", "--matrix", "m.csv").stdout, text)
        self.assertEqual(float(rows_of(self.read("m.csv"))[0]["3.csv"]), 3)

    def test_seeds_and_threads(self):
        results = {self.result("--shuffles", "200", "--seed", str(seed), "--output-format", "json").stdout
                   for seed in range(8)}
        p = {json.loads(text)["tests"][0]["p"] for text in results}
        self.assertGreater(len(p), 1)
        one = self.result("--shuffles", "200", "--threads", "1").stdout
        self.assertEqual(self.result("--shuffles", "200", "--threads", "4").stdout, one)
        self.assertEqual(self.result("--shuffles", "200", "--seed", "0").stdout, one)

    def test_each_dimension(self):
        self.names = [self.write(name, csv_of([(0, 0, 3), (1, 0, death)])) for name, death in zip(self.names, DEATHS)]
        rows = rows_of(self.result("--output-format", "csv").stdout)
        self.assertEqual([row["dim"] for row in rows], ["0", "1"])
        self.assertEqual((rows[0]["p"], rows[0]["loss"]), ("1", "0"))
        self.assertLess(float(rows[1]["p"]), 0.2)

    def test_files_of_groups(self):
        expected = self.result().stdout
        self.write("groups.txt", "# cohorts\r\n\nlow\nlow  # the second\n low\nhigh\nhigh\nlow\nhigh")
        self.assertEqual(self.result().stdout, expected)
        run = self.expect(0, *self.names, "--groups", "-", input="\n".join(WORDS))
        self.assertEqual(run.stdout, expected)
        count = "expected 7, one for each barcode, in the order of the barcodes"
        for text, words in (("\n".join(WORDS[1:]), ("found 6 words", count)),
                            ("\n".join([*WORDS, "low"]), ("found 8 words", count)), ("", ("found 0 words",)), ("a\n" * 7, ("found 1 group", "expected at least 2")),
                            ("a\na\na\na\na\na\nb\n", ("group b", "found 1 barcode", "at least 2")),
                            ("a b\n" * 7, ("groups.txt:1:2", '"a b"', "one word on each line")),
                            ("group,n\n", ("groups.txt:1:6",))):
            self.write("groups.txt", text)
            run = self.result(code=65)
            for word in words:
                self.assertIn(word, run.stderr)
            self.assertEqual(run.stdout, "")
        self.expect(66, *self.names, "--groups", "missing.txt")

    def test_infinite_distances_are_refused(self):
        self.write("3.csv", csv_of([(1, 0, 23), (1, 0, INF)]))
        run = self.result("-o", "x.csv", code=65)
        for word in ("0.csv and 3.csv", "H1", "0 and 1 bars that never die", "leave such bars out"):
            self.assertIn(word, run.stderr)
        self.assertNotIn("x.csv", self.files())


if __name__ == "__main__":
    main()
