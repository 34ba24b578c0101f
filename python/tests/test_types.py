# SPDX-License-Identifier: MIT
"""Types of the package itself, of the stub of _core, and of code that uses the package."""
import ast
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import libph as ph
from libph import _core

SOURCE = Path(os.environ.get("PH_SOURCE_DIR", Path(__file__).parents[2]))
CONFIG = SOURCE / "pyproject.toml"

# An example of a user's code. The comment on a line states the code of the error that mypy reports
# for this line, and a part of the message.
USE = '''
from __future__ import annotations

from typing import Dict, List, Optional, Tuple

import numpy as np
from numpy.typing import NDArray
from typing_extensions import assert_type

import libph as ph

X = np.zeros((5, 2))
bars = ph.rips(X, max_dim=2, threads=2, memory_limit="1GiB")
assert_type(bars, ph.Barcode)
assert_type(bars[0].birth, float)
assert_type(bars[1:], ph.Barcode)
assert_type(bars.births, NDArray[np.float64])
assert_type(bars.dgm(1), NDArray[np.float64])
assert_type(bars.dgms(), List[NDArray[np.float64]])
assert_type(bars.dims, NDArray[np.int64])
assert_type(bars.longest(1), int)
assert_type(bars.longest(1, None), int)
assert_type(bars.longest(1, 3), NDArray[np.int64])
assert_type(bars.representative(0).loop(), NDArray[np.int64])
assert_type(bars.filter(dim=[0, 1]).voxels(0), ph.SpatialImage)
assert_type(bars.death_voxel(0), Optional[Tuple[int, ...]])
assert_type(bars.report(X), ph.Report)
assert_type(ph.cubical(X, periodic=[0]), ph.Barcode)
assert_type(ph.batch(ph.rips, [X, X], max_dim=0, threads=2), List[ph.Barcode])
assert_type(ph.delay_embedding(X, 2, window=3), NDArray[np.float64])
assert_type(ph.join_parts([ph.image_part(X, 0, 1)]), ph.ImagePart)
assert_type(ph.join_parts([ph.cloud_part(X, 0, 1)]).missing, Tuple[int, ...])
assert_type(ph.ImageLoops(ph.image_part(X, 0, 1)).take_messages(), List[Tuple[int, bytes]])
assert_type(ph.lower_star([0, 1], [(0, 1)]), ph.Barcode)
assert_type(ph.read_barcode("bars.json"), ph.Barcode)
assert_type(ph.bottleneck(bars, bars), Dict[int, float])
assert_type(ph.bottleneck(bars, bars, 1), float)
assert_type(ph.bottleneck([[0, 1]], X), float)
assert_type(ph.wasserstein(bars, bars, order=2), Dict[int, float])
assert_type(ph.wasserstein(X, X, ground=2, threads=1), float)
assert_type(ph.wasserstein_matching(bars, bars, 1).pairs, NDArray[np.int64])
assert_type(ph.diagram_distances([X, X]), NDArray[np.float64])
assert_type(ph.barycentre([X, X]).converged, bool)
assert_type(ph.p_values(bars, 1), NDArray[np.float64])
assert_type(ph.confidence_band(X).mean, NDArray[np.float64])
assert_type(ph.permutation_test(X, ["a", "b"]).p, float)
assert_type(ph.diagram_kernels([X, X], sigma=2), NDArray[np.float64])
assert_type(ph.euler_curve(X, threads=2), ph.StepFunction)
assert_type(ph.euler_curve(X, range=(0, 1), superlevel=True), NDArray[np.float64])
assert_type(bars.euler_curve()(X), NDArray[np.int64])
assert_type(bars.betti_function(1)(0.5), int)
assert_type(bars.exact_landscape(1), List[ph.PiecewiseLinear])
assert_type(bars.exact_landscape(1)[0](0.5), float)
assert_type(bars.statistics(1), Dict[str, float])
assert_type(bars.silhouette(1, power=2), NDArray[np.float64])
assert_type(ph.distance_to_measure(X, 3), NDArray[np.float64])
assert_type(ph.merge_tree(X).values, NDArray[np.float64])
scene = ph.segment(X, intrinsics=(1, 1, 0, 0), timeout=10)
assert_type(scene, ph.Segmentation)
assert_type(scene.cut(n=3).labels, NDArray[np.uint32])
assert_type(scene.objects[0].centroid, NDArray[np.float64])
assert_type(scene.barcode, ph.Barcode)
assert_type([bar.persistence for bar in bars], List[float])
with ph.limits(memory="1GiB", threads=2):
    pass

assert_type(bars.dgm(1), NDArray[np.int64])          # assert-type: ndarray
ph.rips(X, max_dims=2)                               # call-arg: "max_dims"
ph.rips(X, thread=2)                                 # call-arg: "thread"
ph.rips(X, max_dim="2")                              # arg-type: "max_dim" to "rips"
ph.rips(X, progress=3)                               # arg-type: "progress" to "rips"
ph.cubical(X, superlevel="no")                       # arg-type: "superlevel" to "cubical"
ph.limits(memory="1GiB", timout=3)                   # call-arg: "timout"
bars.dgm("1")                                        # arg-type: "dgm" of "Barcode"
bars.dgm(1).append(3)                                # attr-defined: "append"
bars.diagram(1)                                      # attr-defined: "diagram"
bars[0] = ph.Bar(0, 0.0, 1.0)                        # index: indexed assignment
bars.deaths = X                                      # misc: "deaths"
bars.meta["field"] = 3                               # index: indexed assignment
bars[0].death.append(1)                              # attr-defined: "float"
ph.bottleneck(bars, bars, dim="1")                   # call-overload: "bottleneck"
ph.wasserstein_matching(X, X, at_most=1)             # call-arg: "at_most"
ph.euler_curve(X, field=3)                           # call-overload: "euler_curve"
ph.diagram_kernels(X, sigma="1")                     # arg-type: "sigma" to "diagram_kernels"
bars.silhouette(1, 2.0)                              # misc: "silhouette" of "Summaries"
bars.statistics(1)["mean"].sum()                     # attr-defined: "float"
bars.euler_curve().at = X                            # misc: "at"
scene.cut(n="3")                                     # arg-type: "n" to "cut"
scene.labels.sort(axes=0)                            # call-arg: "axes"
'''


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """A function that runs mypy, or one of its tools, in an empty folder and returns its messages.
    The cache is kept between runs."""
    pytest.importorskip("mypy", reason="mypy is missing, which looks at types")
    cache = tmp_path_factory.mktemp("cache")
    settings = {**os.environ, "PYTHONPATH": str(Path(ph.__file__).parents[1])}

    def run(*arguments, folder=cache, part=""):
        flags = [] if part else ["--config-file", CONFIG, "--cache-dir", cache, "--no-color-output",
                                 "--no-error-summary"]
        done = subprocess.run([sys.executable, "-m", f"mypy{part}", *flags, *arguments], cwd=folder,
                              capture_output=True, text=True, env=settings)
        assert done.returncode in (0, 1), done.stdout + done.stderr
        assert done.stderr == ""
        return done.returncode, done.stdout

    return run


def test_package(mypy):
    status, remarks = mypy("--strict", "-p", "libph")
    assert (status, remarks) == (0, "")


def test_use(mypy, tmp_path):
    (tmp_path / "use.py").write_text(USE)
    _, remarks = mypy("use.py", folder=tmp_path)
    found = {}
    for line, words in re.findall(r"^use\.py:(\d+): error: (.*)$", remarks, re.MULTILINE):
        assert int(line) not in found, words
        found[int(line)] = words
    expected = {number: re.fullmatch(r".*  # ([a-z-]+): (.*)", line).groups()
                for number, line in enumerate(USE.split("\n"), 1) if "  # " in line}
    assert found.keys() == expected.keys(), remarks
    for line, (code, words) in expected.items():
        assert words in found[line] and found[line].endswith(f"[{code}]"), found[line]


# ---- the stub of _core


def test_stub_names_all_that_there_is(mypy):
    status, remarks = mypy("libph._core", "--mypy-config-file", CONFIG, part=".stubtest")
    assert (status, remarks) == (0, "Success: no issues found in 1 module\n")


def arguments_of(function):
    """For each parameter except self: its name, and whether its value may be None. The name is None
    if the signature states no name."""
    arguments = function.args.args + function.args.kwonlyargs
    return [(None if a.arg.startswith("__") else a.arg,
             re.search(r"\bNone\b", ast.unparse(a.annotation)) is not None)
            for a in arguments if a.arg != "self"]


def signature_of(thing):
    """The parameters of a function in the same form, read from the signature that pybind11 writes
    into the docstring."""
    text = re.search(r"\((.*)\) ->", thing.__doc__.split("\n")[0])[1]
    return [(None if re.fullmatch(r"arg\d", name) else name, kind.startswith("Optional["))
            for name, kind in re.findall(r"(\w+): (\S+)", text) if name != "self"]


def functions_of_stub():
    for node in ast.parse((SOURCE / "python/libph/_core.pyi").read_text()).body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, node
        elif isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            for member in node.body:
                is_property = isinstance(member, ast.FunctionDef) and any(
                    getattr(d, "id", "") == "property" for d in member.decorator_list)
                if isinstance(member, ast.FunctionDef) and not is_property:
                    yield f"{node.name}.{member.name}", member


@pytest.mark.parametrize("name, function", [*functions_of_stub()])
def test_stub_knows_arguments(name, function):
    """stubtest does not check this, because the module has the parameters only in its
    docstrings."""
    thing = _core
    for part in name.split("."):
        thing = getattr(thing, part)
    stated, found = arguments_of(function), signature_of(thing)
    # Parameters for objects and null pointers may be None, which pybind11 does not state.
    may = {"progress", "stop", "recipe"}
    assert [(n, o and n not in may) for n, o in stated] == found
