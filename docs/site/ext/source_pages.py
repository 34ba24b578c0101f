# SPDX-License-Identifier: MIT
"""Handles links from pages to files outside docs/.

On a forge, such a link leads to the file. On the site, it leads to a page that shows the file, or
to a list of the files in a folder, because the site does not know the address of the repository.
"""
import html
import posixpath
import re
import subprocess
from pathlib import Path

from docutils import nodes
from pygments.util import ClassNotFound
from sphinx import addnodes
from sphinx.highlighting import PygmentsBridge
from sphinx.transforms import SphinxTransform
from sphinx.util import logging

import pygments.lexers

LOG = logging.getLogger(__name__)
FOLDER = "source"
PATH = re.compile(r"(docs/[\w./-]+\.md)")


class LinksOutside(SphinxTransform):
    default_priority = 400

    def apply(self):
        root = Path(self.config.site_root)
        page = Path(self.env.doc2path(self.env.docname)).resolve()
        for link in list(self.document.findall(lambda node: isinstance(
                node, (addnodes.pending_xref, addnodes.download_reference))
                and node.get("reftype") == "myst")):
            path, _, anchor = link["reftarget"].partition("#")
            if not path:
                continue
            target = (page.parent / path).resolve()
            if not target.is_relative_to(root) or not target.exists():
                LOG.warning("%s: found no such file", link["reftarget"], location=link)
                continue
            docname = self.config.site_docs.get(str(target))
            if docname:
                self.lead_to_page(link, docname, anchor)
            else:
                self.lead_to_source(link, target.relative_to(root).as_posix())

    def lead_to_page(self, link, docname, anchor):
        here = posixpath.dirname(self.env.docname)
        target = posixpath.relpath(docname + ".md", here or ".")
        link["reftarget"] = f"{target}#{anchor}" if anchor else target

    def lead_to_source(self, link, path):
        self.env.site_sources.setdefault(self.env.docname, set()).add(path)
        up = "../" * self.env.docname.count("/")
        name = posixpath.join(FOLDER, path, "index" if is_folder(self.config, path) else "")
        link.replace_self(nodes.reference(
            "", "", *link.children, refuri=f"{up}{name.rstrip('/')}.html", internal=True))


class PathsInComments(SphinxTransform):
    """Turns the path of a page in a source comment, such as docs/explanation/approximation.md, into
    a link."""
    default_priority = 399

    def apply(self):
        if not self.env.docname.startswith("reference/"):
            return
        for text in list(self.document.findall(nodes.Text)):
            parts = PATH.split(str(text))
            if len(parts) > 1 and not is_within(text, (nodes.literal, nodes.literal_block, nodes.reference,
                                                       addnodes.pending_xref, addnodes.download_reference)):
                text.parent.replace(text, [self.link(part) if PATH.fullmatch(part) else nodes.Text(part)
                                           for part in parts])

    def link(self, path):
        docname = self.config.site_docs.get(str(Path(self.config.site_root, path).resolve()))
        if docname is None:
            LOG.warning("a comment of the source names %s: found no such page", path, location=self.env.docname)
            return nodes.Text(path)
        uri = posixpath.relpath(docname, posixpath.dirname(self.env.docname)) + ".html"
        return nodes.reference("", path, refuri=uri, internal=True)


def is_within(node, kinds):
    while node is not None and not isinstance(node, kinds):
        node = node.parent
    return node is not None


def is_folder(config, path):
    return Path(config.site_root, path).is_dir()


def find_pages(app, config):
    """Maps each page to its file in the repository; the tree of sources consists of links to these
    files."""
    tree = Path(app.srcdir)
    config.site_docs = {str(file.resolve()): file.relative_to(tree).as_posix()[:-len(".md")]
                        for file in tree.rglob("*.md")}


def begin(app):
    if not hasattr(app.env, "site_sources"):
        app.env.site_sources = {}


def forget(app, env, docname):
    getattr(env, "site_sources", {}).pop(docname, None)


def merge(app, env, docnames, other):
    env.site_sources.update({name: other.site_sources[name] for name in docnames
                             if name in other.site_sources})


def shown(app):
    """The paths that have a page: the targets of links, and the files of linked folders."""
    root = app.config.site_root
    tracked = subprocess.run(["git", "-C", root, "ls-files", "-z"], capture_output=True, text=True,
                             check=False).stdout.split("\0")
    linked = set().union(*app.env.site_sources.values())
    folders = {path for path in linked if is_folder(app.config, path)}
    files = (linked - folders) | {path for path in tracked if posixpath.dirname(path) in folders}
    inside = {folder: sorted({path[len(folder) + 1:].split("/")[0] + ("/" if "/" in path[len(folder) + 1:] else "")
                              for path in tracked if path.startswith(folder + "/")})
              for folder in folders}
    return files, inside


def page_of_file(app, path):
    try:
        text = Path(app.config.site_root, path).read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return f"<p>{html.escape(path)} is no text.</p>"
    try:
        lexer = pygments.lexers.get_lexer_for_filename(path).aliases[0]
    except ClassNotFound:
        lexer = "text"
    shown = PygmentsBridge("html", app.config.pygments_style).highlight_block(
        text, lexer, force=True, linenos="inline")
    # Line numbers become attributes: whoever copies the text does not copy them.
    return re.sub(r'<span class="linenos">([^<]*)</span>', r'<span class="linenos" data-line="\1"></span>', shown)


def page_of_folder(path, names, files, inside):
    def item(name):
        below = posixpath.join(path, name).rstrip("/")
        href = (f"{name}.html" if below in files else f"{name}index.html" if below in inside else "")
        text = html.escape(name)
        return f'<li><a href="{href}"><code>{text}</code></a></li>' if href else f"<li><code>{text}</code></li>"
    return "<ul>" + "".join(map(item, names)) + "</ul>"


def page(app, menus, name, title, body):
    """A page in the form that Sphinx expects. Pages of the same depth share one menu, because
    making it takes long."""
    def menu(**how):
        key = (name.count("/"), *sorted(how.items()))
        if key not in menus:
            menus[key] = app.builder._get_local_toctree(name, **how)
        return menus[key]
    return name, {"title": title, "toctree": menu, "body": f"<h1><code>{html.escape(title)}</code></h1>{body}"}, \
        "page.html"


def pages(app):
    if app.builder.format != "html":
        return
    files, inside = shown(app)
    menus = {}
    for path in sorted(files):
        yield page(app, menus, posixpath.join(FOLDER, path), path, page_of_file(app, path))
    for path, names in sorted(inside.items()):
        yield page(app, menus, posixpath.join(FOLDER, path, "index"), f"{path}/",
                   page_of_folder(path, names, files, inside))


def setup(app):
    app.add_config_value("site_root", "", "env")
    app.add_config_value("site_docs", {}, "")
    app.add_transform(LinksOutside)
    app.add_transform(PathsInComments)
    app.connect("config-inited", find_pages)
    app.connect("builder-inited", begin)
    app.connect("env-purge-doc", forget)
    app.connect("env-merge-info", merge)
    app.connect("html-collect-pages", pages)
    return {"parallel_read_safe": True}
