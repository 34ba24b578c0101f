# SPDX-License-Identifier: MIT
"""bench/render_tables.py: the pages have the figures of bench/results, and a planted difference is
found."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "bench/render_tables.py"
PAGE, RESULTS = "docs/notes/benchmarks.md", "bench/results"
CONSTANTS = "docs/reference/segmentation-constants.md"


def render(root, *options):
    return subprocess.run([sys.executable, "-B", SCRIPT, root, *options], capture_output=True, text=True)


class RenderedTables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        shutil.copytree(ROOT / "bench", self.root / "bench", ignore=shutil.ignore_patterns("__pycache__"))
        for page in (PAGE, CONSTANTS):
            (self.root / page).parent.mkdir(parents=True)
            shutil.copy(ROOT / page, self.root / page)

    def replace(self, name, old, new):
        text = (self.root / name).read_text(encoding="utf-8")
        self.assertIn(old, text)
        (self.root / name).write_text(text.replace(old, new, 1), encoding="utf-8")

    def expect_refusal(self, words):
        for options in ([], ["--check"]):
            run = render(self.root, *options)
            self.assertEqual(run.returncode, 1)
            self.assertIn(words, run.stderr)

    def test_the_page_is_up_to_date(self):
        run = render(ROOT, "--check")
        self.assertEqual(run.returncode, 0, f"{run.stdout}{run.stderr}bench/render_tables.py mends it")

    def test_a_figure_that_differs_is_seen_and_rendered(self):
        before = (self.root / PAGE).read_text(encoding="utf-8")
        for name, old, new in ((f"{RESULTS}/rips.csv", "yes,h1:torus_2000,0.043,", "yes,h1:torus_2000,0.044,"),
                               (f"{RESULTS}/images.csv", '\nyes,"MRI head, V"', '\n,"MRI head, V"'),
                               (f"{RESULTS}/python.csv", "2026-11-25", "2026-11-24"),
                               (PAGE, "| 0.138 / 69 |", "| 0.139 / 69 |")):
            with self.subTest(name):
                self.setUp()
                self.replace(name, old, new)
                run = render(self.root, "--check")
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertIn("\n-", run.stdout)
                self.assertEqual(render(self.root).returncode, 0)
                self.assertEqual(render(self.root, "--check").returncode, 0)
                self.assertEqual((self.root / PAGE).read_text(encoding="utf-8") == before, name == PAGE)

    def test_rows_that_were_not_measured_have_no_origin(self):
        name = f"{RESULTS}/segmentation-constants.csv"
        header = (self.root / name).read_text(encoding="utf-8").split("\n")[0]
        cells = ["yes", *"fnvuwc", "", "", "", "", "", "", ""]
        measured = [*cells[:-4], "bench/scenes/score.py", "", "2026-01-31", ""]
        for rows, caption in (([cells, cells], ""),
                              ([cells, measured, cells], "`bench/scenes/score.py`; 2026-01-31.\n\n"),
                              ([measured, cells, measured], "`bench/scenes/score.py`; 2026-01-31.\n\n")):
            with self.subTest(caption):
                lines = [header, *(",".join(row) for row in rows), ""]
                (self.root / name).write_text("\n".join(lines), encoding="utf-8")
                self.assertEqual(render(self.root).returncode, 0)
                page = (self.root / CONSTANTS).read_text(encoding="utf-8")
                self.assertIn(f"<!-- table: segmentation-constants.csv -->\n{caption}| file | name |", page)
                self.assertIn("| f | `n` | `v` | u |", page)

    def test_a_table_without_a_file_is_refused(self):
        self.replace(PAGE, "<!-- table: rips.csv -->", "<!-- table: lost.csv -->")
        self.expect_refusal("lost.csv")

    def test_a_file_without_a_table_is_refused(self):
        shutil.copy(self.root / RESULTS / "rips.csv", self.root / RESULTS / "more.csv")
        self.expect_refusal("more.csv")

    def test_a_script_that_is_not_there_is_refused(self):
        self.replace(f"{RESULTS}/alpha.csv", "bench/alpha/compare_alpha.py", "bench/lost.py")
        self.expect_refusal("bench/lost.py: found no such script")

    def test_a_row_without_all_cells_is_refused(self):
        self.replace(f"{RESULTS}/vectors.csv", ",568,", ",")
        self.expect_refusal("vectors.csv:3: expected 9 cells")

    def test_a_file_without_its_origin_is_refused(self):
        self.replace(f"{RESULTS}/memory.csv", ",versions\n", ",version\n")
        self.expect_refusal("expected the columns")


if __name__ == "__main__":
    unittest.main()
