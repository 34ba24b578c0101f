# SPDX-License-Identifier: MIT
"""Calls that users of other packages try first are answered with helpful messages, which name
existing functions."""
import importlib.util
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
    (lambda: ph.report(POINTS, maxdim=2), "'max_dim'"),
    (lambda: ph.merge_tree(POINTS, thresh=2), "'threshold'"),
    (lambda: ph.batch(ph.rips, [POINTS], maxdim=2), "'max_dim'"),
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


@pytest.mark.parametrize("call, message", [
    (lambda: ph.estimate(np.zeros((9, 9)), periodic="all"), r"rips\(\).*'periodic'; complex='cubical'"),
    (lambda: ph.merge_tree(POINTS, superlevel=True), r"rips\(\).*'superlevel'; complex='cubical'"),
    (lambda: ph.estimate(np.zeros((9, 9, 9)), metric="l1"), r"cubical\(\).*'metric'; complex='rips'"),
    (lambda: ph.estimate(POINTS, period=1), r"rips\(\).*'period'; complex='alpha'"),
    (lambda: ph.rips(POINTS, homology_dimensions=(0, 1)), "max_dim=1 gives H0 and H1, min_dim=2"),
    (lambda: ph.cubical(POINTS, sampling=2), "do not depend on the size of voxels")])
def test_keywords_of_other_complexes_and_ranges(call, message):
    with pytest.raises(TypeError, match=message):
        call()


def test_a_keyword_like_no_other_has_no_hint():
    with pytest.raises(TypeError, match="argument 'xyzzy'$"):
        ph.rips(POINTS, xyzzy=1)
    # `run` is the internal parameter that collects unknown arguments. It is refused like any other
    # unknown name.
    with pytest.raises(TypeError, match="argument 'run'$"):
        ph.rips(POINTS, run=1)


# Functions that hand unknown keywords on; tests of their own call them.
HAND_ON = {"batch", "estimate", "merge_tree", "report", "Barcode.plot", "Barcode.report",
           "Rips.plot", "DiagramDistances.fit_transform", "DiagramKernels.fit_transform",
           "HDBSCAN.set_params",
           *(f"libph.compat.hdbscan.{name}" for name in (
               "HDBSCAN", "hdbscan", "robust_single_linkage", "validity_index"))}


def callables():
    """All functions, constructors and methods with parameters, by name."""
    modules = [ph, ph.gradients, *(getattr(ph.compat, name) for name in
                                   ("ripser", "gph", "cripser", "tcripser", "gudhi", "persim",
                                    "hdbscan"))]
    of_gudhi = ["hera", "wasserstein"]
    if importlib.util.find_spec("sklearn"):
        modules.append(ph.sklearn)
        of_gudhi.append("sklearn")
    modules += [importlib.import_module(f"libph.compat.gudhi.{name}") for name in of_gudhi]
    found = {}
    for module in modules:
        for name in module.__all__:
            target = getattr(module, name)
            if inspect.isclass(target) and not issubclass(target, (Exception, tuple, ph.Matching)):
                found[f"{module.__name__}.{name}"] = target
                found |= {f"{name}.{method}": getattr(target, method) for method in dir(target)
                          if not method.startswith("_") and inspect.isfunction(getattr(target, method))
                          and getattr(target, method).__module__.startswith("libph.")}
            elif inspect.isfunction(target):
                found[f"{module.__name__}.{name}" if module is not ph else name] = target
    return found


ALL_CALLABLES = callables()
CALLABLES = {name: target for name, target in ALL_CALLABLES.items() if name not in HAND_ON}
NAMES = {name for names, _, _ in _hints.EXPLAINED for name in names.split()}.union(*_hints.SAME)


def keywords_of(target):
    """The keywords of a function, including run options."""
    parameters = inspect.signature(target).parameters
    has_run = any(p.kind is p.VAR_KEYWORD for p in parameters.values())
    return {*parameters, *(ph._run._NAMES if has_run else ())}


def called_with(target, keyword):
    """The message of a call with an unknown keyword."""
    given = {name: object() for name, p in inspect.signature(target).parameters.items()
             if p.default is p.empty and p.kind not in (p.VAR_KEYWORD, p.VAR_POSITIONAL)}
    if "self" in given:  # a method, whose class the result of a computation has
        owner = getattr(ph, target.__qualname__.split(".")[0], object)
        given["self"] = object.__new__(owner)
    with pytest.raises(TypeError) as refused:
        target(**given, **{keyword: 1})
    return str(refused.value)


def test_there_are_many_callables():
    assert len(CALLABLES) > 90 and {"rips", "Barcode.image", "libph.sklearn.RipsPersistence",
                                "libph.compat.ripser.Rips", "delay_embedding"} <= set(CALLABLES)


@pytest.mark.parametrize("name", CALLABLES)
def test_keywords_of_other_packages(name):
    """Each row of the tables, in each function that it applies to."""
    target = CALLABLES[name]
    known = keywords_of(target)
    for names, needed, hint in _hints.EXPLAINED:
        if set(needed.split()) <= known:
            there = known & set(names.split()) - ({"dims"} if name == "boundary" else set())
            assert not there, f"{name} has keywords that need no hint"
            meant = re.findall(r"did you mean '?(\w+)", hint)
            assert set(meant) <= known
    for keyword in sorted(NAMES - known):
        hint = _hints.of_foreign_keyword(keyword, known)
        if hint:
            message = called_with(target, keyword)
            assert message.endswith(f"got an unexpected keyword argument {keyword!r}{hint}")


def test_each_row_applies():
    known = [keywords_of(target) for target in ALL_CALLABLES.values()]
    if importlib.util.find_spec("sklearn"):
        for names, needed, hint in _hints.EXPLAINED:
            assert any(set(needed.split()) <= words for words in known), (names, needed)
        for group in _hints.SAME:
            assert any(group[0] in words for words in known), group


def test_keywords_in_hints_are_there():
    known = set().union(*map(keywords_of, CALLABLES.values())) | {"constant_values"}
    for _, _, hint in _hints.EXPLAINED:
        assert set(re.findall(r"\b([a-z_]+)=", hint)) <= known, hint


IMAGE = np.array([[0.0, 9, 9], [9, 0, 9], [9, 9, 0]])
VOLUME = np.pad(np.ones((1, 1, 1)), 1)
RADII = np.full(len(POINTS), 0.1)


@pytest.mark.parametrize("advice, call, is_right", [
    ("np.where(mask, image, np.nan)", "ph.cubical({}, nan='drop', max_dim=0)",
     lambda bars: len(bars) == 2),
    ("construction='cells'", "ph.cubical(image, {}, max_dim=0)", lambda bars: len(bars) == 1),
    ("construction='vertices'", "ph.cubical(image, {}, max_dim=0)", lambda bars: len(bars) == 3),
    ("min_dim=2, max_dim=2", "ph.cubical(volume, {})", lambda bars: set(bars.dims) <= {2}),
    ("representatives='voxels'", "ph.cubical(volume, {})",
     lambda bars: bars.birth_voxel(0) is not None),
    ("np.pad(-image, 1, constant_values=-np.inf)", "ph.cubical({}, max_dim=0)",
     lambda bars: len(bars) > 0),
    ("affine=np.diag([dx, dy, dz, 1])", "ph.SpatialImage(volume, {})",
     lambda image: image.affine[2, 2] == 3),
    ("weights=radii**2", "ph.alpha(points, {}, max_dim=0)",
     lambda bars: np.isclose(bars.births, -0.01).all()),
    ("superlevel=True", "ph.cubical(image, {}, max_dim=0)", lambda bars: bars.births.min() == -9),
    ("cloud[mask]", "{}.shape", lambda shape: shape == (2,)),
])
def test_advice_that_can_be_run(advice, call, is_right):
    assert any(advice in hint for _, _, hint in _hints.EXPLAINED)
    mask = np.ones((3, 3), dtype=bool)
    mask[1, 1] = False
    found = eval(call.format(advice), {
        "ph": ph, "np": np, "image": IMAGE, "volume": VOLUME, "points": POINTS, "radii": RADII,
        "mask": mask if "where" in advice else [True, False, True], "cloud": np.arange(3),
        "dx": 1, "dy": 2, "dz": 3})
    assert is_right(found)


def test_no_hint_is_the_opposite():
    for call in (lambda: ph.rips(POINTS).filter(max_persistence=1),
                 lambda: ph.segment(POINTS, min_range=1), lambda: ph.rips(POINTS, sublevel=True)):
        with pytest.raises(TypeError, match="keyword argument '[a-z_]+'$"):
            call()


def test_keywords_of_plots():
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    bars = ph.rips(POINTS)
    with pytest.raises(ph.UsageError, match="plot_only: .*did you mean 'dims'"):
        bars.plot(plot_only=[1])
    with pytest.raises(ph.UsageError, match=r"show: .*matplotlib.pyplot.show\(\)"):
        bars.plot(show=True)


# ---- objects


class Graph:
    """As in networkx: a sequence of vertices."""
    edges = [(0, 1), (1, 2)]
    def adjacency(self): ...
    def __len__(self): return 3
    def __getitem__(self, vertex): return {}
    def __iter__(self): return iter(range(3))


class SimplexTree:
    def get_filtration(self): ...
    def get_simplices(self): ...


class GraphOfIgraph:
    vs = es = ()
    def get_edgelist(self): ...


class Cloud:
    points = [[0, 1]]


@pytest.mark.parametrize("data, hint", [
    (Graph(), "networkx.to_scipy_sparse_array"), (SimplexTree(), r"ph.filtered\(\*zip"),
    (GraphOfIgraph(), r"get_adjacency_sparse\('weight'\) .*metric='precomputed'"),
    (Cloud(), ".points has")])
def test_objects_of_others(data, hint):
    for call in (ph.rips, ph.cubical, lambda x: ph.rips(x, metric="precomputed")):
        with pytest.raises(ph.UsageError, match=f"found {type(data).__name__}, .*{hint}"):
            call(data)


@pytest.mark.parametrize("data", [Graph(), GraphOfIgraph(), SimplexTree()])
def test_objects_of_others_as_simplices(data):
    with pytest.raises(ph.UsageError, match=f"simplices: found {type(data).__name__}, .*; "):
        ph.lower_star([0, 1, 2], data)


def test_graphs_of_networkx():
    networkx = pytest.importorskip("networkx", reason="networkx is not installed")
    pytest.importorskip("scipy", reason="SciPy is not installed")
    graph = networkx.Graph()
    graph.add_weighted_edges_from([(0, 1, 2.0), (1, 2, 3.0)])
    with pytest.raises(ph.UsageError, match="found Graph, .*networkx.to_scipy_sparse_array"):
        ph.rips(graph)
    bars = ph.rips(networkx.to_scipy_sparse_array(graph), metric="precomputed")
    assert bars.dgm(0)[:, 1].tolist() == [2, 3, np.inf]
    assert len(ph.lower_star([0, 1, 0], list(graph.edges)).dgm(0)) == 2


# ---- names


@pytest.mark.parametrize("name, hint", [
    ("ripser", "libph.compat.ripser"), ("vietoris_rips", "ph.rips"), ("plot_diagrams", "bars.plot"),
    ("wasserstein_distance", "ph.wasserstein"), ("cubicle", "'cubical'"),
    ("PersistenceScaleSpaceKernel", "ph.diagram_kernels"), ("ecc", "ph.euler_curve"),
    ("TakensEmbedding", "ph.delay_embedding"), ("circular_coordinates", "cocycles"),
    ("representations", "libph.sklearn has"), ("subsampling", "ph.farthest_points"),
    ("mapper", "KeplerMapper"), ("zigzag", "Dionysus"),
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
    tables = [(_hints.MODULE, ph), (_hints.BARCODE, bars), (_hints.SKLEARN, ph.sklearn)]
    for missing in (_hints.MISSING_NAMES, _hints.MISSING_MODULES):
        tables += [(table, None) for table in missing.values()]
    for table, owner in tables:
        for name, hint in table.items():
            assert owner is None or not hasattr(owner, name)
            for path in re.findall(r"\b(?:libph|ph)((?:\.\w+)+)", hint):
                if path == ".torch" and not importlib.util.find_spec("torch"):
                    continue
                found = ph
                for part in path[1:].split("."):
                    found = getattr(found, part)
            for call in re.findall(r"(?<![.\w])(?:bars\.)?(\w+)\(", hint):
                assert hasattr(bars, call) or call == "len", (name, call)
    for hint in [*_hints.SKLEARN.values(), _hints.MISSING_MODULES["gudhi"]["representations"]]:
        for name in re.findall(r"\b(?:use|with|has|and|,) ([A-Z]\w+)", hint):
            assert hasattr(ph.sklearn, name) or name in ("KeplerMapper", "Landscape"), hint


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
                                          (np.array([0, 1]), "ndarray")])
def test_indices_of_a_barcode(index, found):
    with pytest.raises(TypeError, match=f"found {found}, expected a whole number, a slice or one "
                                        "bool per bar; dgm"):
        ph.rips(POINTS)[index]


def test_places_beyond_the_end():
    bars = ph.rips(POINTS)[:3]
    assert bars[-3] == bars[0]
    for place in (3, -4):
        with pytest.raises(IndexError, match="found 3 bars"):
            bars[place]
