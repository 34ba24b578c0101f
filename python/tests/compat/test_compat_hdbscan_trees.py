# SPDX-License-Identifier: MIT
"""Tests the trees of the drop-in for hdbscan: as pictures, tables and graphs."""
import numpy as np
import pytest
import scipy.spatial.distance as spatial

import libph as ph
from libph.compat import hdbscan

pytest.importorskip("sklearn", reason="scikit-learn is missing, which estimators need")
from test_compat_hdbscan import cloud  # noqa: E402


@pytest.fixture
def pyplot():
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("agg")
    import matplotlib.pyplot
    yield matplotlib.pyplot
    matplotlib.pyplot.close("all")


@pytest.fixture
def fitted(rng):
    return hdbscan.HDBSCAN(8).fit(cloud(rng))


def test_plots_of_condensed_trees(pyplot, fitted):
    tree, count = fitted.condensed_tree_, fitted.labels_.max() + 1
    data = tree.get_plot_data()
    area = np.multiply(data["bar_widths"], data["bar_tops"]).sum()
    ax = tree.plot(select_clusters=True, label_clusters=True, selection_palette=["b"] * count)
    assert ax is pyplot.gcf().axes[0] and len(ax.patches) >= count
    bars = [patch for patch in ax.patches if hasattr(patch, "get_x")]
    assert sum(bar.get_width() * bar.get_height() for bar in bars) == pytest.approx(area)
    assert [text.get_text() for text in ax.texts] == [str(c) for c in range(count)]
    assert len(ax.lines) == len(data["line_xs"]) == len(tree.to_numpy()) - len(fitted.labels_)
    assert ax.yaxis_inverted() and len(pyplot.gcf().axes) == 2
    for options in ({"log_size": True}, {"cmap": "none", "colorbar": False},
                    {"max_rectangles_per_icicle": 1, "leaf_separation": 2}):
        axes = pyplot.subplots()[1]
        assert tree.plot(axis=axes, **options) is axes and axes.patches
    assert len(tree.get_plot_data(max_rectangle_per_icicle=1)["bar_widths"]) == len(
        data["cluster_bounds"])
    hdbscan.HDBSCAN().fit([[0.0], [1]]).condensed_tree_.plot(select_clusters=True)


def test_the_area_of_a_cluster_is_its_stability(fitted):
    """With many bars, no bars are joined."""
    data = fitted.condensed_tree_.get_plot_data(max_rectangle_per_icicle=10**6)
    area = np.multiply(data["bar_widths"], data["bar_tops"]).sum()
    assert area == pytest.approx(fitted._fit.tree.clusters["mass"].sum())


def test_plots_of_merges(pyplot, fitted):
    tree, n = fitted.single_linkage_tree_, len(fitted.labels_)
    ax = tree.plot()
    down, across = ax.collections
    assert len(down.get_segments()) == 2 * (n - 1) and len(across.get_segments()) == n - 1
    heights = sorted(segment[0][1] for segment in across.get_segments())
    assert np.allclose(heights, tree.to_numpy()[:, 2])
    assert ax.get_ylim()[1] >= heights[-1]
    for options, merges in (({"truncate_mode": "lastp", "p": 5}, 4),
                            ({"truncate_mode": "level", "p": 0, "cmap": "none"}, 1),
                            ({"vary_line_width": False, "colorbar": False}, n - 1)):
        axes = pyplot.subplots()[1]
        tree.plot(axis=axes, **options)
        assert len(axes.collections[1].get_segments()) == merges
    with pytest.raises(ph.UsageError, match="truncate_mode: found 'first'"):
        tree.plot(truncate_mode="first")


def test_plots_with_infinite_values(pyplot):
    X = np.repeat([[0.0], [5], [9]], 12, axis=0)
    X[0] = np.nan
    apart = hdbscan.HDBSCAN().fit(X)
    assert np.isinf(apart.single_linkage_tree_.to_numpy()[-1, 2])
    top = apart.single_linkage_tree_.plot().collections[1].get_segments()[-1][0][1]
    assert top == pytest.approx(1.1 * 5)
    assert np.isinf(apart.condensed_tree_.to_numpy()["lambda_val"]).any()
    ax = apart.condensed_tree_.plot(axis=pyplot.subplots()[1], select_clusters=True)
    assert ax.get_ylim()[0] == pytest.approx(1.1 * 0.25, rel=0.1)
    single = hdbscan.HDBSCAN().fit([[1.0]])
    assert not single.single_linkage_tree_.plot(
        axis=pyplot.subplots()[1]).collections[1].get_segments()
    single.minimum_spanning_tree_.plot(axis=pyplot.subplots()[1])


def test_plots_of_long_chains(pyplot):
    """A recursion would need a level for each merge."""
    chain = hdbscan.HDBSCAN(2, 1).fit(np.cumsum(np.arange(3000.0))[:, None])
    assert len(chain.single_linkage_tree_.plot().collections[1].get_segments()) == 2999
    chain.condensed_tree_.plot()


@pytest.mark.parametrize("axes", [1, 2, 3, 40])
def test_plots_of_spanning_trees(pyplot, rng, axes):
    X = cloud(rng, axes)
    ax = hdbscan.HDBSCAN().fit(X).minimum_spanning_tree_.plot(edge_cmap="viridis")
    lines, points = ax.collections
    assert len(lines.get_segments()) == len(X) - 1 and len(points.get_offsets()) == len(X)
    D = spatial.squareform(spatial.pdist(X))
    with pytest.raises(ph.UsageError, match="expected points; to_networkx"):
        hdbscan.HDBSCAN(metric="precomputed").fit(D).minimum_spanning_tree_.plot()


def test_tables(fitted):
    pytest.importorskip("pandas", reason="pandas is not installed")
    tree = fitted.condensed_tree_
    assert list(tree.to_pandas().columns) == list(tree.to_numpy().dtype.names)
    assert tree.to_pandas().to_records(index=False).tolist() == tree.to_numpy().tolist()
    merges = fitted.single_linkage_tree_
    table = merges.to_pandas()
    assert list(table.columns) == ["parent", "left_child", "right_child", "distance", "size"]
    assert np.array_equal(table.to_numpy()[:, 1:], merges.to_numpy())
    assert table["parent"].tolist() == list(range(len(fitted.labels_), 2 * len(fitted.labels_) - 1))
    edges = fitted.minimum_spanning_tree_
    assert np.array_equal(edges.to_pandas().to_numpy(), edges.to_numpy())
    assert list(edges.to_pandas().columns) == ["from", "to", "distance"]


def test_graphs(fitted):
    networkx = pytest.importorskip("networkx", reason="networkx is not installed")
    n = len(fitted.labels_)
    rows = fitted.condensed_tree_.to_numpy()
    tree = fitted.condensed_tree_.to_networkx()
    assert networkx.is_arborescence(tree) and len(tree) == len(rows) + 1
    for row in rows:
        assert tree.edges[row["parent"], row["child"]]["weight"] == row["lambda_val"]
        assert tree.nodes[row["child"]]["size"] == row["child_size"]
    merges = fitted.single_linkage_tree_.to_networkx()
    assert networkx.is_arborescence(merges) and merges.nodes[2 * n - 2]["size"] == n
    forest = fitted.minimum_spanning_tree_.to_networkx()
    assert networkx.is_tree(forest) and len(forest.nodes[0]["data"]) == 2
    for u, v, value in fitted.minimum_spanning_tree_.to_numpy():
        assert forest.edges[u, v]["weight"] == value
