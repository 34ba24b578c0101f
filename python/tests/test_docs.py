# SPDX-License-Identifier: MIT
"""Examples in docstrings and on pages give what they say; each function has one."""
import doctest
import importlib
import inspect
import os
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import libph as ph

SOURCE = Path(os.environ.get("PH_SOURCE_DIR", Path(__file__).parents[2]))
FLAGS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS
# Those that need an optional package have their submodules here only where it is installed.
MODULES = ["libph", *sorted(module.name for module in pkgutil.walk_packages(
    ph.__path__, "libph.", onerror=lambda name: None) if module.name != "libph._core")]
PUBLIC = [getattr(ph, name) for name in ph.__all__ if callable(getattr(ph, name))]
FUNCTIONS = [f for f in PUBLIC if inspect.isfunction(f)]


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name.partition(".")[0] == "libph":
            raise
        pytest.skip(f"{error.name} is missing")
    names = {"ph": ph, "np": np, **vars(module)}
    assert doctest.testmod(module, globs=names, optionflags=FLAGS).failed == 0


@pytest.mark.parametrize("name, needed", [
    ("reference/python", []), ("how-to/gradients", []),
    ("how-to/coming-from", ["sklearn", "scipy"]), ("how-to/scikit-learn", ["sklearn", "pandas"])])
def test_pages(name, needed):
    for package in needed:
        pytest.importorskip(package, reason=f"{package} is missing, which docs/{name}.md needs")
    result = doctest.testfile(str(SOURCE / f"docs/{name}.md"), module_relative=False,
                              optionflags=FLAGS)
    assert result.attempted > 10 and result.failed == 0


@pytest.mark.parametrize("name, data", [
    ("cluster_moons", []), ("grow_loop", []),
    ("two_circles", [SOURCE / "examples/data/two_circles.csv"])])
def test_examples(name, data, tmp_path):
    for package in ("matplotlib", "sklearn"):
        pytest.importorskip(package, reason=f"{package} is missing, which the examples need")
    example = SOURCE / f"python/examples/{name}.py"
    subprocess.run([sys.executable, example, *data, tmp_path / "picture.png"], check=True)
    assert (tmp_path / "picture.png").read_bytes()[:4] == b"\x89PNG"


def test_readme(monkeypatch):
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is missing, which README needs")
    pyplot = pytest.importorskip("matplotlib.pyplot")
    monkeypatch.chdir(SOURCE)
    matplotlib.use("agg")
    result = doctest.testfile(str(SOURCE / "README.md"), module_relative=False, optionflags=FLAGS)
    pyplot.close("all")
    assert result.attempted == 7 and result.failed == 0


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda f: f.__name__)
def test_all_parameters_are_described(function):
    text = inspect.getdoc(function)
    described = set()
    for line in re.search(r"Parameters\n-+\n(.*?)(\n\w+\n---|\Z)", text, re.S)[1].split("\n"):
        if line and not line.startswith(" "):
            described |= set(re.findall(r"\*?\*?([a-zA-Z_]\w*)", re.sub(r" : .*", "", line)))
            described |= set(re.findall(r", (\w+) : ", line))
    assert set(inspect.signature(function).parameters) <= described
    for section in ("Returns", "Examples"):
        if function.__name__ not in ("limits", "read", "read_barcode"):
            assert f"{section}\n---" in text


@pytest.mark.parametrize("thing", PUBLIC, ids=lambda f: f.__name__)
def test_all_that_is_public_has_a_docstring(thing):
    assert inspect.getdoc(thing)
    if inspect.isclass(thing):
        for name, member in vars(thing).items():
            if not name.startswith("_") and (callable(member) or isinstance(member, property)):
                assert inspect.getdoc(member), f"{thing.__name__}.{name}"
