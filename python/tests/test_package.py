# SPDX-License-Identifier: MIT
"""Tests the package as a whole: its exports and its wheels."""
import ast
import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import numpy as np
import pytest

import libph as ph

SOURCE = Path(os.environ.get("PH_SOURCE_DIR", Path(__file__).parents[2]))


def test_version():
    stated = re.search(r"VERSION (\d+\.\d+\.\d+)", (SOURCE / "CMakeLists.txt").read_text())[1]
    assert ph.__version__ == stated


def test_names():
    assert sorted(ph.__all__) == ph.__all__
    # Modules that need other packages become attributes once they are imported.
    optional = {"compat", "sklearn", "torch"}
    assert {name for name in vars(ph) if not name.startswith("_")} <= set(ph.__all__) | optional
    assert (Path(ph.__file__).parent / "py.typed").exists()


def test_types_and_places_of_names():
    """Type checkers and Python find the same names in the same modules, and `dir` lists them before
    their modules are imported."""
    stub = ast.parse((SOURCE / "python/libph/__init__.pyi").read_text())
    found = {alias.asname or alias.name: f"libph.{node.module}" if node.module else "libph"
             for node in stub.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    (stated,) = [node for node in stub.body if isinstance(node, ast.Assign)]
    assert ast.literal_eval(stated.value) == ph.__all__ == sorted(found)
    places = {name: f"libph.{place}" for name, place in ph._MODULES.items()}
    assert found == {**places, "__version__": "libph._core", "gradients": "libph"}
    code = "import libph; print(*(name for name in dir(libph) if not name.startswith('_')))"
    listed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout
    assert set(listed.split()) == {*ph.__all__, "compat", "sklearn", "torch"} - {"__version__"}


def test_results_print_one_line():
    """Arrays of results are given by their shape, however large they are."""
    X = np.random.default_rng(0).random((60, 3))
    bars = ph.rips(X, representatives="cycles")
    results = [
        ph.estimate(X), ph.estimate(X, max_dim=4), ph.estimate(X[:9, :, None]),
        ph.farthest_points(X), ph.point_image(X, 0.05), ph.bottleneck_matching(bars, bars, 0),
        ph.barycentre([bars, bars], 0), ph.confidence_band(X.T),
        ph.Surface(X, np.zeros((9, 3), dtype=int), np.zeros(9, dtype=bool)),
        ph.Mesh(X, np.zeros((9, 3), dtype=int), None), ph.Simplices([(0,)] * 99, np.zeros(99)),
        ph.Boundary(None, np.zeros(99, dtype=int), None),
        bars.representative(bars.longest(1)).loops()[0]]
    for result in results:
        printed = str(result)
        assert printed.startswith(type(result).__name__ + "(") and printed == repr(result)
        assert "\n" not in printed and len(printed) < 200
    assert str(results[3]) == (
        "Subsample(indices=<60 int64>, radii=<60 float64>, covering_radius=0.0)")
    assert re.fullmatch(r"Estimate\([\d.]+ KiB to [\d.]+ MiB; engine edge-links, up to H1; "
                        r"cells: 60 of dimension 0, [\d ]+ of dimension 1\)", str(results[0]))
    assert "; edges are collapsed)" in str(results[1]) and "cells:" not in str(results[2])


def test_sources_that_are_not_compiled(tmp_path):
    shutil.copytree(SOURCE / "python/libph", tmp_path / "libph",
                    ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    done = subprocess.run([sys.executable, "-c", "import libph"], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(tmp_path)}, cwd=tmp_path)
    assert re.search(r"ImportError: libph: .* has no compiled module _core for Python 3.*pip install", done.stderr)


# ---- wheels


@pytest.fixture(scope="module")
def backend():
    sys.path.insert(0, str(SOURCE / "python/packaging"))
    try:
        import backend
        yield backend
    finally:
        sys.path.remove(str(SOURCE / "python/packaging"))


def test_metadata_is_said_twice_alike(backend):
    tomllib = pytest.importorskip("tomllib")
    project = tomllib.loads((SOURCE / "pyproject.toml").read_text())["project"]
    text = backend.metadata()
    for line in (f"Name: {project['name']}", f"Summary: {project['description']}",
                 f"License: {project['license']['text']}",
                 f"Requires-Python: {project['requires-python']}",
                 *(f"Requires-Dist: {need}" for need in project["dependencies"]),
                 *(f'Requires-Dist: {need}; extra == "all"'
                   for need in project["optional-dependencies"]["all"])):
        assert line + "\n" in text, line
    assert text.count("Requires-Dist") == 1 + len(project["optional-dependencies"]["all"])
    assert (SOURCE / project["readme"]).read_text() in text


def test_an_archive_of_the_sources(backend, tmp_path):
    name = backend.build_sdist(tmp_path)
    with tarfile.open(tmp_path / name) as archive:
        names = {member.split("/", 1)[1] for member in archive.getnames() if "/" in member}
    for needed in ("PKG-INFO", "pyproject.toml", "CMakeLists.txt", "python/src/module.cpp",
                   "libph/src/core/barcode.cpp", "libsegment/src/pipeline.cpp",
                   "libreport/report/barcode_page.cpp", "viewer/build.mjs", "viewer/package-lock.json",
                   "python/libph/_scenes/__init__.py", "python/libph/__init__.py", "LICENSE"):
        assert needed in names
    assert not any("__pycache__" in n or "node_modules" in n for n in names)


def test_settings(backend, monkeypatch, tmp_path):
    ran = []
    monkeypatch.setattr(backend, "ROOT", tmp_path)
    monkeypatch.setattr(backend, "run", lambda *command: ran.append([str(word) for word in command]))
    for given in ("-DA=1 '-DB=2 3'", ["-DA=1", "'-DB=2 3'"]):  # newer versions of pip pass a list
        backend.build({"cmake-args": given})
        assert ran[-2][-2:] == ["-DA=1", "-DB=2 3"] and "--fresh" in ran[-2]
    with pytest.raises(SystemExit, match="found setting cmake-arg, expected build-dir or cmake-args"):
        backend.build({"cmake-arg": "-DA=1"})


def test_sources_where_nothing_can_be_written(backend, monkeypatch, tmp_path):
    (tmp_path / "build").write_text("")
    monkeypatch.setattr(backend, "ROOT", tmp_path)
    with pytest.raises(SystemExit, match="found no folder to build in: Not a directory"):
        backend.build({})


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """A virtual environment into which pip has installed the package without a network."""
    build = os.environ.get("PH_BUILD_DIR")
    if not build:
        pytest.skip("PH_BUILD_DIR names no build folder")
    folder = tmp_path_factory.mktemp("venv")
    made = subprocess.run([sys.executable, "-m", "venv", folder], capture_output=True, text=True)
    if made.returncode != 0:
        pytest.skip(f"no virtual environment: {made.stdout}")
    python = folder / "bin/python"
    # The new environment sees the packages of these tests, which may be in an environment as well.
    (packages,) = folder.glob("lib/python*/site-packages")
    (packages / "tests.pth").write_text(str(Path(np.__file__).parents[1]))
    settings = {**os.environ, "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    settings.pop("PYTHONPATH", None)
    done = subprocess.run([python, "-m", "pip", "install", "--config-settings",
                           f"build-dir={build}", SOURCE], capture_output=True, text=True,
                          env=settings, cwd=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return python, settings


def run_in(environment, *arguments):
    python, settings = environment
    done = subprocess.run([python, *arguments], capture_output=True, text=True, env=settings,
                          cwd=python.parent)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_pip_install_without_a_network(environment):
    code = "import libph, numpy; print(libph.__file__, len(libph.rips([[0], [1]])), numpy.__file__)"
    path, bars, numpy = run_in(environment, "-c", code).split()
    assert numpy == np.__file__
    assert bars == "2" and Path(path).is_relative_to(environment[0].parents[1])
    shown = run_in(environment, "-m", "pip", "show", "-f", "libph")
    assert f"Version: {ph.__version__}" in shown and "libph/py.typed" in shown
    assert "_core.pyi" in shown and "tests" not in shown


def test_a_wheel_is_whole_and_always_the_same(backend, tmp_path):
    build = os.environ.get("PH_BUILD_DIR")
    if not build:
        pytest.skip("PH_BUILD_DIR names no build folder")
    wheels = []
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        wheels.append(tmp_path / name / backend.build_wheel(tmp_path / name, {"build-dir": build}))
    assert wheels[0].read_bytes() == wheels[1].read_bytes()
    with zipfile.ZipFile(wheels[0]) as wheel:
        names = wheel.namelist()
        (record,) = [n for n in names if n.endswith(".dist-info/RECORD")]
        rows = [row.split(",")[0] for row in wheel.read(record).decode().splitlines()]
    assert rows == names and f"libph/__init__.py" in names
    assert sum(n.endswith(".so") for n in names) == 1
    editable = tmp_path / backend.build_editable(tmp_path, {"build-dir": build})
    with zipfile.ZipFile(editable) as wheel:
        (path,) = [n for n in wheel.namelist() if n.endswith(".pth")]
        assert Path(wheel.read(path).decode().strip(), "libph/__init__.py").exists()
