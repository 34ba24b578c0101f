# SPDX-License-Identifier: MIT
"""Examples in docstrings and on pages give the stated results, and each function has an example."""
import ast
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
from libph import _core

SOURCE = Path(os.environ.get("PH_SOURCE_DIR", Path(__file__).parents[2]))
HAS_ALPHA = bool(_core.alpha_support())  # without CGAL, examples of alpha complexes are skipped
FLAGS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS
# Submodules that need an optional package are listed only if the package is installed.
MODULES = ["libph", *sorted(module.name for module in pkgutil.walk_packages(
    ph.__path__, "libph.", onerror=lambda name: None) if module.name != "libph._core")]
PUBLIC = [getattr(ph, name) for name in ph.__all__ if callable(getattr(ph, name))]
FUNCTIONS = [f for f in PUBLIC if inspect.isfunction(f)]


def is_scalar_of_numpy(value):
    """True for a scalar of NumPy, or a tuple, list or dictionary that has one."""
    if isinstance(value, dict):
        value = [*value, *value.values()]
    return isinstance(value, np.generic) or (
        isinstance(value, (list, tuple)) and any(map(is_scalar_of_numpy, value)))


@pytest.fixture(autouse=True)
def examples_print_no_scalar_of_numpy(monkeypatch):
    """NumPy 1 prints 2.0 where NumPy 2 prints np.float64(2.0). Examples must not depend on it."""
    def show(value):
        assert not is_scalar_of_numpy(value), f"{value!r} is a scalar of NumPy; int or float helps"
        shown(value)

    shown = sys.__displayhook__
    monkeypatch.setattr(sys, "__displayhook__", show)


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name.partition(".")[0] == "libph":
            raise
        pytest.skip(f"{error.name} is missing")
    runner = doctest.DocTestRunner(optionflags=FLAGS)
    for test in doctest.DocTestFinder().find(module, globs={"ph": ph, "np": np, **vars(module)}):
        if HAS_ALPHA or "alpha" not in test.docstring.lower():
            runner.run(test)
    assert runner.summarize(verbose=False).failed == 0


OPTIONAL = {"distributed", "matplotlib", "open3d", "pandas", "scipy", "skimage", "sklearn"}
# Packages that a page needs although it does not import them.
NEEDED = {"docs/how-to/coming-from.md": {"sklearn", "scipy"}, "docs/how-to/scikit-learn.md": {"pandas"}}
PAGES = [page.relative_to(SOURCE).as_posix() for page in sorted((SOURCE / "docs").rglob("*.md"))
         if ">>> " in page.read_text()]


# In Debian 12, Dask starts Tornado's event loop in a deprecated way.
@pytest.mark.filterwarnings("ignore:make_current is deprecated:DeprecationWarning")
@pytest.mark.parametrize("name", PAGES)
def test_pages(name, monkeypatch):
    """The examples of each page run in the root of the repository. If a package that the page
    imports is missing, the test is skipped."""
    page = SOURCE / name
    imported = set(re.findall(r">>> (?:import|from) (\w+)", page.read_text())) & OPTIONAL
    for package in sorted(imported | NEEDED.get(name, set())):
        pytest.importorskip(package, reason=f"{package} is missing, which {name} needs")
    if "pymol" in page.read_text() and not os.path.exists("/usr/share/pymol/data/demo/1tii.pdb"):
        pytest.skip(f"pymol-data is missing, which {name} needs")
    if not HAS_ALPHA and re.search(r">>> .*ph\.alpha", page.read_text()):
        pytest.skip(f"CGAL is not built in, which {name} needs")
    if "matplotlib" in sys.modules:
        sys.modules["matplotlib"].use("agg")
    monkeypatch.chdir(SOURCE)
    result = doctest.testfile(str(page), module_relative=False, optionflags=FLAGS)
    assert result.attempted > 0 and result.failed == 0


def test_that_the_reference_has_all_names():
    """The reference names all functions of libph, libph.sklearn and libph.torch. For libph.torch,
    names are read from the source, because torch may be missing."""
    pages = "".join(page.read_text() for page in (SOURCE / "docs/reference/python-api").glob("*.md"))
    names = {f"libph.{name}" for name in ph.__all__} - {"libph.__version__", "libph.gradients"}
    names |= {f"libph.gradients.{name}" for name in ph.gradients.__all__}
    for module in ("sklearn", "torch"):
        text = (SOURCE / f"python/libph/{module}/__init__.py").read_text()
        names |= {f"libph.{module}.{name}" for name in ast.literal_eval(re.search(r"__all__ = (\[.*?\])", text, re.S)[1])}
    assert not sorted(name for name in names if not re.search(rf"{re.escape(name)}(?![\w.])", pages))


def test_that_there_are_pages():
    assert len(PAGES) >= 4


@pytest.mark.parametrize("name, data", [
    ("cluster_moons", []), ("cluster_tree", []), ("clouds_to_features", []), ("grow_loop", []),
    ("growing_discs", []), ("sweeping_level", []), ("textures", []), ("molecule", []),
    ("delay_embedding", [SOURCE / "examples/data/pulse.csv"]),
    ("two_circles", [SOURCE / "examples/data/two_circles.csv"])])
def test_examples(name, data, tmp_path):
    example = SOURCE / f"python/examples/{name}.py"
    for package in ("matplotlib", "sklearn", "skimage", "pandas"):
        if package in example.read_text():
            pytest.importorskip(package, reason=f"{package} is missing, which {name}.py needs")
    if name == "molecule" and not (HAS_ALPHA and os.path.exists("/usr/share/pymol/data/demo")):
        pytest.skip("CGAL is not built in, or pymol-data is missing")
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
        if function.__name__ not in ("limits", "read", "read_barcode", "write_nifti"):
            assert f"{section}\n---" in text


@pytest.mark.parametrize("thing", PUBLIC, ids=lambda f: f.__name__)
def test_all_that_is_public_has_a_docstring(thing):
    assert inspect.getdoc(thing)
    if inspect.isclass(thing):
        for name, member in vars(thing).items():
            if not name.startswith("_") and (callable(member) or isinstance(member, property)):
                assert inspect.getdoc(member), f"{thing.__name__}.{name}"
