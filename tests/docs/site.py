#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the built site, page by page, as a browser reads it: site.py FOLDER.

* A link within the site leads to an existing file, and to an existing element if it names one.
  Other links are not checked.
* Nothing is loaded from other servers.
* Each picture has an alternative text, and each page has a title and a heading.
* Each page can be reached from index.html.
* The text has no leftover entities or fields, and no sentences that were cut off.

Exit code 77: there is no such folder.
"""
import functools
import html.parser
import os
import re
import sys
from pathlib import Path
from urllib.parse import unquote, urlsplit

# Pages that other tools make and other tests check.
REPORTS = "reports/"
LOADED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}
LEFTOVERS = {"an entity as text": r"&amp;#\w+;", "half a sentence": r"<p>\.\s[^<]{0,20}",
             "a field of a named tuple without words": r"Alias for field number \d+",
             "a link in a link": r"<a [^>]*></a>"}
# The browser loads the targets of these links only if the reader follows a link.
NOT_LOADED = {"canonical", "index", "search", "next", "prev"}


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.ids, self.links, self.loaded, self.faults = set(), [], [], []
        self.text = {"title": "", "h1": ""}
        self.inside = None
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        for name in ("id", "name"):
            if attributes.get(name):
                self.ids.add(attributes[name])
        if tag == "a" and attributes.get("href"):
            self.links.append(attributes["href"])
        for name in ("src", "href"):
            if (tag, name) in LOADED and attributes.get(name) and attributes.get("rel") not in NOT_LOADED:
                self.loaded.append(attributes[name])
        if tag == "img" and not (attributes.get("alt") or "").strip():
            self.faults.append(f"{attributes.get('src')}: found a picture without alternative text")
        if tag in self.text and not self.text[tag]:
            self.inside = tag

    def handle_endtag(self, tag):
        if tag == self.inside:
            self.inside = None

    def handle_data(self, data):
        if self.inside:
            self.text[self.inside] += data


@functools.cache
def target_of(folder, link):
    """The pair (file, element) that a link on a page in the folder leads to; the file is "" for the
    page itself. None if the link leads out of the site."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    path = os.path.normpath(os.path.join(folder, unquote(parts.path))) if parts.path else ""
    return path, unquote(parts.fragment)


@functools.cache
def is_file(path):
    return os.path.isfile(path)


def dead(file, link, pages, root):
    """What is wrong with a link within the site, or None."""
    target = target_of(os.path.dirname(file), link)
    if target is None:
        return None
    path, fragment = target[0] or file, target[1]
    if not path.startswith(root + os.sep) or not is_file(path):
        return "found no such file"
    if fragment and path in pages and fragment not in pages[path].ids:
        return "found no such element"
    return None


def leftovers(text):
    """Markup that Doxygen, Breathe or napoleon misread and left in the text. @param text the
    content of a file."""
    for what, pattern in LEFTOVERS.items():
        for found in re.findall(pattern, text):
            yield f"{found}: found {what}"


def faults_of(file, page, pages, root):
    yield from page.faults
    if f"{os.sep}reference{os.sep}" in file:
        yield from leftovers(Path(file).read_text(encoding="utf-8"))
    for name, text in page.text.items():
        if not text.strip() and os.path.basename(file) != "search.html":
            yield f"found no {name}"
    for link in page.loaded:
        if urlsplit(link).scheme not in ("", "data") or urlsplit(link).netloc:
            yield f"{link}: found an address outside the site"
    for link in dict.fromkeys(page.links + page.loaded):
        fault = dead(file, link, pages, root)
        if fault:
            yield f"{link}: {fault}"


def reached(pages, root):
    found, ahead = set(), [os.path.join(root, "index.html")]
    while ahead:
        file = ahead.pop()
        if file in found or file not in pages:
            continue
        found.add(file)
        targets = (target_of(os.path.dirname(file), link) for link in pages[file].links)
        ahead += [target[0] for target in targets if target]
    return found


def main():
    root = Path(sys.argv[1]).resolve()
    if not root.is_dir():
        print(f"skipped: {root} is not there, for the site was not built")
        return 77
    files = [file for file in sorted(root.rglob("*.html")) if not file.relative_to(root).as_posix().startswith(REPORTS)]
    pages = {str(file): Page(file) for file in files}
    found = reached(pages, str(root))
    faults = [f"{file}: {fault}" for file, page in pages.items() for fault in faults_of(file, page, pages, str(root))]
    # search.html is left out, because each page leads to it through its search field.
    faults += [f"{file}: index.html does not lead to it" for file in pages
               if file not in found and os.path.basename(file) != "search.html"]
    print("\n".join([*(fault.removeprefix(f"{root}{os.sep}") for fault in faults),
                     f"{len(pages)} pages, {len(faults)} faults"]))
    return 1 if faults or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
