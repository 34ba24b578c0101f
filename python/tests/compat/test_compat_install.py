# SPDX-License-Identifier: MIT
"""Tests how Python loads the drop-ins, and tests the drop-in for persim."""
import importlib
import itertools
import subprocess
import sys

import numpy as np
import pytest

import libph as ph
from libph import _hints
from libph.compat import persim

INF = np.inf


def run(code):
    """Runs code in a separate process."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_libph_loads_no_drop_in_and_no_other_package():
    loaded = run("import sys, libph; print(*sys.modules)").split()
    names = {name.split(".")[0] for name in loaded}
    assert "libph" in names
    assert not names & {"sklearn", "scipy", "matplotlib", "pandas", "joblib", "tqdm"}
    assert not any(name.startswith("libph.compat") for name in loaded)


@pytest.mark.parametrize(
    "name", ["ripser", "gph", "cripser", "tcripser", "persim", "gudhi", "hdbscan"])
def test_a_drop_in_loads_no_other_package(name):
    loaded = run(f"import sys, libph.compat.{name}; print(*sys.modules)").split()
    assert not {n.split(".")[0] for n in loaded} & {"sklearn", "scipy", "matplotlib", "pandas"}


def test_distances_need_no_scikit_learn():
    code = """if True:
        import sys
        sys.modules["sklearn"] = sys.modules["sklearn.metrics"] = None
        import numpy as np
        import libph
        from libph.compat.ripser import ripser, Rips
        from libph.compat.gph import ripser_parallel
        d = np.array([[0, 1.0], [1, 0]])
        print(ripser(d, distance_matrix=True)["dgms"][0].tolist())
        print(ripser_parallel(d, metric="precomputed")["dgms"][0].tolist())
        Rips(verbose=False).transform(d, distance_matrix=True)
        print(ripser(np.array([[0.0], [1.0]]))["dgms"][0].tolist())
        for call in (lambda: ripser(d[:, :1], metric="cosine"), lambda: ripser_parallel(d)):
            try:
                call()
            except libph.NotBuiltIn as error:
                print("scikit-learn" in str(error))
    """
    assert run(code).split("\n")[:-1] == 3 * ["[[0.0, 1.0], [0.0, inf]]"] + 2 * ["True"]


def test_install():
    code = """if True:
        import warnings
        from libph import compat
        compat.install("ripser", "gph", "cripser", "gudhi", "persim")
        compat.install("ripser")
        import ripser, gph, cripser, tcripser, gudhi, persim
        from ripser import Rips, ripser as function, lower_star_img
        from gph.modules import gph_ripser
        from gph.modules.gph_collapser import flag_complex_collapse_edges_coo
        from gudhi.sklearn import RipsPersistence
        from gudhi.flag_filtration.edge_collapse import reduce_graph
        import gudhi.hera
        print(ripser.__name__, gph.__name__, cripser.__name__, tcripser.__name__)
        print(gudhi.__name__, persim.__name__, function.__module__, RipsPersistence.__module__)
        print(len(function([[0.0], [1.0], [2.0]])["dgms"]), gph_ripser.__name__)
    """
    words = run(code).split()
    assert words == [f"libph.compat.{n}" for n in (
        "ripser", "gph", "cripser", "tcripser", "gudhi", "persim", "ripser", "gudhi.sklearn")] + [
        "2", "libph.compat.gph.modules.gph_ripser"]


def test_names_of_modules():
    code = """if True:
        from libph import compat
        compat.install("ripser", "gph", "cripser", "gudhi", "persim", "hdbscan")
        from ripser.ripser import Rips, ripser as function, get_greedy_perm
        import ripser, ripser.ripser, gph, gph.python.ripser_interface as interface
        import persim, persim.visuals as visuals
        from gph.python import ripser_parallel
        from gph.modules import gph_ripser_coeff
        from gph.modules.gph_ripser_coeff import get_max_coefficient_field_supported
        from persim.bottleneck import bottleneck
        from persim.wasserstein import wasserstein
        from cripser.utils import compute_ph
        from cripser.tcripser import computePH
        import cripser, tcripser, gudhi, gudhi.rips_complex as rips_complex
        from gudhi.simplex_tree import SimplexTree
        from gudhi.cubical_complex import CubicalComplex
        from gudhi.periodic_cubical_complex import PeriodicCubicalComplex
        from gudhi.bottleneck import bottleneck_distance
        from gudhi.wasserstein.wasserstein import wasserstein_distance
        from gudhi.sklearn.rips_persistence import RipsPersistence
        from gudhi.sklearn.cubical_persistence import CubicalPersistence
        from gudhi.dtm_rips_complex import DTMRipsComplex
        from gudhi.weighted_rips_complex import WeightedRipsComplex
        assert ripser.ripser is function and interface.ripser_parallel is gph.ripser_parallel
        assert persim.bottleneck is bottleneck and visuals.plot_diagrams is persim.plot_diagrams
        assert computePH is cripser.tcripser.computePH is tcripser.computePH is cripser.computePH_T
        assert gudhi.rips_complex.RipsComplex is rips_complex.RipsComplex is gudhi.RipsComplex
        assert gudhi.sklearn.RipsPersistence is RipsPersistence
        import hdbscan, hdbscan.plots, hdbscan.prediction as prediction
        from hdbscan.hdbscan_ import HDBSCAN, hdbscan as function
        from hdbscan.robust_single_linkage_ import RobustSingleLinkage, robust_single_linkage
        from hdbscan.validity import validity_index
        assert hdbscan.HDBSCAN is HDBSCAN and hdbscan.hdbscan is function
        assert prediction.approximate_predict is hdbscan.approximate_predict
        assert hdbscan.validity.validity_index is validity_index is hdbscan.validity_index
        assert hdbscan.plots.CondensedTree.__module__ == "libph.compat.hdbscan.plots"
    """
    run(code)


def test_gudhi_without_scikit_learn():
    code = """if True:
        import sys
        sys.modules["sklearn"] = sys.modules["joblib"] = None
        from libph import compat
        compat.install("gudhi")
        import gudhi, gudhi.hera
        print(any(name.startswith("gudhi.sklearn") for name in sys.modules))
        print(gudhi.bottleneck_distance([[0, 2]], []))
    """
    assert run(code).split() == ["False", "1.0"]


def test_each_has_the_version_of_libph():
    import importlib
    for name in ("ripser", "gph", "cripser", "tcripser", "gudhi", "persim", "hdbscan"):
        module = importlib.import_module(f"libph.compat.{name}")
        assert module.__version__ == ph.__version__
        for public in module.__all__:
            assert hasattr(module, public)


def test_install_refuses():
    code = """if True:
        import sys, types
        sys.modules["ripser"] = types.ModuleType("ripser")
        import libph
        from libph import compat
        for name in ("ripser", "scipy", "flagser"):
            try:
                compat.install("gph", name)
            except libph.UsageError as error:
                print(str(error).split(",")[0])
        print("gph" in sys.modules)
    """
    assert run(code).split("\n")[:-1] == [
        "install: ripser is already imported", "install: found 'scipy'", "install: found 'flagser'",
        "False"]


# ---- parts of the originals that the drop-ins lack


@pytest.mark.parametrize("package", ["gudhi", "hdbscan", "persim"])
def test_missing_names(package):
    for path, hint in _hints.MISSING_NAMES[package].items():
        module, _, name = f"libph.compat.{package}.{path}".rpartition(".")
        if module.endswith("sklearn"):
            pytest.importorskip("sklearn", reason="scikit-learn is missing")
        module = importlib.import_module(module)
        assert name not in vars(module), "the drop-in has it: delete the row"
        with pytest.raises(ph.NotBuiltIn) as refused:
            getattr(module, name)(1, key=2)
        assert str(refused.value).endswith(" has it" + (hint and f"; {hint}"))


def test_missing_modules():
    """Each row, imported as a part of the original and of libph, and as a name."""
    code = """if True:
        import importlib
        from libph import _hints, compat
        compat.install("gudhi", "hdbscan", "persim")
        count = 0
        for package, table in _hints.MISSING_MODULES.items():
            for path, hint in table.items():
                parent, _, name = f"{package}.{path}".rpartition(".")
                if parent == "gudhi.sklearn":
                    try:
                        import sklearn
                    except ImportError:
                        continue
                end = " has it" + (hint and f"; {hint}")
                statements = [f"import {parent}.{name}", f"import libph.compat.{parent}.{name}"]
                if path not in _hints.MISSING_NAMES[package]:
                    statements += [f"from {parent} import {name}"]
                for statement in statements:
                    try:
                        exec(statement)
                    except ImportError as error:
                        assert str(error).endswith(end), (statement, error)
                        count += 1
                    else:
                        raise AssertionError(f"{statement}: the drop-in has it: delete the row")
        print(count)
    """
    assert int(run(code)) > 50


def test_modules_that_only_install_makes():
    for statement in ("import libph.compat.persim.visuals", "from libph.compat.persim import visuals",
                      "import libph.compat.gudhi.rips_complex"):
        place = "persim" if "persim" in statement else "gudhi"
        code = f"try:\n    {statement}\nexcept ImportError as error:\n    print(error)"
        assert f"libph.compat.{place} has its functions" in run(code), statement


def test_unknown_names_and_modules():
    code = """if True:
        from libph import compat
        compat.install("gudhi", "ripser", "persim")
        import gudhi, ripser
        for statement in ("gudhi.RipsComplx", "gudhi.tensorflow", "ripser.riper",
                          "import gudhi.nothing", "from gudhi import nothing", "import nothing"):
            try:
                exec(statement)
            except (AttributeError, ImportError) as error:
                print(type(error).__name__, str(error).partition(" (")[0])
    """
    assert run(code).splitlines() == [
        "AttributeError module 'libph.compat.gudhi' has no attribute 'RipsComplx'; did you mean "
        "'RipsComplex'?",
        "AttributeError module 'libph.compat.gudhi' has no attribute 'tensorflow'; GUDHI has it; "
        "libph.torch and libph.gradients differentiate bars",
        "AttributeError module 'libph.compat.ripser' has no attribute 'riper'; did you mean "
        "'ripser'?",
        "ModuleNotFoundError No module named 'gudhi.nothing'",
        "ImportError cannot import name 'nothing' from 'libph.compat.gudhi'",
        "ModuleNotFoundError No module named 'nothing'"]


def test_other_packages_of_the_same_name_are_left_alone():
    code = """if True:
        import sys, types
        sys.modules["gudhi"] = genuine = types.ModuleType("gudhi")
        genuine.__path__ = []
        import libph.compat
        try:
            import gudhi.representations
        except ImportError as error:
            print(error)
    """
    assert run(code) == "No module named 'gudhi.representations'\n"


# ---- persim


def by_hand(a, b):
    """The bottleneck distance between two small diagrams: the least cost over all pairings of
    bars."""
    best = INF
    for size in range(min(len(a), len(b)) + 1):
        for some in itertools.combinations(range(len(a)), size):
            for others in itertools.permutations(range(len(b)), size):
                costs = [abs(a[i] - b[j]).max() for i, j in zip(some, others)]
                costs += [(d[i, 1] - d[i, 0]) / 2 for d, taken in ((a, some), (b, others))
                          for i in range(len(d)) if i not in taken]
                best = min(best, max(costs, default=0))
    return best


def test_bottleneck(rng):
    for _ in range(20):
        a, b = (np.sort(rng.random((int(rng.integers(1, 5)), 2)), axis=1) for _ in range(2))
        found = persim.bottleneck(a, b)
        assert type(found) is float and np.isclose(found, by_hand(a, b))
        assert persim.bottleneck(np.column_stack([a, a]), b.tolist()) == found
    assert persim.bottleneck(np.array([[]]), [[1, 2]]) == 0.5
    for name, pair in (("dgm1", ([[0, INF]], [[1, 2]])), ("dgm2", ([[1, 2]], [[0, INF]]))):
        text = f"{name} has points with non-finite death times;ignoring those points"
        with pytest.warns(UserWarning, match=text):
            assert persim.bottleneck(*pair) == 0.5


def test_matchings():
    a, b = [[0, 4], [1, 1.5], [2, INF]], [[3, 3.2], [0, 5]]
    with pytest.warns(UserWarning, match="dgm1 has points with non-finite death times"):
        distance, rows = persim.bottleneck(a, b, matching=True)
    assert distance == 1 and np.allclose(rows, [[0, 1, 1], [1, -1, 0.25], [-1, 0, 0.1]])
    with pytest.warns(UserWarning, match="dgm1 has points with non-finite death times"):
        distance, rows = persim.wasserstein(a, b, matching=True)
    halves = [0.25 * 2 ** 0.5, 0.1 * 2 ** 0.5]
    assert np.isclose(distance, 1 + sum(halves)) and np.allclose(
        rows, [[0, 1, 1], [1, -1, halves[0]], [-1, 0, halves[1]]])
    with pytest.warns(UserWarning):
        assert persim.wasserstein(a, b) == distance


def test_bottleneck_errors():
    with pytest.raises(ph.UsageError, match="dgm2: found an array of shape"):
        persim.bottleneck([[0, 1]], [[1], [2]])
    with pytest.raises(ph.DataError, match="birth <= death"):
        persim.bottleneck([[1, 0]], [[0, 1]])


@pytest.fixture
def pyplot():
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("agg")
    import matplotlib.pyplot
    yield matplotlib.pyplot
    matplotlib.pyplot.close("all")


DGMS = [np.array([[0, 1], [0, INF]]), np.array([[0.5, 2.0]])]


def points_of(ax):
    return [np.asarray(dots.get_offsets()).tolist() for dots in ax.collections]


def test_plot_diagrams(pyplot):
    ax = persim.plot_diagrams(DGMS, title="Bars")
    assert ax is pyplot.gca() and ax.get_title() == "Bars"
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels == [r"$\infty$", "$H_{0}$", "$H_{1}$"]
    h0, h1 = points_of(ax)
    assert h0[0] == [0, 1] and h1 == [[0.5, 2]] and 2 < h0[1][1] < ax.get_ylim()[1]
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("Birth", "Death") and len(ax.lines) == 2
    low, high = ax.get_xlim()
    assert low < 0 and high > 2 and ax.get_ylim() == (low, high)


def test_plot_options(pyplot):
    axes = pyplot.subplots(1, 6)[1]
    before = dict(pyplot.rcParams)
    ax = persim.plot_diagrams(DGMS, plot_only=[1], labels=["a", "b"], ax=axes[0], legend=False)
    assert points_of(ax) == [[[0.5, 2]]] and ax.get_legend() is None and len(ax.lines) == 1
    ax = persim.plot_diagrams(DGMS[1], lifetime=True, ax=axes[1], size=5, ax_color="red")
    assert points_of(ax) == [[[0.5, 1.5]]] and ax.get_ylabel() == "Lifetime"
    assert ax.lines[0].get_color() == "red" and ax.collections[0].get_sizes().tolist() == [5]
    ax = persim.plot_diagrams(DGMS, xy_range=[0, 4, 0, 8], diagonal=False, ax=axes[2])
    assert ax.get_xlim() == (0, 4) and ax.get_ylim() == (0, 8) and len(ax.lines) == 1
    ax = persim.plot_diagrams(DGMS, labels="same", colormap="ggplot", ax=axes[3])
    assert [t.get_text() for t in ax.get_legend().get_texts()][1:] == ["same", "same"]
    persim.plot_diagrams([np.empty((0, 2))], ax=axes[4])
    persim.plot_diagrams(np.array([[1.0, 1.0]]), ax=axes[5])
    assert dict(pyplot.rcParams) == before


def test_plots_of_the_class(pyplot):
    from libph.compat.ripser import Rips, plot_dgms
    assert plot_dgms is persim.plot_diagrams
    rips = Rips(verbose=False)
    rips.transform(np.array([[0.0], [1.0], [3.0]]))
    assert rips.plot(show=False) is None
    assert points_of(pyplot.gca())[0][:2] == [[0, 1], [0, 2]]
