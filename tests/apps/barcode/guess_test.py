# SPDX-License-Identifier: MIT
"""Compares the H0 that ph-barcode computes from a file with the H0 of the numbers that were written
to the file. Also checks the notes that ph-barcode prints about the file. Shared by guesses.py and
guesses_tables.py."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import ProgramTest  # noqa: E402


def components(pairs):
    """The deaths in H0 for the distances {(i, j): d}, computed by Kruskal's algorithm. Vertices are
    numbered from 0. Two vertices at distance inf are never joined."""
    parent = {v: v for pair in pairs for v in pair}

    def root(v):
        while parent[v] != v:
            v = parent[v]
        return v

    deaths = []
    for (i, j), d in sorted(pairs.items(), key=lambda item: item[1]):
        if not math.isinf(d) and root(i) != root(j):
            parent[root(i)] = root(j)
            deaths.append(d)
    return deaths + [math.inf] * (len(parent) - len(deaths))


def distances_of(points):
    return {(i, j): math.dist(points[i], points[j]) for i in range(len(points)) for j in range(i)}


def csv(rows):
    return "".join(",".join(map(repr, row)) + "\n" for row in rows)


def flat(rows):
    return [x for row in rows for x in row]


class GuessTest(ProgramTest):
    def h0(self, *arguments, note="", silent=()):
        """The deaths in H0 according to the program. Its stderr must contain the note and none of
        the words in `silent`."""
        run = self.expect(0, *arguments, "--max-dim", "0")
        self.assertRegex(run.stderr, note or "^")
        for word in silent:
            self.assertNotIn(word, run.stderr)
        self.assertEqual(self.expect(0, *arguments, "--max-dim", "0", "--quiet").stderr, "")
        return [float(line.split(",")[2]) for line in run.stdout.splitlines()[1:]]

    def check(self, pairs, *arguments, **expected):
        found, wanted = self.h0(*arguments, **expected), components(pairs)
        self.assertEqual(len(found), len(wanted), arguments)
        for a, b in zip(found, wanted):
            self.assertTrue(a == b or math.isclose(a, b, rel_tol=1e-12), (arguments, a, b))

    def refused(self, code, words, *arguments):
        message = self.expect(code, *arguments, "--quiet").stderr
        for word in words:
            self.assertIn(word, message)
