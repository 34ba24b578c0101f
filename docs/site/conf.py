# SPDX-License-Identifier: MIT
"""Configures Sphinx, which makes a site from the pages of docs/. scripts/site.sh calls it."""
import importlib.util
import os
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
# The folder with build.py's results: the tree of sources, Doxygen's XML, the output of the
# programs.
MADE = Path(os.environ["PH_SITE_FOLDER"])
sys.path[:0] = [str(HERE), str(HERE / "ext")]

project = "libph"
version = release = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
author = "the authors of libph"
copyright = "the authors of libph, MIT licence"
language = "en"
root_doc = "index"
needs_sphinx = "5.3"

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon",
              "sphinx_copybutton", "docstrings", "furo_of_debian", "markers", "navigation", "shown_code",
              "source_pages"]
site_root = str(ROOT)
site_made = str(MADE)
site_has_python = os.environ.get("PH_SITE_PYTHON") == "1"

# Pages are Markdown. Anchors of headings are the ones that a forge makes.
source_suffix = {".md": "markdown"}
myst_heading_anchors = 4
highlight_language = "text"
# In Python docstrings, `name` is a reference if something has this name.
default_role = "py:obj"

smartquotes = False

# Python docstrings have numpydoc's sections.
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True
autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_preserve_defaults = True
# libph.torch can be described even if torch is not installed.
autodoc_mock_imports = [] if importlib.util.find_spec("torch") else ["torch"]
python_use_unqualified_type_names = True

# C++.
breathe_projects = {"libph": str(MADE / "doxygen" / "xml")}
breathe_default_project = "libph"
breathe_default_members = ("members", "undoc-members")
breathe_show_include = False
breathe_domain_by_extension = {"hpp": "cpp", "h": "c"}
cpp_maximum_signature_line_length = None
primary_domain = "py"

nitpicky = True
# Names that are not ours or have no page, such as names of the standard library, template
# parameters, and private parts of a header.
nitpick_ignore_regex = [("cpp:.*", ".*"), ("c:.*", ".*"), ("py:.*", ".*")]

html_theme = "furo"
html_title = f"libph {version}"
html_static_path = [str(HERE / "static")]
html_css_files = ["site.css"]
html_favicon = str(HERE / "static/icon.svg")
html_search_scorer = str(HERE / "scorer.js")
# A summary of search results needs the text of the found pages, which a page opened as a file may
# not fetch.
html_show_search_summary = False
html_copy_source = False
html_show_sphinx = False
html_use_index = False  # the search finds the same names
html_theme_options = {"navigation_with_keys": True}
# Both styles have a contrast of at least 4.5 on the theme's backgrounds.
pygments_style = "default"
pygments_dark_style = "github-dark"
copybutton_prompt_text = r">>> |\.\.\. |\$ "
copybutton_prompt_is_regexp = True
copybutton_line_continuation_character = "\\"
