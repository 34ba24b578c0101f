# SPDX-License-Identifier: MIT
"""Tests reports, plots and JSON of inputs whose names, titles and strings contain code: the page
has the same elements as any other page, and the pictures are valid XML."""
import json
import os
import sys
import xml.dom.minidom

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../support"))
from program import main  # noqa: E402
from report_reader import Elements  # noqa: E402
from report_test import ReportTest  # noqa: E402

STRINGS = {
    "the end of a script": b"</script ><script>alert(1)</script >",
    "a comment and a script in it": b"<!--<script>",
    "the end of a comment": b"x--><img src=x onerror=alert(1)>",
    "the end of CDATA": b"x]]><script>alert(1)",
    "the end of a picture": b"x</text></svg></noscript><script>alert(1)",
    "quotes": b"x\"'`>&lt;&amp;&#0;&nbsp;",
    "an attribute": b"x\" onload=\"alert(1)\" '",
    "line separators": "a\u2028b\u2029c".encode(),
    "right to left": "a\u202egnp\u2066.b\u200f".encode(),
    "byte order marks": "a\ufeffb\ufffe\uffff".encode(),
    "control characters": b"a\x01\x08\x1b[31m\x7f\n\r\tb",
    "C1 control characters": "a\u0085\u009b31mb".encode(),
    "no UTF-8": b"a\xff\xfe\xc0\xafb",
    "half a surrogate": b"a\xed\xa0\x80b",
    "what templates replace": b"${x} {{script}} $& $1 %s %n",
    "the largest code point": "\U0010ffff".encode(),
}
# For JSON input: a string with characters that a file name cannot hold.
ESCAPED = r'</script>\u2028\u0000\ud800\udc00\ud800x\u202e<!--<script>\u001b\"\\'


class HostileStrings(ReportTest):
    def look(self, arguments, same_as=None):
        """Runs the program with all outputs. @return the elements of the page."""
        self.expect(0, *arguments, "--report", "r.html", "--plot", "p.svg", "-o", "o.json", "--quiet")
        page = self.read_bytes("r.html")
        text = page.decode("utf-8")
        self.assertFalse([c for c in set(text) if ord(c) < 32 and c not in "\n\t"])
        elements = Elements(text)
        self.assertEqual(text.count("http-equiv=\"Content-Security-Policy\""), 1)
        for words in ("default-src 'none'", "base-uri 'none'", "form-action 'none'",
                      "require-trusted-types-for 'script'"):
            self.assertIn(words, text)
        self.assertNotIn("unsafe", text[:text.index("<style")])
        # The metadata are valid JSON without anything after them.
        json.loads(elements.scripts[0][1])
        xml.dom.minidom.parse(self.path("p.svg"))
        json.loads(self.read_bytes("o.json").decode("utf-8"))
        if same_as is not None:
            self.assertEqual(elements.tags, same_as.tags)
            # The script of the page is the same.
            self.assertEqual(elements.scripts[-1][1], same_as.scripts[-1][1])
        return elements

    def test_names_and_titles(self):
        self.write("plain.txt", "0 0\n1 0\n1 1\n0 1\n")
        plain = self.look(["plain.txt", "--title", "plain"])
        for what, string in STRINGS.items():
            with self.subTest(what):
                name = string.replace(b"/", b"\\")[:200] + b".txt"  # a file name contains no slash
                with open(os.path.join(os.fsencode(self.folder), name), "wb") as file:
                    file.write(b"0 0\n1 0\n1 1\n0 1\n")
                self.look([b"./" + name, b"--title=" + string], plain)

    def test_strings_of_a_stored_barcode(self):
        def stored(string):
            return self.write("b.json", '{"format": "ph-barcode", "version": 1, "program": "%s", "input": {"path": '
                              '"%s", "description": "%s"}, "complex": "%s", "engine": "%s", "vertex_weights": "%s", '
                              '"bars": [{"dim": 0, "birth": 0, "death": 1}]}' % ((string,) * 6))

        plain = self.look([stored("plain")])
        self.look([stored(ESCAPED)], plain)
        for what, string in STRINGS.items():
            with self.subTest(what):
                text = json.dumps(string.decode("utf-8", "replace"), ensure_ascii=False)[1:-1]
                self.look([stored(text)], plain)

    def test_headers_and_comments_of_a_table(self):
        for what, string in STRINGS.items():
            with self.subTest(what):
                line = string.replace(b"\n", b" ").replace(b"\r", b" ").decode("utf-8", "replace").encode()
                self.write("t.csv", b"# " + line + b"\n0,0\n1,0\n1,1\n")
                run = self.run_program("t.csv", "--report", "r.html", "-o", "o.csv", "--quiet")
                if run.returncode:  # the program says that the file is binary
                    self.assertEqual((run.returncode, run.stderr.count("\n")), (65, 1), run.stderr)
                    continue
                with open(self.path("r.html"), encoding="utf-8") as file:
                    self.assertNotIn("alert(1)", file.read())


if __name__ == "__main__":
    main()
