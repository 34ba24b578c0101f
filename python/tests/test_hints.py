# SPDX-License-Identifier: MIT
"""Calls that users of other packages try first are answered with helpful messages, which name
existing functions."""
import inspect
import re
import subprocess
import sys

import numpy as np
import pytest

import libph as ph
from libph import _hints

POINTS = np.random.default_rng(0).random((12, 2))


# ---- keywords


@pytest.mark.parametrize("keyword, hint", [
    ("maxdim", "'max_dim'"), ("thresh", "'threshold'"), ("coeff", "'field'"),
    ("distance_matrix", "metric='precomputed'"), ("do_cocycles", "representatives='cocycles'"),
    ("max_dimension", "one less than GUDHI's"), ("n_jobs", "'threads'"), ("memory", "'memory_limit'"),
    ("treshold", "'threshold'"), ("timeuot", "'timeout'")])
def test_keywords_of_rips(keyword, hint):
    with pytest.raises(TypeError, match=f"rips.. got an unexpected .*'{keyword}'; .*{hint}"):
        ph.rips(POINTS, **{keyword: 2})


@pytest.mark.parametrize("call, hint", [
    (lambda: ph.cubical(POINTS, periodic_dimensions=[True, True]), "'periodic'"),
    (lambda: ph.estimate(POINTS, maxdim=2), "'max_dim'"),
    (lambda: ph.farthest_points(POINTS, 2, thread=1), "'threads'"),
    (lambda: ph.bottleneck([[0, 1]], [[0, 1]], dims=0), "'dim'"),
    (lambda: ph.wasserstein([[0, 1]], [[0, 1]], internal_p=2), "'ground'"),
    (lambda: ph.euler_curve(POINTS, n_bins=9), "'resolution'"),
    (lambda: ph.diagram_kernels([], bandwidth=1), "'sigma'"),
    (lambda: ph.segment(POINTS, intrinsic=(1, 1, 1, 1)), "'intrinsics'"),
    (lambda: ph.compat.cripser.computePH(POINTS, max_dim=1), "'maxdim'"),
    (lambda: ph.compat.ripser.ripser(POINTS, max_dim=1), "'maxdim'")])
def test_keywords_of_others(call, hint):
    with pytest.raises(TypeError, match=f"did you mean {hint}"):
        call()


def test_a_keyword_like_no_other_has_no_hint():
    with pytest.raises(TypeError, match="argument 'xyzzy'$"):
        ph.rips(POINTS, xyzzy=1)
    # `run` is the internal parameter that collects unknown arguments. It is refused like any other
    # unknown name.
    with pytest.raises(TypeError, match="argument 'run'$"):
        ph.rips(POINTS, run=1)


def test_keywords_named_in_hints_are_there():
    functions = (ph.rips, ph.cubical, ph.wasserstein, ph.sliced_wasserstein, ph.euler_curve,
                 ph.diagram_kernels)
    there = {"threads", "memory_limit"}.union(*(inspect.signature(f).parameters for f in functions))
    assert set(_hints.KEYWORDS.values()) <= there
    assert not set(_hints.KEYWORDS) & there


# ---- names


@pytest.mark.parametrize("name, hint", [
    ("ripser", "libph.compat.ripser"), ("vietoris_rips", "ph.rips"), ("plot_diagrams", "bars.plot"),
    ("wasserstein_distance", "ph.wasserstein"), ("cubicle", "'cubical'"),
    ("PersistenceScaleSpaceKernel", "ph.diagram_kernels"), ("ecc", "ph.euler_curve"),
    ("VietorisRipsPersistence", "libph.sklearn.RipsPersistence")])
def test_names_of_the_package(name, hint):
    assert not hasattr(ph, name)
    with pytest.raises(AttributeError, match=f"libph has no '{name}'; .*{hint}"):
        getattr(ph, name)


@pytest.mark.parametrize("name, hint", [
    ("diagrams", "dgms"), ("persistence", "dgm"), ("show", "plot"), ("lifetimes", "deaths"),
    ("flag_persistence_generators", "ph.gradients.deciders"), ("brith_cells", "'birth_cells'"),
    ("euler_characteristic", "euler_curve")])
def test_names_of_a_barcode(name, hint):
    with pytest.raises(AttributeError, match=f"a Barcode has no '{name}'; .*{hint}"):
        getattr(ph.rips(POINTS), name)


def test_names_in_hints_are_there():
    """Everything that a hint writes as ph.X, libph.X.Y or a call exists."""
    pytest.importorskip("sklearn", reason="scikit-learn is missing, which libph.sklearn needs")
    bars = ph.rips(POINTS)
    for table, owner in ((_hints.MODULE, ph), (_hints.BARCODE, bars), (_hints.SKLEARN, ph.sklearn)):
        for name, hint in table.items():
            assert not hasattr(owner, name)
            for path in re.findall(r"\b(?:libph|ph)((?:\.\w+)+)", hint):
                found = ph
                for part in path[1:].split("."):
                    found = getattr(found, part)
            for call in re.findall(r"(?<![.\w])(?:bars\.)?(\w+)\(", hint):
                assert hasattr(bars, call) or call == "len", (name, call)
    for hint in _hints.SKLEARN.values():
        for name in re.findall(r"\buse ([\w, ]+)$", hint):
            assert all(hasattr(ph.sklearn, part) for part in name.split(", ")), hint


def test_modules_are_loaded_when_they_are_looked_at():
    pytest.importorskip("sklearn", reason="scikit-learn is missing, which libph.sklearn needs")
    code = """if True:
        import sys, libph as ph
        assert not {'sklearn', 'libph.sklearn', 'libph.compat'} & set(sys.modules)
        assert {'compat', 'sklearn', 'torch'} <= set(dir(ph))
        print(ph.compat.ripser.__name__, ph.sklearn.RipsPersistence.__name__, dir(ph.compat))
        """
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout.startswith("libph.compat.ripser RipsPersistence ['cripser', 'gph'"), done.stderr


def test_a_module_whose_package_is_missing():
    code = """if True:
        import sys
        sys.modules['sklearn'] = None  # as if it were not installed
        import libph as ph
        assert not hasattr(ph, 'sklearn')
        try:
            ph.sklearn
        except AttributeError as error:
            print(error)
        """
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout == "libph.sklearn needs sklearn, which is not installed\n", done.stderr


@pytest.mark.parametrize("index, found", [("dgms", "str"), ([0, 1], "list"), (1.5, "float"),
                                          (np.array([True] * 12), "ndarray")])
def test_indices_of_a_barcode(index, found):
    with pytest.raises(TypeError, match=f"found {found}, expected a whole number or a slice; dgm"):
        ph.rips(POINTS)[index]


def test_places_beyond_the_end():
    bars = ph.rips(POINTS)[:3]
    assert bars[-3] == bars[0]
    for place in (3, -4):
        with pytest.raises(IndexError, match="found 3 bars"):
            bars[place]
