# SPDX-License-Identifier: MIT
"""ph-vectorise: a stored fit gives the same vectors again."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest, files, main  # noqa: E402

TRAIN = ("dim,birth,death\n0,0,4\n0,1,2\n0,0,inf\n1,3,5\n1,1,4\n1,1.5,2\n",
         "dim,birth,death\n0,0,1\n1,2,3\n")
TEST = "dim,birth,death\n0,-1,7\n1,0,9\n2,1,3\n"
KINDS = {"statistics": [], "betti": ["--infinite", "keep"], "landscape": ["--layers", "2", "--grid", "9"],
         "silhouette": ["--power", "0.5"], "image": ["--grid", "4", "--length-grid", "5", "--power", "2"],
         "entropy": ["--normalised"], "life-entropy": ["--grid", "0,3,4"],
         "lengths": ["--count", "2", "--infinite", "10"],
         "atol": ["--count", "2", "--contrast", "gauss", "--seed", "3"], "euler": ["--grid", "8"]}


class Fits(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("a.csv", TRAIN[0])
        self.write("b.csv", TRAIN[1])
        self.write("test.csv", TEST)

    def fit(self, kind, *more):
        self.expect(0, "a.csv", "b.csv", "--kind", kind, "-o", "train.csv", "--fit", "fit.json", *more)
        return json.loads(self.read("fit.json"))

    def test_each_kind_is_made_again(self):
        for kind, more in KINDS.items():
            fit = self.fit(kind, *more)
            self.assertEqual((fit["format"], fit["version"], fit["kind"]), ("ph-vectorise fit", 1, kind))
            numbers = self.read("train.csv").splitlines()[0].count(",")
            self.assertEqual(fit["length"], numbers)
            self.expect(0, "a.csv", "b.csv", "--fitted", "fit.json", "-o", "again.csv")
            self.assertEqual(self.read("again.csv"), self.read("train.csv"), kind)
            # Other inputs get the same columns, whatever bars they have.
            run = self.expect(0, "test.csv", "--fitted", "fit.json")
            self.assertEqual(run.stdout.splitlines()[0], self.read("train.csv").splitlines()[0])

    def test_what_is_fitted(self):
        fit = self.fit("landscape")
        self.assertEqual([b["grid"] for b in fit["blocks"]],
                         [{"lo": 0, "hi": 4, "points": 100}, {"lo": 1, "hi": 5, "points": 100}])
        self.assertEqual([b["shape"] for b in fit["blocks"]], [[5, 100], [5, 100]])
        self.assertEqual((fit["infinite"], fit["dropped"], fit["layers"]), ("drop", 1, 5))
        fit = self.fit("image", "--dims", "1")
        block = fit["blocks"][0]
        self.assertEqual(block["births"], {"lo": 1, "hi": 3, "pixels": 20})
        self.assertEqual(block["lengths"], {"lo": 0, "hi": 3, "pixels": 20})
        self.assertEqual((block["dim"], block["sigma"]), (1, 3 / 20))
        fit = self.fit("image", "--dims", "1", "--grid", "0,8,2", "--sigma", "0.5")
        self.assertEqual(fit["blocks"][0]["births"], {"lo": 0, "hi": 8, "pixels": 2})
        self.assertEqual(fit["blocks"][0]["lengths"], {"lo": 0, "hi": 3, "pixels": 2})
        self.assertEqual(fit["blocks"][0]["sigma"], 0.5)
        fit = self.fit("betti", "--infinite", "12")
        self.assertEqual((fit["infinite"], fit["dropped"]), (12, 0))
        self.assertEqual(fit["blocks"][0]["grid"]["hi"], 12)
        fit = self.fit("euler")
        self.assertEqual((fit["infinite"], fit["blocks"][0]["grid"]),
                         ("keep", {"lo": 0, "hi": 5, "points": 100}))

    def test_one_change_is_a_range(self):
        self.write("seven.npy", files.array((2, 2), [7, 7, 7, 7], "|u1"))
        self.write("nine.npy", files.array((2, 2), [9, 9, 9, 9], "|u1"))
        for names, lo, hi in ((["seven.npy"], 6.5, 7.5), (["seven.npy", "nine.npy"], 7, 9)):
            self.expect(0, *names, "--kind", "euler", "--grid", "3", "-o", "x.csv", "--fit", "fit.json",
                        "--force")
            fit = json.loads(self.read("fit.json"))
            self.assertEqual(fit["blocks"][0]["grid"], {"lo": lo, "hi": hi, "points": 3})
        self.assertEqual(self.read("x.csv").splitlines()[1:], ["seven.npy,1,1,1", "nine.npy,0,0,1"])

    def test_images_are_taken_alike(self):
        self.write("a.npy", files.array((2, 2), [0, 1, 2, 9], "|u1"))
        self.write("b.npy", files.array((2, 2), [3, 3, 3, 20], "|u1"))
        more = ["--kind", "euler", "--superlevel", "--construction", "cells", "--periodic", "1"]
        self.expect(0, "a.npy", "-o", "train.csv", "--fit", "fit.json", *more)
        fit = json.loads(self.read("fit.json"))
        self.assertEqual((fit["superlevel"], fit["construction"], fit["periodic"]),
                         (True, "cells", [False, True]))
        self.assertEqual(fit["blocks"][0]["grid"], {"lo": -9, "hi": -2, "points": 100})
        run = self.expect(0, "b.npy", "--fitted", "fit.json")
        same = self.expect(0, "b.npy", *more, "--grid", "-9,-2,100")
        self.assertEqual(run.stdout, same.stdout)

    def test_a_fit_that_is_none_is_refused(self):
        for kind in KINDS:
            fit = self.fit(kind, *KINDS[kind])
            good = json.dumps(fit)
            for spoil in (lambda f: f.pop("kind"), lambda f: f.pop("format"), lambda f: f.pop("blocks"),
                          lambda f: f.update(kind="tree"), lambda f: f.update(version=2),
                          lambda f: f.update(infinite="often"), lambda f: f.update(blocks=[])):
                bad = json.loads(good)
                spoil(bad)
                self.write("bad.json", json.dumps(bad))
                run = self.expect(65, "a.csv", "--fitted", "bad.json")
                self.assertIn("bad.json", run.stderr)
        for kind, spoil in (("betti", lambda b: b["grid"].update(lo=9)),
                            ("landscape", lambda b: b["grid"].update(points=0)),
                            ("landscape", lambda b: b["grid"].update(points=2**30)),
                            ("image", lambda b: b.update(sigma=0)),
                            ("image", lambda b: b["births"].update(hi=-9)),
                            ("atol", lambda b: b["widths"].pop()),
                            ("atol", lambda b: b["centres"][0].pop()),
                            ("atol", lambda b: b.update(contrast="flat")),
                            ("euler", lambda b: b["grid"].update(hi=-9))):
            fit = self.fit(kind, *(["--count", "2"] if kind == "atol" else []))
            spoil(fit["blocks"][0])
            self.write("bad.json", json.dumps(fit))
            self.assertIn("bad.json", self.expect(65, "a.csv", "--fitted", "bad.json").stderr)
        fit = self.fit("landscape", "--layers", "1000")
        for block in fit["blocks"]:
            block["grid"]["points"] = 10**6
            block["shape"] = [1000, 10**6]
        fit["length"] = sum(1000 * 10**6 for _ in fit["blocks"])
        self.write("large.json", json.dumps(fit))
        self.assertIn("memory", self.expect(75, "a.csv", "--fitted", "large.json", "--memory-limit", "100MB").stderr)
        fit = self.fit("silhouette")
        for changes in ({"power": -1}, {"infinite": "keep"}):
            self.write("bad.json", json.dumps({**fit, **changes}))
            self.expect(65, "a.csv", "--fitted", "bad.json")
        self.write("bad.json", "{")
        self.expect(65, "a.csv", "--fitted", "bad.json")
        self.write("more.json", json.dumps({**self.fit("betti"), "new": [1, {"a": 2}]}))
        # Unknown members are ignored, because a later version may have written them.
        self.expect(0, "a.csv", "--fitted", "more.json")

    def test_too_few_bars_for_centres(self):
        run = self.expect(65, "a.csv", "--kind", "atol", "--dims", "1")
        self.assertIn("H1: ", run.stderr)
        self.assertIn("H1: distinct bars: found 3, expected at least 10", run.stderr)
        self.assertIn("--count", run.stderr)


if __name__ == "__main__":
    main()
